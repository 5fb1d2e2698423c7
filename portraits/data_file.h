/// A file that only grows: pieces of bytes set down one after the other by a thread of its own, each read back and
/// held against its digest before anyone relies on it.
///
/// The bytes go past the page cache where the file system can (O_DIRECT): then writing costs the processor almost
/// nothing, and what is read back comes from the disk. Elsewhere they go through it, and set off for the disk early.
///
/// shape     the first kHeadBytes are left to whoever needs them (HDF5's superblock); every piece begins with a page
/// errors    StoreError, at the next call: the thread that writes keeps the first failure and writes nothing more
/// cost      memory: kPieces pieces, and kTogether that are read back. Time: bench/store_rate.cpp
/// REQUIRES: one thread at a time.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "portraits/page_memory.h"

namespace portrait {

/// Bytes on their way to a file, and their digest (portraits/digest.h).
struct Piece {
  PageMemory memory;
  std::size_t size = 0;
  std::uint64_t digest = 0;
  std::span<const std::byte> bytes() const { return {memory.get(), size}; }
};

class DataFile {
 public:
  static constexpr std::uint64_t kHeadBytes = kPageBytes;
  static constexpr std::size_t kPieces = 8;    ///< handed over and not yet written
  static constexpr std::size_t kTogether = 4;  ///< go to the disk in one call: each call costs, whatever it carries

  /// A new file, which must not exist yet.
  static std::unique_ptr<DataFile> create(const std::filesystem::path& path);
  /// An existing one, of which the first `end` bytes stay: `end` as a commit gave it.
  static std::unique_ptr<DataFile> reopen(const std::filesystem::path& path, std::uint64_t end);
  ~DataFile();
  DataFile(const DataFile&) = delete;
  DataFile& operator=(const DataFile&) = delete;

  /// Where the next piece will lie: a multiple of kPageBytes.
  std::uint64_t end() const { return end_; }
  /// Waits while kPieces are unwritten: a slow disk slows the sweep and does not fill the memory.
  void append(Piece piece);
  /// When it returns, everything appended so far is on the disk and was read back. Gives back end().
  std::uint64_t commit();

 private:
  /// Pieces that follow each other in the file.
  struct Row {
    std::vector<Piece> pieces;
    std::uint64_t at = 0;
    std::uint64_t size() const;  ///< in whole pages
  };

  DataFile(const std::filesystem::path& path, int flags, std::uint64_t end);
  void rethrow_failure();
  void write_pieces();
  Row next_row();
  void put_down(const Row& row);
  void write(const Row& row);
  void write(const Piece& piece, std::uint64_t at);
  void check(const Row& row);
  void write_through_the_cache();
  [[noreturn]] void failed(const char* doing) const;

  const std::filesystem::path path_;
  int descriptor_ = -1;
  bool direct_ = true;
  std::uint64_t end_;
  PageMemory read_back_;  ///< of the writing thread

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Piece> waiting_;
  std::uint64_t written_to_;   ///< where the first that waits will lie
  std::size_t unwritten_ = 0;  ///< pieces handed over and not yet checked
  bool committing_ = false;    ///< no row need be full
  bool closing_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace portrait
