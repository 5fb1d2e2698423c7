#include "portraits/data_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/uio.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "portraits/digest.h"
#include "portraits/disk.h"

namespace portrait {
namespace {

constexpr mode_t kMode = 0666;

}  // namespace

std::unique_ptr<DataFile> DataFile::create(const std::filesystem::path& path) {
  return std::unique_ptr<DataFile>(new DataFile(path, O_CREAT | O_EXCL, kHeadBytes));
}

std::unique_ptr<DataFile> DataFile::reopen(const std::filesystem::path& path, std::uint64_t end) {
  return std::unique_ptr<DataFile>(new DataFile(path, 0, whole_pages(std::max(end, kHeadBytes))));
}

DataFile::DataFile(const std::filesystem::path& path, int flags, std::uint64_t end) : path_(path), end_(end), written_to_(end) {
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
  thread_ = std::thread([this] { write_pieces(); });
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

void DataFile::failed(const char* doing) const { disk::failed(path_, doing); }

// ---------------------------------------------------------------- whoever appends

void DataFile::append(Piece piece) {
  const std::size_t whole = whole_pages(piece.size);
  std::memset(piece.memory.get() + piece.size, 0, whole - piece.size);
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return unwritten_ < kPieces || failure_; });
  rethrow_failure();
  waiting_.push_back(std::move(piece));
  ++unwritten_;
  end_ += whole;
  changed_.notify_all();
}

std::uint64_t DataFile::commit() {
  {
    std::unique_lock lock(mutex_);
    committing_ = true;
    changed_.notify_all();
    changed_.wait(lock, [&] { return unwritten_ == 0 || failure_; });
    committing_ = false;
    rethrow_failure();
  }
  if (!disk::may("sync") || fdatasync(descriptor_) != 0) failed("sync it");
  return end_;
}

void DataFile::rethrow_failure() {
  if (failure_) std::rethrow_exception(failure_);
}

// ---------------------------------------------------------------- the thread that writes

std::uint64_t DataFile::Row::size() const {
  std::uint64_t size = 0;
  for (const Piece& piece : pieces) size += whole_pages(piece.size);
  return size;
}

void DataFile::write_pieces() {
  std::unique_lock lock(mutex_);
  const auto row_is_due = [&] { return waiting_.size() >= kTogether || (committing_ && !waiting_.empty()); };
  while (true) {
    changed_.wait(lock, [&] { return closing_ || (row_is_due() && !failure_); });
    if (closing_) return;  // what is not committed is not wanted
    Row row = next_row();
    lock.unlock();
    std::exception_ptr failure;
    try {
      put_down(row);
    } catch (...) {
      failure = std::current_exception();
    }
    const std::size_t count = row.pieces.size();
    row.pieces.clear();
    lock.lock();
    if (failure) failure_ = failure;
    unwritten_ -= count;
    changed_.notify_all();
  }
}

DataFile::Row DataFile::next_row() {
  Row row{{}, written_to_};
  for (; !waiting_.empty() && row.pieces.size() < kTogether; waiting_.pop_front())
    row.pieces.push_back(std::move(waiting_.front()));
  written_to_ += row.size();
  return row;
}

void DataFile::put_down(const Row& row) {
  write(row);
  if (!direct_)  // only a hint: commit syncs
    static_cast<void>(sync_file_range(descriptor_, static_cast<off_t>(row.at), static_cast<off_t>(row.size()),
                                      SYNC_FILE_RANGE_WRITE));
  check(row);
}

/// All at once; piece by piece when that does not succeed.
void DataFile::write(const Row& row) {
  iovec parts[kTogether];
  for (std::size_t i = 0; i < row.pieces.size(); ++i)
    parts[i] = {row.pieces[i].memory.get(), whole_pages(row.pieces[i].size)};
  if (row.pieces.size() > 1 && disk::may("write") &&
      pwritev(descriptor_, parts, static_cast<int>(row.pieces.size()), static_cast<off_t>(row.at)) ==
          static_cast<ssize_t>(row.size()))
    return;
  std::uint64_t at = row.at;
  for (const Piece& piece : row.pieces) {
    write(piece, at);
    at += whole_pages(piece.size);
  }
}

void DataFile::write(const Piece& piece, std::uint64_t at) {
  const std::size_t size = whole_pages(piece.size);
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = disk::may("write") ? pwrite(descriptor_, piece.memory.get() + done, size - done,
                                                      static_cast<off_t>(at + done))
                                             : -1;
    if (count > 0)
      done += static_cast<std::size_t>(count);
    else if (count < 0 && errno == EINVAL && direct_)
      write_through_the_cache();
    else if (count == 0 || errno != EINTR)
      failed("write to it");
    // What is left of a write that was cut short need not be aligned.
    if (done < size && done % kPageBytes != 0 && direct_) write_through_the_cache();
  }
}

void DataFile::write_through_the_cache() {
  direct_ = false;
  if (fcntl(descriptor_, F_SETFL, O_RDWR) != 0) failed("write to it");
}

/// A disk that loses what it is given is noticed here.
void DataFile::check(const Row& row) {
  const std::size_t size = row.size();
  if (size > read_back_.get_deleter().bytes) read_back_ = page_memory(size);
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = pread(descriptor_, read_back_.get() + done, size - done, static_cast<off_t>(row.at + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) failed("read back what was written");
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
    if (done < size && done % kPageBytes != 0 && direct_) write_through_the_cache();
  }
  std::size_t first = 0;
  for (const Piece& piece : row.pieces) {
    if (digest_of(std::span<const std::byte>(read_back_.get() + first, piece.size)) != piece.digest)
      throw StoreError(fmt::format("{}: the disk does not give back what was written to it", path_.string()));
    first += whole_pages(piece.size);
  }
}

}  // namespace portrait
