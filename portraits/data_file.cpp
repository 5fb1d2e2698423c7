#include "portraits/data_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "portraits/disk.h"

namespace portrait {
namespace {

constexpr mode_t kMode = 0666;

std::uint64_t whole_pages(std::uint64_t bytes) {
  return (bytes + DataFile::kPage - 1) / DataFile::kPage * DataFile::kPage;
}

}  // namespace

std::unique_ptr<DataFile> DataFile::create(const std::filesystem::path& path) {
  return std::unique_ptr<DataFile>(new DataFile(path, O_CREAT | O_EXCL, kHeadBytes));
}

std::unique_ptr<DataFile> DataFile::reopen(const std::filesystem::path& path, std::uint64_t end) {
  return std::unique_ptr<DataFile>(new DataFile(path, 0, whole_pages(std::max(end, kHeadBytes))));
}

DataFile::DataFile(const std::filesystem::path& path, int flags, std::uint64_t end) : path_(path), end_(end) {
  descriptor_ = open(path.c_str(), O_RDWR | O_CLOEXEC | O_DIRECT | flags, kMode);
  if (descriptor_ < 0 && errno == EINVAL) {  // no such thing here; the file may have been made all the same
    direct_ = false;
    descriptor_ = open(path.c_str(), O_RDWR | O_CLOEXEC | (flags & ~O_EXCL), kMode);
  }
  if (descriptor_ < 0) failed("open the file to write to it");
  if (!disk::may("truncate") || ftruncate(descriptor_, static_cast<off_t>(end)) != 0) {
    const int reason = errno;
    close(descriptor_);
    errno = reason;
    failed("cut it to its length");
  }
  current_ = {new_block(), 0, end};
  read_back_ = new_block();
  while (free_.size() + 1 < kBlocks) free_.push_back(new_block());
  thread_ = std::thread([this] { write_blocks(); });
}

DataFile::~DataFile() {
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
  close(descriptor_);
}

void DataFile::Unmapped::operator()(std::byte* memory) const { std::free(memory); }

DataFile::Memory DataFile::new_block() {
  void* memory = std::aligned_alloc(kPage, kBlockBytes);
  if (memory == nullptr) throw std::bad_alloc();
  return Memory(static_cast<std::byte*>(memory));
}

void DataFile::failed(const char* doing) const { disk::failed(path_, doing); }

// ---------------------------------------------------------------- whoever appends

void DataFile::append(std::span<const std::byte> bytes) {
  check_running();
  while (!bytes.empty()) {
    const std::size_t count = std::min(bytes.size(), kBlockBytes - current_.size);
    std::memcpy(current_.bytes.get() + current_.size, bytes.data(), count);
    current_.size += count;
    end_ += count;
    bytes = bytes.subspan(count);
    if (current_.size == kBlockBytes) hand_over();
  }
}

std::uint64_t DataFile::commit() {
  check_running();
  const std::size_t whole = whole_pages(current_.size);
  std::memset(current_.bytes.get() + current_.size, 0, whole - current_.size);
  end_ += whole - current_.size;
  current_.size = whole;
  if (whole > 0) hand_over();
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return unwritten_ == 0 || failure_; });
    rethrow_failure();
  }
  if (!disk::may("sync") || fdatasync(descriptor_) != 0) failed("sync it");
  return end_;
}

/// Waits for a free block: a slow disk slows the sweep and does not fill the memory.
void DataFile::hand_over() {
  std::unique_lock lock(mutex_);
  rethrow_failure();
  full_.push(std::move(current_));
  ++unwritten_;
  changed_.notify_all();
  changed_.wait(lock, [&] { return !free_.empty() || failure_; });
  rethrow_failure();
  current_ = {std::move(free_.back()), 0, end_};
  free_.pop_back();
}

/// After a failure there is no block in hand.
void DataFile::check_running() {
  if (current_.bytes) return;
  const std::scoped_lock lock(mutex_);
  rethrow_failure();
}

void DataFile::rethrow_failure() {
  if (failure_) std::rethrow_exception(failure_);
}

// ---------------------------------------------------------------- the thread that writes

void DataFile::write_blocks() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return closing_ || (!full_.empty() && !failure_); });
    if (closing_) return;  // what is not committed is not wanted
    Block block = std::move(full_.front());
    full_.pop();
    lock.unlock();
    std::exception_ptr failure;
    try {
      put_down(block);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure) failure_ = failure;
    free_.push_back(std::move(block.bytes));
    --unwritten_;
    changed_.notify_all();
  }
}

void DataFile::put_down(const Block& block) {
  write(block);
  if (!direct_)  // only a hint: commit syncs
    static_cast<void>(sync_file_range(descriptor_, static_cast<off_t>(block.at), static_cast<off_t>(block.size),
                                      SYNC_FILE_RANGE_WRITE));
  check(block);
}

void DataFile::write(const Block& block) {
  for (std::size_t done = 0; done < block.size;) {
    const ssize_t count = disk::may("write") ? pwrite(descriptor_, block.bytes.get() + done, block.size - done,
                                                      static_cast<off_t>(block.at + done))
                                             : -1;
    if (count > 0)
      done += static_cast<std::size_t>(count);
    else if (count < 0 && errno == EINVAL && direct_)
      write_through_the_cache();
    else if (count == 0 || errno != EINTR)
      failed("write to it");
    // What is left of a write that was cut short need not be aligned.
    if (done < block.size && done % kPage != 0 && direct_) write_through_the_cache();
  }
}

void DataFile::write_through_the_cache() {
  direct_ = false;
  if (fcntl(descriptor_, F_SETFL, O_RDWR) != 0) failed("write to it");
}

/// A disk that loses what it is given is noticed here.
void DataFile::check(const Block& block) {
  for (std::size_t done = 0; done < block.size;) {
    const ssize_t count =
        pread(descriptor_, read_back_.get() + done, block.size - done, static_cast<off_t>(block.at + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) failed("read back what was written");
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
    if (done < block.size && done % kPage != 0 && direct_) write_through_the_cache();
  }
  if (std::memcmp(block.bytes.get(), read_back_.get(), block.size) != 0)
    throw StoreError(fmt::format("{}: the disk does not give back what was written to it", path_.string()));
}

}  // namespace portrait
