/// What the page's server answers, from any bytes: the first says which path, the others are the request's body.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <unistd.h>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "tests/portraits/sample.h"
#include "tools/page_answers.h"

namespace portrait {
namespace {

/// A small portrait of its own for this process, removed at once: the reader has it open.
const tools::PageAnswers& answers() {
  static const tools::PageAnswers* const all = [] {
    const auto path = std::filesystem::temp_directory_path() / ("portrait-fuzz-" + std::to_string(getpid()) + ".h5");
    std::filesystem::remove(path);
    sample::write(path, sample::small_grid());
    auto* made = new tools::PageAnswers(path.string(), 1'000'000);
    std::filesystem::remove(path);
    return made;
  }();
  return *all;
}

void answer(int path, const tools::Json& request) {
  switch (path) {
    case 0:
      PORTRAIT_CHECK(answers().view(request).size() > 4);
      return;
    case 1:
      PORTRAIT_CHECK(answers().setting(request).is_object());
      return;
    case 2:
      PORTRAIT_CHECK(answers().front(request).is_object());
      return;
    case 3:
      PORTRAIT_CHECK(answers().quantiles(request).is_object());
      return;
    case 4:
      PORTRAIT_CHECK(answers().rules(request).is_object());
      return;
    case 5:
      PORTRAIT_CHECK(answers().simulate(request).is_object());
      return;
    default:
      PORTRAIT_CHECK(answers().info().is_object());
  }
}

}  // namespace
}  // namespace portrait

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace portrait;
  if (size == 0) return 0;
  const tools::Json request = tools::Json::parse(bytes + 1, bytes + size, nullptr, false);
  if (!request.is_object()) return 0;  // the server refuses these before it asks
  try {
    answer(bytes[0] % 7, request);
  } catch (const InputError& error) {
    PORTRAIT_CHECK(std::string(error.what()).size() > 5);
  } catch (const nlohmann::json::exception&) {  // answered with 400, like an InputError
  }
  return 0;
}
