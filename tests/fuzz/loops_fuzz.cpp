/// Plants and controllers beyond the normalised families from any bytes: the first byte says which fields, a line each.
#include <cstdint>
#include <sstream>
#include <string>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "engine/loop/stability.h"
#include "tools/general_arguments.h"
#include "tools/general_loop_arguments.h"

namespace portrait {
namespace {

using namespace tools;

SimulateArguments line_of(int controller, const std::string& text) {
  std::istringstream lines(text);
  SimulateArguments a;
  std::getline(lines, a.plant);
  std::string* const field[] = {&a.pid, &a.gains, &a.controller, &a.kappa};
  std::getline(lines, *field[controller]);
  std::getline(lines, a.Td);
  std::getline(lines, a.tau_f);
  std::getline(lines, controller == 3 ? a.tau_i : a.prefilter);
  std::getline(lines, controller == 0 ? a.weights : a.delta);
  return a;
}

/// What is accepted is a loop, and its normalised form one too.
void check(const GeneralLoop& loop) {
  PORTRAIT_CHECK(!why_invalid(loop));
  const NormalisedLoop n = normalised(loop);
  if (why_invalid(n.loop)) return;  // coefficients that no double holds any more are refused there
  const OpenLoop open = open_loop(n.loop);
  if (high_frequency_gain(open) < 1) PORTRAIT_CHECK(unstable_roots(open) >= 0);
}

}  // namespace
}  // namespace portrait

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace portrait;
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(bytes + 1), size - 1);
  try {
    if (bytes[0] % 8 == 7)
      for (const double number : numbers_argument("--fuzz", text)) PORTRAIT_CHECK(number == number);
    else if (bytes[0] % 8 == 6)
      pid_argument("--fuzz", text);
    else if (bytes[0] % 8 == 5)
      rational_argument("--fuzz", text);
    else
      check(general_loop_argument(line_of(bytes[0] % 4, text)));
  } catch (const InputError& error) {
    PORTRAIT_CHECK(std::string(error.what()).size() > 5);
  }
  return 0;
}
