#include "tools/general_loop_arguments.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "tools/arguments.h"
#include "tools/general_arguments.h"

namespace portrait::tools {
namespace {

double number_or(std::string_view option, const std::string& text, double otherwise) {
  return text.empty() ? otherwise : number_argument(option, text);
}

double time_constant(const char* option, const std::string& text, const char* plant) {
  if (text.empty()) throw InputError(fmt::format("{} is missing: {} has one", option, plant));
  const double T = number_argument(option, text);
  if (!std::isfinite(T) || T <= 0)
    throw InputError(fmt::format("{}: must be finite and above 0 (it is {})", option, text));
  return T;
}

void refuse(const char* option, bool given, const std::string& why) {
  if (given) throw InputError(fmt::format("{} has no place here: {}", option, why));
}

int order_of(const SimulateArguments& a) {
  if (a.j < 1 || a.j > 8) throw InputError(fmt::format("--j: jotd has 1 to 8 equal lags (it is {})", a.j));
  return a.j;
}

TransferFunction rational_plant(const SimulateArguments& a) {
  refuse("--tau-1", !a.tau_1.empty() && a.plant != "fotd", "fotd has one");
  refuse("--tau-j", !a.tau_j.empty() && a.plant != "jotd", "jotd has one");
  refuse("--j", a.j != 0 && a.plant != "jotd", "jotd has it");
  if (is_transfer_function(a.plant)) return transfer_function_argument("--plant", a.plant);
  if (a.plant == "dipdt") return {{1}, {{0, 1}, {0, 1}}};
  if (a.plant == "ipdt") return {{1}, {{0, 1}}};
  if (a.plant == "fotd") return multiple_lag(1, time_constant("--tau-1", a.tau_1, "fotd"), 1);
  if (a.plant == "jotd") return multiple_lag(1, time_constant("--tau-j", a.tau_j, "jotd"), order_of(a));
  throw InputError(fmt::format("--plant: unknown plant \"{}\"{}", a.plant,
                               suggestion(a.plant, {"dipdt", "ipdt", "fotd", "jotd", "tf:NUM/DEN"})));
}

GeneralPlant plant_of(const SimulateArguments& a) {
  GeneralPlant plant{rational_plant(a), number_or("--Td", a.Td, is_transfer_function(a.plant) ? 0 : 1)};
  plant.rational.numerator = scaled(number_or("--K", a.K, 1), plant.rational.numerator);
  return plant;
}

/// The controller's own filter, for the forms that do not bring one.
double filter_time(const SimulateArguments& a) {
  if (filter_order(a) == 0) return 0;
  return time_constant("--tau-f", a.tau_f, "a filter of order --n 1 or more");
}

/// Kp, Ki, Kd, where the controller was given so.
std::optional<ParallelForm> pid_of(const SimulateArguments& a) {
  if (!a.pid.empty()) return pid_argument("--pid", a.pid);
  if (a.kappa.empty()) return std::nullopt;
  if (!a.delta.empty() && !a.tau_d.empty())
    throw InputError("--delta and --tau-d say the same: give one of the two");
  const double kappa = number_argument("--kappa", a.kappa), tau_i = number_or("--tau-i", a.tau_i, kInf);
  const double delta =
      a.tau_d.empty() ? number_or("--delta", a.delta, 0) : kappa * number_argument("--tau-d", a.tau_d);
  return ParallelForm{.Kp = kappa, .Ki = kappa / tau_i, .Kd = delta};
}

GeneralController by_gains(const SimulateArguments& a) {
  const std::vector<double> gains = numbers_argument("--gains", a.gains);
  if (gains.size() < 2) throw InputError("--gains: K_-1 and K_0 at least, as --gains 0.4,1.3");
  const int m = static_cast<int>(gains.size()) - 2, n = filter_order(a);
  if (n < m)
    throw InputError(fmt::format("--gains up to K_{} need a filter of order --n {} or more (it is {})", m, m, n));
  if (std::all_of(gains.begin(), gains.end(), [](double k) { return k == 0; }))
    throw InputError("--gains: all are 0");
  return gains_controller(gains, n, filter_time(a));
}

GeneralController by_transfer_function(const SimulateArguments& a) {
  refuse("--tau-f", !a.tau_f.empty() || a.n >= 0, "--controller has its filter in its denominator");
  const TransferFunction C = transfer_function_argument("--controller", a.controller);
  if (relative_degree(C) < 0)
    throw InputError(
        fmt::format("--controller: improper, degree {} over {}", degree(C.numerator), degree(C.denominator)));
  return controller(C);
}

GeneralController controller_of(const SimulateArguments& a) {
  const int given = !a.kappa.empty() + !a.pid.empty() + !a.gains.empty() + !a.controller.empty();
  if (given != 1)
    throw InputError(
        "the controller is given by one of --kappa (with --tau-i, --delta), --pid, --gains, --controller");
  if (!a.gains.empty()) return by_gains(a);
  if (!a.controller.empty()) return by_transfer_function(a);
  return pid_controller(*pid_of(a), filter_order(a), filter_time(a));
}

/// full and pi are made of the times of a PID controller.
TransferFunction prefilter_of(const SimulateArguments& a) {
  if (is_transfer_function(a.prefilter)) return transfer_function_argument("--prefilter", a.prefilter);
  const double b = number_argument("--b", a.b), c = number_argument("--c", a.c);
  const Prefilter usual =
      a.kappa.empty() || !a.weights.empty() ? Prefilter::none : usual_prefilter(filter_order(a));
  const Prefilter kind = a.prefilter.empty() ? usual : prefilter_argument("--prefilter", a.prefilter);
  if (kind == Prefilter::none) {
    if (b != 0 || c != 0) throw InputError("--b and --c belong to a prefilter: give --prefilter full or pi");
    return {};
  }
  const auto form = pid_of(a);
  if (!form || form->Kp == 0)
    throw InputError("--prefilter full and pi are made of a PID controller's times: give tf:NUM/DEN");
  const double Ti = form->Kp / form->Ki, TD = form->Kd / form->Kp;
  if (form->Ki == 0)
    return kind == Prefilter::full && TD != 0 ? transfer_function({1, b}, {1, TD}) : TransferFunction{};
  return kind == Prefilter::full ? transfer_function({1, b, c}, {1, Ti, Ti * TD})
                                 : transfer_function({1, b * Ti}, {1, Ti});
}

}  // namespace

GeneralLoop general_loop_argument(const SimulateArguments& a) {
  GeneralLoop loop{plant_of(a), controller_of(a)};
  if (!a.weights.empty()) {
    if (!a.controller.empty() || !a.gains.empty())
      throw InputError("--weights belong to --pid or --kappa: b on the proportional, c on the derivative action");
    const std::vector<double> weights = named_numbers_argument("--weights", a.weights, {"b", "c"}, 1);
    loop.controller = with_weights(loop.controller, weights[0], weights[1]);
  }
  loop.controller.prefilter = prefilter_of(a);
  if (const auto reason = why_invalid(loop)) throw InputError(*reason);
  return loop;
}

}  // namespace portrait::tools
