/// A valid portrait with bytes changed: each four bytes are a place (three, big endian) and what is xored into it. Reading gives
/// what was written, or one of our errors.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <unistd.h>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "portraits/verify.h"
#include "tests/portraits/content.h"
#include "tests/portraits/sample.h"

namespace portrait {
namespace {

struct Whole {
  std::filesystem::path path;  ///< in memory where the system has a folder for that
  std::string bytes, content;
};

const Whole& whole() {
  static const Whole made = [] {
    Whole w;
    const std::filesystem::path memory = "/dev/shm";
    const auto folder = std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    w.path = folder / ("portrait-fuzz-" + std::to_string(getpid()) + ".h5");
    std::filesystem::remove(w.path);
    sample::write(w.path, sample::small_grid());
    w.content = content(w.path);
    std::ifstream file(w.path, std::ios::binary);
    w.bytes.assign(std::istreambuf_iterator<char>(file), {});
    return w;
  }();
  return made;
}

std::string changed(const std::uint8_t* bytes, std::size_t size) {
  std::string all = whole().bytes;
  for (; size >= 4; bytes += 4, size -= 4) {
    const std::size_t place = (std::size_t{bytes[0]} << 16 | std::size_t{bytes[1]} << 8 | bytes[2]) % all.size();
    all[place] = static_cast<char>(all[place] ^ static_cast<char>(bytes[3]));
  }
  return all;
}

template <typename Work>
bool refuses(const Work& work) {
  try {
    work();
    return false;
  } catch (const InputError&) {
  } catch (const StoreError&) {
  } catch (const IntegrityError&) {
  }
  return true;
}

}  // namespace
}  // namespace portrait

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace portrait;
  const Whole& w = whole();
  std::ofstream(w.path, std::ios::binary) << changed(bytes, size);
  std::string read;
  const bool refused = refuses([&] { read = content(w.path); });
  PORTRAIT_CHECK(refused || read == w.content);
  const bool doubted = refuses([&] { verify(w.path); });
  PORTRAIT_CHECK(doubted || !refused);
  std::filesystem::remove(w.path);
  return 0;
}
