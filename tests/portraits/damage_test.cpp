// A damaged portrait gives back what was written or one of our errors: never other values, never a crash.
#include <optional>
#include <set>

#include "engine/base/error.h"
#include "portraits/encoded_tile.h"
#include "portraits/reader.h"
#include "portraits/verify.h"
#include "tests/portraits/content.h"
#include "tests/portraits/sample.h"
#include "tests/portraits/scratch.h"

namespace portrait {
namespace {

class Damage : public ScratchTest {
 protected:
  void SetUp() override {
    ScratchTest::SetUp();
    write_sample();
    whole_ = bytes_of(in("whole.h5"));
    content_ = content(in("whole.h5"));
  }

  virtual void write_sample() { sample::write(in("whole.h5"), sample::grid_of({3, 2, 300})); }

  /// What a reader makes of the damaged bytes: their content, or nothing when it throws one of our errors.
  std::optional<std::string> read_damaged(const std::string& bytes) {
    put_bytes(in("damaged.h5"), bytes);
    try {
      return content(in("damaged.h5"));
    } catch (const InputError& error) {
      said_.insert(error.what());
    } catch (const StoreError& error) {
      said_.insert(error.what());
    } catch (const IntegrityError& error) {
      said_.insert(error.what());
    }
    return std::nullopt;
  }

  bool verifies(const std::string& bytes) const {
    put_bytes(in("damaged.h5"), bytes);
    try {
      verify(in("damaged.h5"));
      return true;
    } catch (const InputError&) {
    } catch (const StoreError&) {
    } catch (const IntegrityError&) {
    }
    return false;
  }

