#include "engine/loop/forms.h"

#include <cmath>
#include <limits>

namespace portrait {

ParallelForm parallel(const StandardForm& form) {
  return {.Kp = form.Kc, .Ki = form.Kc / form.Ti, .Kd = form.Kc * form.TD};
}

StandardForm standard(const ParallelForm& form) {
  // A quotient by 0 would take its sign from Kp, or from the zero.
  const double Ti = form.Ki == 0 ? std::numeric_limits<double>::infinity() : form.Kp / form.Ki;
  return {.Kc = form.Kp, .Ti = Ti, .TD = form.Kd / form.Kp};
}

StandardForm standard(const SeriesForm& form) {
  if (std::isinf(form.Ti)) return {.Kc = form.Kc, .Ti = form.Ti, .TD = form.TD};
  const double sum = form.Ti + form.TD;
  return {.Kc = form.Kc * sum / form.Ti, .Ti = sum, .TD = form.Ti * form.TD / sum};
}

std::optional<SeriesForm> series(const StandardForm& form) {
  if (std::isinf(form.Ti)) return SeriesForm{.Kc = form.Kc, .Ti = form.Ti, .TD = form.TD};
  if (form.Ti < 4 * form.TD) return std::nullopt;
  const double longer = 0.5 + std::sqrt(0.25 - form.TD / form.Ti);
  // The product of the two times is Ti TD: dividing keeps digits where subtracting would lose them.
  return SeriesForm{.Kc = form.Kc * longer, .Ti = form.Ti * longer, .TD = form.TD / longer};
}

}  // namespace portrait
