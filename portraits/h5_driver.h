/// HDF5's own way to the disk, with one difference: a write that fails is remembered, not reported to HDF5.
///
/// HDF5 1.10 does not survive a failed write. A failed flush leaves a file that can never be closed, a failed close one
/// that is freed again at exit; either ends the process. So HDF5 is told that all is well, writes nothing more, and
/// whoever called it asks afterwards. Reading is not touched.
#pragma once

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

/// The fault of such a file, for as long as anyone holds it.
std::shared_ptr<WriteFault> fault_of(const H5::H5File& file);

/// The system's descriptor behind an open file.
int& descriptor_of(const H5::H5File& file);

}  // namespace portrait::h5
