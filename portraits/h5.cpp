#include "portraits/h5.h"

#include <bit>
#include <cerrno>
#include <cstring>
#include <utility>

#include <H5Cpp.h>
#include <fmt/format.h>
#include <hdf5_hl.h>
#include <unistd.h>

#include "portraits/h5_call.h"
#include "portraits/h5_driver.h"
#include "portraits/h5_layout.h"

namespace portrait::h5 {
namespace {

static_assert(std::endian::native == std::endian::little, "digests are of the bytes in memory");

H5::FileCreatPropList file_creation() {
  H5::FileCreatPropList list;
  keep_order(list.getId());
  return list;
}

H5::FileAccPropList writing() {
  H5::FileAccPropList list;
  list.setFcloseDegree(H5F_CLOSE_STRONG);
  list.setLibverBounds(H5F_LIBVER_V18, H5F_LIBVER_V18);
  remember_failed_writes(list);
  return list;
}

/// A published portrait never changes: reading needs no lock, and some network file systems have none.
H5::FileAccPropList reading() {
  H5::FileAccPropList list;
  list.setFcloseDegree(H5F_CLOSE_STRONG);
  called(H5Pset_file_locking(list.getId(), false, true));
  locate_reads(list);
  return list;
}

}  // namespace

Dataset::Dataset(std::shared_ptr<H5::DataSet> dataset, Layout layout, std::shared_ptr<const Origin> origin,
                 std::string name)
    : Object(dataset, std::move(origin), std::move(name)),
      dataset_(std::move(dataset)),
      layout_(std::move(layout)) {}

void Dataset::place_chunk(const std::vector<std::uint64_t>& start, const ChunkPlace& place) const {
  const std::vector<hsize_t> first(start.begin(), start.end());
  guarded(origin(), "write " + name(), [&] {
    const Placement placement(place.address, place.length);
    const std::byte nothing{};  // HDF5 hands it on to our driver, which does not look at it
    called(H5Dwrite_chunk(dataset_->getId(), H5P_DEFAULT, static_cast<std::uint32_t>(place.form), first.data(),
                          place.length, &nothing));
    if (!placement.was_taken()) fail(origin(), "HDF5 puts a chunk elsewhere than where it lies");
  });
}

// The length of a chunk and the filters it went through stand in an index that HDF5 does not checksum.
ChunkPlace Dataset::place_of_chunk(const std::vector<std::uint64_t>& start) const {
  const std::vector<hsize_t> first(start.begin(), start.end());
  const std::uint64_t plain = Layout{layout_.element, layout_.chunk, {}}.bytes();
  return guarded(origin(), "read " + name(), [&] {
    const ReadLocator place;
    std::uint32_t left_out = 0;
    std::byte nothing{};
    called(H5Dread_chunk(dataset_->getId(), H5P_DEFAULT, first.data(), &left_out, &nothing));
    if (place.length() == 0) fail(origin(), fmt::format("{} has no chunk at {}", name(), fmt::join(start, ",")));
    if (place.length() > plain + plain / 512 + 64) fail(origin(), name() + " has a chunk of impossible length");
    const auto form = static_cast<ChunkForm>(left_out);
    if (form != ChunkForm::deflated && form != ChunkForm::plain)
      fail(origin(), name() + " has a chunk with other filters left out than may be");
    return ChunkPlace{place.address(), place.length(), form};
  });
}

ChunkForm Dataset::read_chunk(const std::vector<std::uint64_t>& start, std::vector<std::byte>& stored) const {
  const ChunkPlace place = place_of_chunk(start);
  const auto beyond_end = [&] { fail(origin(), name() + " has a chunk beyond the end of the file"); };
  if (place.address > origin().bytes || place.length > origin().bytes - place.address) beyond_end();
  stored.resize(place.length);
  const ssize_t got = pread(origin().descriptor, stored.data(), stored.size(), static_cast<off_t>(place.address));
  if (got < 0) fail(origin(), fmt::format("cannot read {}: {}", name(), std::strerror(errno)), true);
  if (static_cast<std::size_t>(got) != stored.size()) beyond_end();
  return place.form;
}

void Dataset::write_all(const void* from) const {
  guarded(origin(), "write " + name(), [&] { dataset_->write(from, type_of(layout_.element)); });
}

void Dataset::copy_from(std::uint64_t address) const {
  std::uint64_t value = 0;
  const std::size_t size = size_of(layout_.element);
  const ssize_t got = pread(origin().descriptor, &value, size, static_cast<off_t>(address));
  if (got != static_cast<ssize_t>(size)) fail(origin(), fmt::format("cannot read {}: {}", name(), std::strerror(errno)));
  write_all(&value);
}

void Dataset::read_all(void* into) const {
  guarded(origin(), "read " + name(), [&] {
    if (dataset_->getStorageSize() != layout_.bytes()) fail(origin(), name() + " has another size than its shape");
    dataset_->read(into, type_of(layout_.element));
  });
}

void Dataset::make_scale(const std::string& dimension) const {
  guarded(origin(), "make a dimension scale of " + name(),
          [&] { called(H5DSset_scale(dataset_->getId(), dimension.c_str())); });
}

void Dataset::attach_scale(std::uint32_t axis, const Dataset& scale, const std::string& label) const {
  guarded(origin(), fmt::format("attach {} to {}", scale.name(), name()), [&] {
    called(H5DSattach_scale(dataset_->getId(), scale.dataset_->getId(), axis));
    called(H5DSset_label(dataset_->getId(), axis, label.c_str()));
  });
}

File::File(std::shared_ptr<H5::H5File> file, std::shared_ptr<const Origin> origin)
    : Object(file, std::move(origin), ""), file_(std::move(file)) {}

File File::create_behind(const std::filesystem::path& path, std::uint64_t end) {
  const auto origin = std::make_shared<Origin>(Origin{path.string(), true, 0, -1, nullptr});
  return guarded(*origin, "make an HDF5 file of it", [&] {
    const Behind behind(end);
    auto file = std::make_shared<H5::H5File>(path.string(), H5F_ACC_TRUNC, file_creation(), writing());
    origin->fault = fault_of(*file);
    origin->descriptor = descriptor_of(*file);
    haddr_t used = 0;
    called(H5Fget_eoa(file->getId(), &used));
    if (used <= end) fail(*origin, "HDF5 puts more than its superblock before the chunks");
    return File(std::move(file), origin);
  });
}

File File::open(const std::filesystem::path& path) {
  const auto origin =
      std::make_shared<Origin>(Origin{path.string(), false, std::filesystem::file_size(path), -1, nullptr});
  return guarded(*origin, "open the file", [&] {
    const auto& defaults = H5::FileCreatPropList::DEFAULT;
    auto file = std::make_shared<H5::H5File>(path.string(), H5F_ACC_RDONLY, defaults, reading());
    origin->descriptor = descriptor_of(*file);
    return File(std::move(file), origin);
  });
}

void File::create_group(const std::string& name) const {
  guarded(origin(), "create the group " + name, [&] {
    const H5::PropList list(H5P_GROUP_CREATE);
    keep_order(list.getId());
    called(H5Gclose(called(H5Gcreate2(file_->getId(), name.c_str(), H5P_DEFAULT, list.getId(), H5P_DEFAULT))));
  });
}

Dataset File::create_dataset(const std::string& name, const Layout& layout) const {
  return guarded(origin(), "create " + name, [&] {
    auto made = file_->createDataSet(name, type_of(layout.element), space_of(layout.extent),
                                     dataset_creation(layout), dataset_access());
    return Dataset(std::make_shared<H5::DataSet>(std::move(made)), layout, shared_origin(), name);
  });
}

bool File::contains(const std::string& name) const {
  return guarded(origin(), "look for " + name, [&] { return file_->nameExists(name); });
}

Dataset File::dataset(const std::string& name) const {
  return guarded(origin(), "open " + name, [&] {
    if (!file_->nameExists(name)) fail(origin(), name + " is missing");
    const auto found = std::make_shared<H5::DataSet>(file_->openDataSet(name, dataset_access()));
    const std::optional<Layout> layout = layout_of(*found);
    if (!layout) fail(origin(), name + " has values of an unknown type");
    return Dataset(found, *layout, shared_origin(), name);
  });
}

void File::close() {
  guarded(origin(), "close the file", [&] { file_->close(); });
}

void File::abandon() {
  origin().fault->dropping = true;
  guarded(origin(), "abandon the file", [&] { file_->close(); });
}

bool is_hdf5(const std::filesystem::path& path) {
  Listener listener;
  return H5Fis_hdf5(path.c_str()) > 0;
}

std::string library_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

}  // namespace portrait::h5
