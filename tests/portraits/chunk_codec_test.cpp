// Chunks made here come back, and damage to them is told. That HDF5 reads them too: chunks_by_h5py.py.
#include "portraits/chunk_codec.h"

#include <random>

#include <gtest/gtest.h>

#include "portraits/fletcher32.h"

namespace portrait {
namespace {

using Bytes = std::vector<std::byte>;

Bytes random_bytes(std::size_t size, std::mt19937& random) {
  Bytes bytes(size);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
  return bytes;
}

/// Word by word, as it is defined.
std::uint32_t slow_fletcher32(const Bytes& bytes) {
  std::uint64_t first = 0, second = 0;
  for (std::size_t at = 0; at < bytes.size(); at += 2) {
    const unsigned low = at + 1 < bytes.size() ? std::to_integer<unsigned>(bytes[at + 1]) : 0;
    first += std::to_integer<unsigned>(bytes[at]) << 8 | low;
    if (first > 65535) first -= 65535;
    second += first;
    if (second > 65535) second -= 65535;
  }
  return static_cast<std::uint32_t>(second << 16 | first);
}

TEST(Fletcher32, IsThatOfItsDefinition) {
  std::mt19937 random(5);
  for (std::size_t size = 0; size < 200; ++size) {
    const Bytes bytes = random_bytes(size, random);
    EXPECT_EQ(fletcher32(bytes), slow_fletcher32(bytes)) << size;
  }
  for (const std::size_t size : {4095, 4096, 4097, 8192, 100'001})
    for (const Bytes& bytes : {random_bytes(size, random), Bytes(size, std::byte{0xff}), Bytes(size, std::byte{0})})
      EXPECT_EQ(fletcher32(bytes), slow_fletcher32(bytes)) << size;
}

/// A new value where `i % of < changing`.
Bytes values_with(std::size_t count, std::size_t changing, std::size_t of, std::mt19937& random) {
  Bytes values = random_bytes(8, random);
  while (values.size() < 8 * count) {
    const Bytes value =
        values.size() / 8 % of < changing ? random_bytes(8, random) : Bytes(values.end() - 8, values.end());
    values.insert(values.end(), value.begin(), value.end());
  }
  return values;
}

TEST(ChunkCodec, HalfTheValuesMustEqualTheTwoBefore) {
  std::mt19937 random(6);
  EXPECT_TRUE(repeats(values_with(1000, 1, 4, random), 8));
  EXPECT_FALSE(repeats(values_with(1000, 2, 5, random), 8));
  EXPECT_FALSE(repeats(values_with(1000, 1, 2, random), 8)) << "pairs are too short to gain anything";
  EXPECT_TRUE(repeats(Bytes(1024), 1));
  EXPECT_TRUE(repeats(Bytes(1024), 4));
  EXPECT_FALSE(repeats(Bytes(8), 8)) << "a single value repeats nothing";
}

class Decoding : public ::testing::Test {
 protected:
  Bytes plain_chunk() const {
    Bytes chunk = values_;
    append_checksum(chunk);
    return chunk;
  }
  std::string_view decode(const Bytes& stored, ChunkForm form) { return decode_chunk(stored, form, 8, back_); }

  std::mt19937 random_{7};
  const Bytes values_ = values_with(500, 1, 4, random_);
  Bytes back_ = Bytes(values_.size());
};

TEST_F(Decoding, GivesTheValuesBack) {
  EXPECT_EQ(decode(deflated_chunk(values_, 8), ChunkForm::deflated), "");
  EXPECT_EQ(back_, values_);
  back_.assign(values_.size(), std::byte{});
  EXPECT_EQ(decode(plain_chunk(), ChunkForm::plain), "");
  EXPECT_EQ(back_, values_);
}

TEST_F(Decoding, TellsWhatIsWrong) {
  EXPECT_EQ(decode({}, ChunkForm::plain), "is too short");
  EXPECT_EQ(decode(Bytes(4), ChunkForm::deflated), "is too short");
  Bytes damaged = plain_chunk();
  damaged[17] ^= std::byte{1};
  EXPECT_EQ(decode(damaged, ChunkForm::plain), "has another checksum");
  EXPECT_EQ(decode(deflated_chunk(values_, 8), ChunkForm::plain), "has another length");
  EXPECT_EQ(decode(plain_chunk(), ChunkForm::deflated), "does not inflate to its length");
  EXPECT_EQ(decode(deflated_chunk(Bytes(values_.begin(), values_.end() - 8), 8), ChunkForm::deflated),
            "does not inflate to its length");
  Bytes longer = deflated_chunk(values_, 8);
  longer.resize(longer.size() - kChecksumBytes + 1);
  append_checksum(longer);
  EXPECT_EQ(decode(longer, ChunkForm::deflated), "does not inflate to its length");
}

}  // namespace
}  // namespace portrait