  std::string whole_;
  std::string content_;
  std::set<std::string> said_;  ///< messages of read_damaged
};

TEST_F(Damage, FlippedBytes) {
  int found = 0, tried = 0;
  // A prime step walks through all fields of the repeated structures.
  for (std::size_t at = 0; at < whole_.size(); at += 103, ++tried) {
    std::string damaged = whole_;
    damaged[at] = static_cast<char>(damaged[at] ^ (tried % 2 == 0 ? 0xff : 1 << tried % 8));
    const std::optional<std::string> read = read_damaged(damaged);
    EXPECT_TRUE(!read || *read == content_) << "byte " << at << " of " << whole_.size();
    EXPECT_LE(verifies(damaged), read.has_value()) << "verify passes what cannot be read: byte " << at;
    found += read ? 0 : 1;
  }
  EXPECT_GT(tried, 400);
  EXPECT_GT(found, tried / 4) << "a flipped byte of values must be found";
}

// HDF5 gives its index of chunks no checksum, believes the lengths and filters that stand there, and reads beyond
// the end of a chunk whose filter was left out.
TEST_F(Damage, FlippedBytesOfTheChunkIndex) {
  const std::string node = "TREE";
  int nodes = 0, refused = 0;
  for (std::size_t at = whole_.find(node); at != std::string::npos; at = whole_.find(node, at + 1), ++nodes)
    for (std::size_t offset = 0; offset < 150; ++offset) {
      std::string damaged = whole_;
      damaged[at + offset] = static_cast<char>(damaged[at + offset] ^ (offset % 3 == 0 ? 0xff : 1 << offset % 8));
      const std::optional<std::string> read = read_damaged(damaged);
      EXPECT_TRUE(!read || *read == content_) << "byte " << at + offset;
      refused += read ? 0 : 1;
    }
  EXPECT_EQ(nodes, 4) << "one for each column";
  EXPECT_GT(refused, 50);
  EXPECT_TRUE(
      said_.contains(in("damaged.h5").string() + ": IAE_w has a chunk with other filters left out than may be"));
}

TEST_F(Damage, TruncatedFiles) {
  for (std::size_t length = 0; length < whole_.size(); length += 97)
    EXPECT_FALSE(read_damaged(whole_.substr(0, length))) << length << " bytes of " << whole_.size();
  EXPECT_FALSE(read_damaged(whole_.substr(0, whole_.size() - 1)));
}

TEST_F(Damage, BlocksOfZeros) {
  for (std::size_t at = 0; at + 512 <= whole_.size(); at += 512) {
    const std::optional<std::string> read = read_damaged(std::string(whole_).replace(at, 512, 512, '\0'));
    EXPECT_TRUE(!read || *read == content_) << "block at " << at;
  }
}

TEST_F(Damage, TruncationIsToldInTheLibrarysWords) {
  put_bytes(in("damaged.h5"), whole_.substr(0, whole_.size() / 2));
  const std::string message = message_of<IntegrityError>([&] { PortraitReader portrait(in("damaged.h5")); });
  EXPECT_EQ(message.rfind(in("damaged.h5").string() + ": cannot open the file: HDF5: truncated file: eof = ", 0),
            0u)
      << message;
}

/// Somewhere in the values of the measures: they are most of the file, and in its middle.
TEST_F(Damage, DamagedValuesNameTheDatasetAndTheOthersAreStillChecked) {
  std::string damaged = whole_;
  const double value = sample::value(Measure::Ms, 1);
  const std::size_t at = whole_.find(std::string(reinterpret_cast<const char*>(&value), sizeof value));
  ASSERT_NE(at, std::string::npos);
  damaged[at] = static_cast<char>(~damaged[at]);
  put_bytes(in("damaged.h5"), damaged);
  int broken = 0;
  for (const CheckedDataset& dataset : inspect(in("damaged.h5")).datasets) {
    if (dataset.problem.empty()) continue;
    ++broken;
    EXPECT_EQ(dataset.problem, in("damaged.h5").string() + ": " + dataset.name +
                                   " is damaged: the chunk of tile 0 has another checksum");
    EXPECT_EQ(message_of<IntegrityError>([&] { verify(in("damaged.h5")); }), dataset.problem);
  }
  EXPECT_EQ(broken, 1);
  EXPECT_EQ(inspect(in("damaged.h5")).datasets.size(), 10u);
}

/// Every column has one chunk deflated and one plain at least.
class DamageOfChunks : public Damage {
 protected:
  void write_sample() override {
    grid_ = sample::grid_of({4, 4000});
    sample::write(in("whole.h5"), grid_, Existing::refuse, sample::repeating_columns);
  }

  /// The chunk of Ms in the file.
  std::string stored(std::uint64_t tile) const {
    const EncodedTile encoded = encode_tile(grid_, TileRows(grid_), tile, sample::repeating_columns(grid_, tile));
    const std::vector<ChunkRecord>& chunks = encoded.record.chunks;
    EXPECT_EQ(chunks[2].form, tile == 3 ? ChunkForm::plain : ChunkForm::deflated) << tile;
    return {reinterpret_cast<const char*>(encoded.chunks.bytes().data()) + chunks[0].length + chunks[1].length,
            chunks[2].length};
  }

  Grid grid_;
};

TEST_F(DamageOfChunks, EveryDamagedByteIsNoticedDeflatedOrPlain) {
  for (const std::uint64_t tile : {0, 1, 2, 3}) {
    const std::string chunk = stored(tile);
    const std::size_t first = whole_.rfind(chunk);
    ASSERT_NE(first, std::string::npos);
    for (std::size_t at = 0; at < chunk.size(); at += 1 + chunk.size() / 200) {
      std::string damaged = whole_;
      damaged[first + at] = static_cast<char>(damaged[first + at] ^ 1 << at % 8);
      put_bytes(in("damaged.h5"), damaged);
      EXPECT_EQ(message_of<IntegrityError>([&] { verify(in("damaged.h5")); }),
                in("damaged.h5").string() + ": Ms is damaged: the chunk of tile " + std::to_string(tile) +
                    " has another checksum")
          << at;
    }
  }
}

}  // namespace
}  // namespace portrait
