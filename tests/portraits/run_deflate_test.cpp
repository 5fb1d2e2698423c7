// Whatever is deflated, zlib inflates to the same bytes, shuffled.
#include "portraits/run_deflate.h"

#include <random>

#include <gtest/gtest.h>
#include <zlib.h>

namespace portrait {
namespace {

using Bytes = std::vector<std::byte>;

Bytes shuffled(const Bytes& values, std::size_t element) {
  Bytes bytes;
  for (std::size_t byte = 0; byte < element; ++byte)
    for (std::size_t at = byte; at < values.size(); at += element) bytes.push_back(values[at]);
  return bytes;
}

/// zlib refuses a stream whose Adler-32 is not that of what it inflates to.
Bytes inflated(const Bytes& stream, std::size_t size) {
  Bytes bytes(size);
  uLongf length = size;
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                       reinterpret_cast<const Bytef*>(stream.data()), stream.size()),
            Z_OK);
  EXPECT_EQ(length, size);
  return bytes;
}

/// `count` values in runs of a length up to `longest`, bytes of every kind.
Bytes in_runs(std::size_t count, std::size_t element, std::size_t longest, std::mt19937& random) {
  Bytes values;
  while (values.size() < count * element) {
    Bytes value(element);
    for (std::byte& byte : value) byte = static_cast<std::byte>(random());
    for (std::size_t run = 1 + random() % longest; run > 0 && values.size() < count * element; --run)
      values.insert(values.end(), value.begin(), value.end());
  }
  return values;
}

TEST(RunDeflate, ZlibInflatesWhatWasThere) {
  std::mt19937 random(3);
  for (const std::size_t element : {1, 4, 8})
    for (const std::size_t count : {1, 2, 5, 100, 1024, 70'000})
      for (const std::size_t longest : {1, 2, 4, 9, 300, 100'000}) {
        const Bytes values = in_runs(count, element, longest, random);
        EXPECT_EQ(inflated(deflate_runs(values, element), values.size()), shuffled(values, element))
            << count << " values of " << element << " bytes, runs up to " << longest;
      }
}

/// Around 3 and 258, the shortest and the longest match, and where one more is needed for a rest that is too short.
TEST(RunDeflate, RunsOfEveryLength) {
  for (std::size_t length = 1; length < 800; ++length) {
    Bytes values(length, std::byte{200});
    values.insert(values.end(), {std::byte{1}, std::byte{2}});
    EXPECT_EQ(inflated(deflate_runs(values, 1), values.size()), values) << length;
  }
}

TEST(RunDeflate, ARunShrinksAndTheRestGrowsByAnEighthAtMost) {
  std::mt19937 random(4);
  EXPECT_LT(deflate_runs(Bytes(8192, std::byte{7}), 8).size(), 100u);
  EXPECT_LE(deflate_runs(in_runs(1024, 8, 1, random), 8).size(), 8192u / 8 * 9 + 10);
}

}  // namespace
}  // namespace portrait
