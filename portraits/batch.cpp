#include "portraits/batch.h"

#include <cstring>
#include <stdexcept>

#include "engine/base/error.h"
#include "portraits/digest.h"
#include "portraits/disk.h"

namespace portrait {
namespace {

constexpr std::uint64_t kMagic = 0x3148435441425450;  // "PTBATCH1"

template <typename Value>
void put(std::string& bytes, Value value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Reads what `put` wrote. The bytes are known to be right, so running short is our mistake or another format.
class Cursor {
 public:
  explicit Cursor(const std::string& bytes) : bytes_(bytes) {}
  template <typename Value>
  Value get() {
    Value value{};
    if (left() < sizeof value) throw IntegrityError("it is too short");
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  /// A number of things that follow, each of which has at least 8 bytes.
  std::uint64_t count() {
    const auto count = get<std::uint64_t>();
    if (count > left() / 8) throw IntegrityError("it is too short");
    return count;
  }
  std::size_t left() const { return bytes_.size() - at_; }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

void put_tile(std::string& bytes, const TileRecord& tile) {
  put(bytes, tile.number);
  put(bytes, tile.address);
  put(bytes, tile.stored_digest);
  put(bytes, std::uint64_t{tile.chunks.size()});
  for (const ChunkRecord& chunk : tile.chunks) {
    put(bytes, chunk.length);
    put(bytes, static_cast<std::uint64_t>(chunk.form));
    put(bytes, chunk.digest);
    put(bytes, std::uint64_t{chunk.summary.size()});
    for (const double number : chunk.summary) put(bytes, number);
  }
}

TileRecord get_tile(Cursor& from) {
  TileRecord tile;
  tile.number = from.get<std::uint64_t>();
  tile.address = from.get<std::uint64_t>();
  tile.stored_digest = from.get<std::uint64_t>();
  tile.chunks.resize(from.count());
  for (ChunkRecord& chunk : tile.chunks) {
    chunk.length = from.get<std::uint64_t>();
    chunk.form = static_cast<ChunkForm>(from.get<std::uint64_t>());
    chunk.digest = from.get<std::uint64_t>();
    chunk.summary.resize(from.count());
    for (double& number : chunk.summary) number = from.get<double>();
  }
  return tile;
}

Batch parsed(const std::string& bytes, std::uint64_t fingerprint) {
  constexpr std::size_t kDigestBytes = sizeof(std::uint64_t);
  if (bytes.size() < kDigestBytes) throw IntegrityError("it is too short");
  const std::string content = bytes.substr(0, bytes.size() - kDigestBytes);
  std::uint64_t digest = 0;
  std::memcpy(&digest, bytes.data() + content.size(), kDigestBytes);
  if (digest_of(content) != digest) throw IntegrityError("its digest differs");
  Cursor from(content);
  if (from.get<std::uint64_t>() != kMagic) throw IntegrityError("it is of another format");
  Batch batch;
  batch.fingerprint = from.get<std::uint64_t>();
  if (batch.fingerprint != fingerprint) throw IntegrityError("it belongs to another run");
  batch.data_end = from.get<std::uint64_t>();
  const std::uint64_t tiles = from.count();
  for (std::uint64_t i = 0; i < tiles; ++i) batch.tiles.push_back(get_tile(from));
  return batch;
}

}  // namespace

void write_batch(const std::filesystem::path& path, const Batch& batch) {
  std::string bytes;
  put(bytes, kMagic);
  put(bytes, batch.fingerprint);
  put(bytes, batch.data_end);
  put(bytes, std::uint64_t{batch.tiles.size()});
  for (const TileRecord& tile : batch.tiles) put_tile(bytes, tile);
  put(bytes, digest_of(bytes));
  disk::write_whole_file(path, bytes);
}

std::variant<Batch, std::string> read_batch(const std::filesystem::path& path, std::uint64_t fingerprint) {
  try {
    return parsed(disk::read_whole_file(path), fingerprint);
  } catch (const std::runtime_error& error) {
    return std::string(error.what());
  }
}

}  // namespace portrait
