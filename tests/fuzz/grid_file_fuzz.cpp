/// Grid files from any bytes.
#include <cstdint>
#include <string>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "grids/grid_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace portrait;
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  try {
    const Grid grid = parse_grid(text, "fuzz");
    PORTRAIT_CHECK(grid.text == text);
    const std::uint64_t count = setting_count(grid);
    for (const std::uint64_t number : {std::uint64_t{0}, count / 2, count - 1})
      PORTRAIT_CHECK(!why_invalid(Loop{grid.family, setting_at(grid, number)}));
  } catch (const InputError& error) {
    PORTRAIT_CHECK(std::string(error.what()).rfind("fuzz", 0) == 0);
  }
  return 0;
}
