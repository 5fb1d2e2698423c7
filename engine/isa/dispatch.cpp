#include "engine/isa/dispatch.h"

#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"

namespace portrait {

namespace base {
extern const kernel::Implementation kImplementation;
}
namespace avx2 {
extern const kernel::Implementation kImplementation;
}
namespace avx512 {
extern const kernel::Implementation kImplementation;
}

namespace {

const std::vector<std::string_view> kNames = {"base", "avx2", "avx512"};

bool has_avx2() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }
bool has_avx512() {
  return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
}

}  // namespace

std::vector<const kernel::Implementation*> available_implementations() {
  std::vector<const kernel::Implementation*> available{&base::kImplementation};
  if (has_avx2()) available.push_back(&avx2::kImplementation);
  if (has_avx512()) available.push_back(&avx512::kImplementation);
  return available;
}

const kernel::Implementation& chosen_implementation() {
  const auto available = available_implementations();
  const char* forced = std::getenv("PORTRAIT_ISA");
  if (forced == nullptr || *forced == '\0') return *available.back();
  for (const auto* implementation : available)
    if (forced == std::string_view(implementation->name)) return *implementation;
  for (const std::string_view known : kNames)
    if (forced == known) throw InputError(fmt::format("PORTRAIT_ISA: this machine cannot run {}", forced));
  throw InputError(
      fmt::format("PORTRAIT_ISA: unknown instruction set \"{}\"{}", forced, suggestion(forced, kNames)));
}

}  // namespace portrait
