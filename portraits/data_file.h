/// A file that only grows: blocks of bytes set down one after the other by a thread of its own, each read back and
/// compared with what it should be before anyone relies on it.
///
/// The bytes go past the page cache where the file system can (O_DIRECT): then writing costs the processor almost
/// nothing, and what is read back comes from the disk. Elsewhere they go through it, and set off for the disk early.
///
/// shape     the first kHeadBytes are left to whoever needs them (HDF5's superblock); commits end on whole pages
/// errors    StoreError, at the next call: the thread that writes keeps the first failure and writes nothing more
/// cost      memory: kBlocks blocks of 4 MiB. Time: bench/store_rate.cpp
/// REQUIRES: one thread at a time.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <queue>
#include <span>
#include <thread>
#include <vector>

namespace portrait {

class DataFile {
 public:
  static constexpr std::uint64_t kPage = 4096;  ///< what direct writes are aligned to
  static constexpr std::uint64_t kHeadBytes = kPage;
  static constexpr std::size_t kBlockBytes = std::size_t{4} << 20;
  static constexpr std::size_t kBlocks = 3;

  /// A new file, which must not exist yet.
  static std::unique_ptr<DataFile> create(const std::filesystem::path& path);
  /// An existing one, of which the first `end` bytes stay: `end` as a commit gave it.
  static std::unique_ptr<DataFile> reopen(const std::filesystem::path& path, std::uint64_t end);
  ~DataFile();
  DataFile(const DataFile&) = delete;
  DataFile& operator=(const DataFile&) = delete;

  /// Where the next byte will lie.
  std::uint64_t end() const { return end_; }
  /// The bytes are copied.
  void append(std::span<const std::byte> bytes);
  /// When it returns, everything appended so far is on the disk and was read back. Gives back end().
  std::uint64_t commit();

 private:
  struct Unmapped {
    void operator()(std::byte* memory) const;
  };
  using Memory = std::unique_ptr<std::byte[], Unmapped>;
  struct Block {
    Memory bytes;
    std::size_t size = 0;
    std::uint64_t at = 0;
  };

  DataFile(const std::filesystem::path& path, int flags, std::uint64_t end);
  static Memory new_block();
  void hand_over();
  void check_running();
  void rethrow_failure();
  void write_blocks();
  void put_down(const Block& block);
  void write(const Block& block);
  void check(const Block& block);
  void write_through_the_cache();
  [[noreturn]] void failed(const char* doing) const;

  const std::filesystem::path path_;
  int descriptor_ = -1;
  bool direct_ = true;
  std::uint64_t end_;
  Block current_;
  Memory read_back_;  ///< of the writing thread

  std::mutex mutex_;
  std::condition_variable changed_;
  std::queue<Block> full_;
  std::vector<Memory> free_;
  std::size_t unwritten_ = 0;  ///< blocks handed over and not yet checked
  bool closing_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace portrait
