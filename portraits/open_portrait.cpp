#include "portraits/open_portrait.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "portraits/schema.h"

namespace portrait {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError(fmt::format("{}: {}", path.string(), why));
}

void check_readable(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) refuse(path, "there is no such file");
  if (!std::filesystem::is_regular_file(status)) refuse(path, "this is not a file");
  if (access(path.c_str(), R_OK) != 0) refuse(path, fmt::format("cannot read it: {}", std::strerror(errno)));
}

/// The number before the first dot of "1.0.0", or -1.
int major_of(const std::string& version) {
  int major = -1;
  const auto [end, error] = std::from_chars(version.data(), version.data() + version.size(), major);
  const bool dotted = end != version.data() + version.size() && *end == '.';
  return error == std::errc() && dotted ? major : -1;
}

}  // namespace

h5::File open_portrait(const std::filesystem::path& path) {
  check_readable(path);
  if (!h5::is_hdf5(path)) refuse(path, "this is no portrait: it is not an HDF5 file");
  h5::File file = h5::File::open(path);
  if (!file.has("schema_name") || file.text("schema_name") != schema::kName)
    refuse(path, "this is an HDF5 file, but no portrait: its attribute schema_name does not say \"portrait\"");
  const std::string version = file.text("schema_version");
  const int major = major_of(version);
  if (major != schema::kMajor)
    refuse(path, fmt::format("this portrait has format {}; this program reads format {}.x{}", version,
                             schema::kMajor, major > schema::kMajor ? ": use a newer program" : ""));
  return file;
}

}  // namespace portrait
