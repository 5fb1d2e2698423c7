/// --plant, --uncertain, --step and settings from any bytes: the first byte says which, for which family.
#include <cstdint>
#include <string>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "tools/arguments.h"

namespace portrait {
namespace {

using namespace tools;

Grid grid_of(Plant plant) {
  Grid grid;
  grid.family = {plant, 1, Prefilter::full};
  grid.axes = {Axis::linear(Parameter::kappa, 0.1, 0.9, 9), Axis::linear(Parameter::tau_d, 0, 1, 5)};
  grid.fixed = {{Parameter::tau_i, 8}, {Parameter::tau_f, 0.1}, {Parameter::b, 0}, {Parameter::c, 0}};
  if (plant == Plant::fotd) grid.fixed.push_back({Parameter::tau_1, 2});
  return grid;
}

void check_box(const PlantBox& box, Plant family) {
  for (const BoxPoint& corner : box.corners()) PORTRAIT_CHECK(!why_invalid(box.at(corner)));
  PORTRAIT_CHECK(!why_invalid(box) && box.nominal.family == family);
  PORTRAIT_CHECK(!box.middles(10).empty());
}

void read(int kind, Plant family, const std::string& text) {
  switch (kind) {
    case 0:
      PORTRAIT_CHECK(!why_invalid(real_plant_argument("--fuzz", text, family)));
      return;
    case 1:
      return check_box(uncertain_argument("--fuzz", text, std::nullopt, family), family);
    case 2:
      return check_box(
          uncertain_argument("--fuzz", text, RealPlant{family, 2, 0.5, family == Plant::fotd ? 1.5 : 0}, family),
          family);
    case 3: {
      const StepSizes steps = step_argument("--fuzz", text);
      PORTRAIT_CHECK(steps.w > 0 && steps.d > 0);
      return;
    }
    default: {
      const Grid grid = grid_of(family);
      const Setting setting = setting_argument("--fuzz", text, grid);
      if (!why_invalid(Loop{grid.family, setting})) PORTRAIT_CHECK(setting.kappa > 0);
    }
  }
}

}  // namespace
}  // namespace portrait

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace portrait;
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(bytes + 1), size - 1);
  try {
    read(bytes[0] % 5, static_cast<Plant>(bytes[0] / 5 % 3), text);
  } catch (const InputError& error) {
    PORTRAIT_CHECK(std::string(error.what()).rfind("--fuzz", 0) == 0);
  }
  return 0;
}
