/// Whether a portrait still is what was written: every dataset read in full and held against its digests.
///
/// Not looked at: the references between datasets and their dimension scales, which only other programs follow.
/// HDF5 1.10 keeps them without a checksum, and following damaged ones ends the process (in H5HG_read).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace portrait {

struct CheckedDataset {
  std::string name;
  std::string digest;   ///< of the values, 16 hexadecimal digits, as the file says
  std::string problem;  ///< empty when the values are those that were written
};

struct VerifyReport {
  std::vector<CheckedDataset> datasets;  ///< axes and fixed parameters, measures, status
};

/// Reads everything, goes on after a damaged column, and reports all. Throws as PortraitReader does when the
/// file cannot be opened as a portrait or its grid is damaged. Columns are shared among threads; 0: as many as the
/// machine has.
VerifyReport inspect(const std::filesystem::path& path, int threads = 0);

/// As inspect, yet throws IntegrityError when any dataset has a problem: its first line is that of the first
/// such dataset, then one line for every other.
VerifyReport verify(const std::filesystem::path& path, int threads = 0);

}  // namespace portrait
