/// sample_portrait write SIZES FILE   a sample portrait; SIZES as 3,4 or `small` or `single`
/// sample_portrait verify FILE        prints every dataset with its digest
/// For the tests that run programs. Exit codes are those of `portrait`.
#include <cstdio>
#include <exception>
#include <string>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "portraits/verify.h"
#include "tests/portraits/sample.h"

namespace {

portrait::Grid grid_named(const std::string& name) {
  if (name == "small") return portrait::sample::small_grid();
  if (name == "none") return portrait::sample::grid_of({});
  std::vector<std::uint64_t> sizes;
  for (std::size_t at = 0; at < name.size();
       at = name.find(',', at) == std::string::npos ? name.size() : name.find(',', at) + 1)
    sizes.push_back(std::stoull(name.substr(at)));
  return portrait::sample::grid_of(sizes);
}

int run(const std::vector<std::string>& words) {
  if (words.size() == 3 && words[0] == "write") {
    portrait::sample::write(words[2], grid_named(words[1]));
    return 0;
  }
  if (words.size() == 2 && words[0] == "verify") {
    for (const auto& dataset : portrait::verify(words[1]).datasets)
      fmt::print("{} {}\n", dataset.digest, dataset.name);
    return 0;
  }
  throw portrait::InputError("usage: sample_portrait write SIZES FILE | sample_portrait verify FILE");
}

int code_of(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const portrait::InputError&) {
    return 2;
  } catch (const portrait::IntegrityError&) {
    return 4;
  } catch (...) {
    return 1;
  }
}

}  // namespace

int main(int count, char** words) {
  try {
    return run({words + 1, words + count});
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return code_of(std::current_exception());
  }
}
