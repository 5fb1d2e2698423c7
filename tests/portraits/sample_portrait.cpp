/// sample_portrait write SIZES FILE     a sample portrait; SIZES as 3,4 or `small` or `none`
/// sample_portrait repeat SIZES FILE    one with values that repeat each other
/// sample_portrait single SIZES FILE    the same in single precision
/// sample_portrait replace SIZES FILE   the same, in the place of an existing file
/// sample_portrait verify FILE          prints every dataset with its digest
/// For the tests that run programs. Exit codes are those of `portrait`.
#include <cstdio>
#include <exception>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "portraits/verify.h"
#include "tests/portraits/sample.h"

namespace {

portrait::Grid grid_named(const std::string& name) {
  if (name == "small") return portrait::sample::small_grid();
  if (name == "none") return portrait::sample::grid_of({});
  std::vector<std::uint64_t> sizes;
  std::istringstream stream(name);
  for (std::string size; std::getline(stream, size, ',');) sizes.push_back(std::stoull(size));
  return portrait::sample::grid_of(sizes);
}

int run(const std::vector<std::string>& words) {
  if (words.size() == 3 && words[0] == "write") {
    portrait::sample::write(words[2], grid_named(words[1]));
    return 0;
  }
  if (words.size() == 3 && (words[0] == "repeat" || words[0] == "single")) {
    portrait::Grid grid = grid_named(words[1]);
    if (words[0] == "single") grid.precision = portrait::Precision::real32;
    portrait::sample::write(words[2], grid, portrait::Existing::refuse, portrait::sample::repeating_columns);
    return 0;
  }
  if (words.size() == 3 && words[0] == "replace") {
    portrait::sample::write(words[2], grid_named(words[1]), portrait::Existing::replace);
    return 0;
  }
  if (words.size() == 2 && words[0] == "verify") {
    for (const auto& dataset : portrait::verify(words[1]).datasets)
      fmt::print("{} {}\n", dataset.digest, dataset.name);
    return 0;
  }
  throw portrait::InputError(
      "usage: sample_portrait write|repeat|single|replace SIZES FILE, or sample_portrait verify FILE");
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
