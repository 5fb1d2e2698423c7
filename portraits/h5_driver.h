/// HDF5's own way to the disk, with these differences.
///
/// Creating: the bytes of chunks are in the file before HDF5 is, and stay where they are. HDF5 makes its file around
/// them: the superblock before, everything else behind, and each chunk where it is told that it lies.
///
/// Writing: a write that fails is remembered, not reported to HDF5. HDF5 1.10 does not survive a failed write. A
/// failed flush leaves a file that can never be closed, a failed close one that is freed again at exit; either ends
/// the process. So HDF5 is told that all is well, writes nothing more, and whoever called it asks afterwards.
///
/// Reading: HDF5 can be asked where a chunk lies without reading it. It has no such question that is fast, and
/// would read as many bytes as an index without a checksum says, whatever room there is.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <H5Cpp.h>

namespace portrait::h5 {

struct WriteFault {
  bool dropping = false;  ///< from now on every write is left undone
  std::string words;      ///< the system's own, of the first write that failed; empty: none did
};

/// Files created with this list are written so.
void remember_failed_writes(const H5::FileAccPropList& list);

/// While one lives, a file that this thread creates has everything but its superblock from byte `end` on.
class Behind {
 public:
  explicit Behind(std::uint64_t end);
  ~Behind();
  Behind(const Behind&) = delete;
  Behind& operator=(const Behind&) = delete;
  std::uint64_t end() const { return end_; }

 private:
  std::uint64_t end_;
};

/// While one lives, the raw values that this thread lets HDF5 write are taken to lie at this place already.
class Placement {
 public:
  Placement(std::uint64_t address, std::uint64_t length);
  ~Placement();
  Placement(const Placement&) = delete;
  Placement& operator=(const Placement&) = delete;

  std::uint64_t address() const { return address_; }
  bool is_of(std::uint64_t length) const { return length == length_; }
  void take() { ++taken_; }
  bool was_taken() const { return taken_ == 2; }  ///< once as space, once as a write

 private:
  std::uint64_t address_, length_;
  int taken_ = 0;
};
/// Files opened with this list can be asked so.
void locate_reads(const H5::FileAccPropList& list);

/// While one lives, what this thread lets HDF5 read of raw values is noted and not read.
class ReadLocator {
 public:
  ReadLocator();
  ~ReadLocator();
  ReadLocator(const ReadLocator&) = delete;
  ReadLocator& operator=(const ReadLocator&) = delete;

  void note(std::uint64_t address, std::uint64_t length) { address_ = address, length_ = length; }
  std::uint64_t address() const { return address_; }
  std::uint64_t length() const { return length_; }  ///< 0: nothing was to be read

 private:
  std::uint64_t address_ = 0, length_ = 0;
};

/// The fault of such a file, for as long as anyone holds it.
std::shared_ptr<WriteFault> fault_of(const H5::H5File& file);

/// The system's descriptor behind an open file.
int& descriptor_of(const H5::H5File& file);

}  // namespace portrait::h5
