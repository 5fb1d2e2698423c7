#include "portraits/h5.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include <H5Cpp.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <hdf5_hl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "engine/base/error.h"

namespace portrait::h5 {
namespace {

static_assert(std::endian::native == std::endian::little, "digests are of the bytes in memory");

/// On 24 measures of 64 x 64 PI loops, shuffled: level 1 makes doubles 1.388 times smaller, level 4 1.398 times and
/// slower; floats 1.498 and 1.514 times.
constexpr unsigned kDeflateLevel = 1;
constexpr std::uint64_t kLongestText = std::uint64_t{64} << 20;
constexpr unsigned kCreationOrder = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;

/// A failed call of the C interface; what went wrong was heard by the Listener.
struct CallFailed {};

template <typename Result>
Result called(Result result) {
  if (result < 0) throw CallFailed{};
  return result;
}

/// Hears HDF5's error stack at the call that failed, before closing other objects clears it.
class Listener {
 public:
  Listener() { H5Eset_auto2(H5E_DEFAULT, hear, this); }
  ~Listener() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// The system's own words when it was the system that failed.
  std::string words() const { return system_failed() ? system_words() : words_; }
  bool system_failed() const { return words_.find("errno = ") != std::string::npos; }

 private:
  static herr_t hear(hid_t stack, void* self) {
    auto& listener = *static_cast<Listener*>(self);
    if (listener.words_.empty()) H5Ewalk2(stack, H5E_WALK_UPWARD, keep_innermost, self);
    return 0;
  }
  static herr_t keep_innermost(unsigned depth, const H5E_error2_t* error, void* self) {
    if (depth == 0) static_cast<Listener*>(self)->words_ = error->desc;
    return 0;
  }
  /// "... errno = 28, error message = 'No space left on device', ..." to the message.
  std::string system_words() const {
    const std::string before = "error message = '";
    const std::size_t found = words_.find(before);
    if (found == std::string::npos) return words_;
    const std::size_t first = found + before.size();
    return words_.substr(first, words_.find('\'', first) - first);
  }

  std::string words_;
};

[[noreturn]] void fail(const Origin& origin, const std::string& what, bool system_failed = false) {
  const std::string message = fmt::format("{}: {}", origin.file, what);
  if (origin.writing || system_failed) throw StoreError(message);
  throw IntegrityError(message);
}

/// Runs work that calls HDF5; its failure becomes "FILE: cannot DO: the library's words".
template <typename Work>
auto guarded(const Origin& origin, const std::string& doing, Work work) {
  Listener listener;
  try {
    return work();
  } catch (const H5::Exception& exception) {
    const std::string words = listener.words().empty() ? exception.getDetailMsg() : listener.words();
    fail(origin, fmt::format("cannot {}: HDF5: {}", doing, words), listener.system_failed());
  } catch (const CallFailed&) {
    fail(origin, fmt::format("cannot {}: HDF5: {}", doing, listener.words()), listener.system_failed());
  }
}

const H5::PredType& type_of(Element element) {
  switch (element) {
    case Element::real64:
      return H5::PredType::IEEE_F64LE;
    case Element::real32:
      return H5::PredType::IEEE_F32LE;
    case Element::uint8:
      return H5::PredType::STD_U8LE;
    case Element::uint64:
      return H5::PredType::STD_U64LE;
  }
  return H5::PredType::IEEE_F64LE;
}

H5::DataSpace space_of(const std::vector<std::uint64_t>& extent) {
  if (extent.empty()) return H5::DataSpace(H5S_SCALAR);
  const std::vector<hsize_t> sizes(extent.begin(), extent.end());
  return H5::DataSpace(static_cast<int>(sizes.size()), sizes.data());
}

std::vector<std::uint64_t> extent_of(const H5::DataSpace& space) {
  std::vector<hsize_t> sizes(static_cast<std::size_t>(space.getSimpleExtentNdims()));
  if (!sizes.empty()) space.getSimpleExtentDims(sizes.data());
  return {sizes.begin(), sizes.end()};
}

H5::DataSpace box_in(const H5::DataSet& dataset, const std::vector<std::uint64_t>& start,
                     const std::vector<std::uint64_t>& extent) {
  H5::DataSpace space = dataset.getSpace();
  if (start.empty()) return space;
  const std::vector<hsize_t> first(start.begin(), start.end()), count(extent.begin(), extent.end());
  space.selectHyperslab(H5S_SELECT_SET, count.data(), first.data());
  return space;
}

H5::StrType text_type(std::size_t length) {
  H5::StrType type(H5::PredType::C_S1, std::max<std::size_t>(length, 1));
  type.setCset(H5T_CSET_UTF8);
  type.setStrpad(H5T_STR_NULLPAD);
  return type;
}

void chunk_and_filter(const H5::DSetCreatPropList& list, const Layout& layout) {
  const std::vector<hsize_t> chunk(layout.chunk.begin(), layout.chunk.end());
  list.setChunk(static_cast<int>(chunk.size()), chunk.data());
  list.setShuffle();
  // Mandatory, so that no chunk is stored with a filter left out: reading counts on it.
  called(H5Pset_filter(list.getId(), H5Z_FILTER_DEFLATE, H5Z_FLAG_MANDATORY, 1, &kDeflateLevel));
  list.setFletcher32();
}

void set_fill(const H5::DSetCreatPropList& list, Element element) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::uint64_t zero = 0;
  if (element == Element::real64 || element == Element::real32)
    list.setFillValue(H5::PredType::NATIVE_DOUBLE, &nan);
  else
    list.setFillValue(H5::PredType::NATIVE_UINT64, &zero);
}

H5::DSetCreatPropList creation_of(const Layout& layout) {
  H5::DSetCreatPropList list;
  // Attributes stay in the header, where HDF5 checksums them and finds them at once.
  called(H5Pset_attr_phase_change(list.getId(), 64, 60));
  called(H5Pset_attr_creation_order(list.getId(), kCreationOrder));
  called(H5Pset_obj_track_times(list.getId(), false));
  set_fill(list, layout.element);
  if (!layout.chunk.empty()) chunk_and_filter(list, layout);
  return list;
}

/// Of a group, the root among them: names and attributes keep their order, nothing depends on the time of day.
void keep_order(hid_t list) {
  called(H5Pset_link_creation_order(list, kCreationOrder));
  called(H5Pset_attr_creation_order(list, kCreationOrder));
  called(H5Pset_obj_track_times(list, false));
}

H5::FileCreatPropList file_creation() {
  H5::FileCreatPropList list;
  keep_order(list.getId());
  return list;
}

H5::FileAccPropList file_access(bool writing) {
  H5::FileAccPropList list;
  list.setFcloseDegree(H5F_CLOSE_STRONG);
  list.setLibverBounds(H5F_LIBVER_V18, H5F_LIBVER_V18);
  list.setSieveBufSize(0);
  // A published portrait never changes: reading needs no lock, and some network file systems have none.
  if (!writing) called(H5Pset_file_locking(list.getId(), false, true));
  return list;
}

/// HDF5 writes straight to the disk: tiles are whole chunks, so caching them gains nothing, and a dataset that holds
/// nothing back can be closed even when the disk is full.
H5::DSetAccPropList uncached() {
  H5::DSetAccPropList list;
  list.setChunkCache(0, 0, 1);
  return list;
}

/// The system's descriptor behind an open file.
int& descriptor_of(const H5::H5File& file) {
  void* descriptor = nullptr;
  called(H5Fget_vfd_handle(file.getId(), H5P_DEFAULT, &descriptor));
  return *static_cast<int*>(descriptor);
}

/// From here on what HDF5 writes goes to memory that nobody reads.
void write_nowhere(const H5::H5File& file) {
  const int nowhere = memfd_create("abandoned portrait", MFD_CLOEXEC);
  if (nowhere < 0) return;
  dup3(nowhere, descriptor_of(file), O_CLOEXEC);
  close(nowhere);
}

std::string quoted(const std::string& attribute, const Object& object) {
  return object.name().empty() ? fmt::format("attribute {}", attribute)
                               : fmt::format("attribute {} of {}", attribute, object.name());
}

std::optional<Element> element_of(const H5::DataSet& dataset) {
  const H5::DataType type = dataset.getDataType();
  for (const Element element : {Element::real64, Element::real32, Element::uint8, Element::uint64})
    if (type == type_of(element)) return element;
  return std::nullopt;
}

std::vector<std::uint64_t> chunk_of(const H5::DataSet& dataset, std::size_t axes) {
  const H5::DSetCreatPropList list = dataset.getCreatePlist();
  if (list.getLayout() != H5D_CHUNKED) return {};
  std::vector<hsize_t> chunk(axes);
  list.getChunk(static_cast<int>(axes), chunk.data());
  return {chunk.begin(), chunk.end()};
}

H5::Attribute open_attribute(const H5::H5Object& object, const Origin& origin, const std::string& attribute,
                             const std::string& place) {
  if (!object.attrExists(attribute)) fail(origin, place + " is missing");
  H5::Attribute found = object.openAttribute(attribute);
  if (found.getSpace().getSimpleExtentNpoints() != 1) fail(origin, place + " is not a single value");
  return found;
}

}  // namespace

std::size_t size_of(Element element) {
  switch (element) {
    case Element::real32:
      return 4;
    case Element::uint8:
      return 1;
    default:
      return 8;
  }
}

std::uint64_t Layout::count() const {
  return std::accumulate(extent.begin(), extent.end(), std::uint64_t{1}, std::multiplies<>());
}

std::uint64_t Layout::bytes() const { return count() * size_of(element); }

Object::Object(std::shared_ptr<H5::H5Object> object, std::shared_ptr<const Origin> origin, std::string name)
    : object_(std::move(object)), origin_(std::move(origin)), name_(std::move(name)) {}

void Object::set_text(const std::string& attribute, const std::string& text) const {
  guarded(*origin_, "write " + quoted(attribute, *this), [&] {
    const H5::StrType type = text_type(text.size());
    object_->createAttribute(attribute, type, H5::DataSpace(H5S_SCALAR)).write(type, text.c_str());
  });
}

void Object::set_texts(const std::string& attribute, const std::vector<std::string>& texts) const {
  std::size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  std::string padded;
  for (const std::string& text : texts) padded += text + std::string(longest - text.size(), '\0');
  guarded(*origin_, "write " + quoted(attribute, *this), [&] {
    const H5::StrType type = text_type(longest);
    object_->createAttribute(attribute, type, space_of({texts.size()})).write(type, padded.data());
  });
}

void Object::set_integer(const std::string& attribute, std::int64_t value) const {
  guarded(*origin_, "write " + quoted(attribute, *this), [&] {
    object_->createAttribute(attribute, H5::PredType::STD_I64LE, H5::DataSpace(H5S_SCALAR))
        .write(H5::PredType::NATIVE_INT64, &value);
  });
}

void Object::set_real(const std::string& attribute, double value, Element element) const {
  guarded(*origin_, "write " + quoted(attribute, *this), [&] {
    object_->createAttribute(attribute, type_of(element), H5::DataSpace(H5S_SCALAR))
        .write(H5::PredType::NATIVE_DOUBLE, &value);
  });
}

void Object::set_bytes(const std::string& attribute, const std::vector<std::uint8_t>& values) const {
  guarded(*origin_, "write " + quoted(attribute, *this), [&] {
    object_->createAttribute(attribute, H5::PredType::STD_U8LE, space_of({values.size()}))
        .write(H5::PredType::NATIVE_UINT8, values.data());
  });
}

bool Object::has(const std::string& attribute) const {
  return guarded(*origin_, "look for " + quoted(attribute, *this), [&] { return object_->attrExists(attribute); });
}

std::string Object::text(const std::string& attribute) const {
  const std::string place = quoted(attribute, *this);
  return guarded(*origin_, "read " + place, [&] {
    const H5::Attribute found = open_attribute(*object_, *origin_, attribute, place);
    if (found.getTypeClass() != H5T_STRING) fail(*origin_, place + " is not a text");
    if (found.getInMemDataSize() > std::min(kLongestText, origin_->bytes)) fail(*origin_, place + " is too long");
    std::string text;
    found.read(found.getStrType(), text);
    return text;
  });
}

std::int64_t Object::integer(const std::string& attribute) const {
  const std::string place = quoted(attribute, *this);
  return guarded(*origin_, "read " + place, [&] {
    const H5::Attribute found = open_attribute(*object_, *origin_, attribute, place);
    if (found.getTypeClass() != H5T_INTEGER) fail(*origin_, place + " is not a whole number");
    std::int64_t value = 0;
    found.read(H5::PredType::NATIVE_INT64, &value);
    return value;
  });
}

double Object::real(const std::string& attribute) const {
  const std::string place = quoted(attribute, *this);
  return guarded(*origin_, "read " + place, [&] {
    const H5::Attribute found = open_attribute(*object_, *origin_, attribute, place);
    if (found.getTypeClass() != H5T_FLOAT) fail(*origin_, place + " is not a real number");
    double value = 0;
    found.read(H5::PredType::NATIVE_DOUBLE, &value);
    return value;
  });
}

Dataset::Dataset(std::shared_ptr<H5::DataSet> dataset, Layout layout, std::shared_ptr<const Origin> origin,
                 std::string name)
    : Object(dataset, std::move(origin), std::move(name)),
      dataset_(std::move(dataset)),
      layout_(std::move(layout)) {}

void Dataset::write(const std::vector<std::uint64_t>& start, const std::vector<std::uint64_t>& extent,
                    const void* from) const {
  guarded(origin(), "write " + name(), [&] {
    dataset_->write(from, type_of(layout_.element), space_of(extent), box_in(*dataset_, start, extent));
  });
}

// The length of a chunk and the filters it went through stand in an index that HDF5 does not checksum. A
// wrong length would become a wrong allocation, a skipped filter a read beyond the end of the decoded chunk.
void Dataset::check_chunk(const std::vector<std::uint64_t>& start) const {
  const std::vector<hsize_t> first(start.begin(), start.end());
  const std::uint64_t plain = Layout{layout_.element, layout_.chunk, {}}.bytes();
  hsize_t stored = 0;
  called(H5Dget_chunk_storage_size(dataset_->getId(), first.data(), &stored));
  if (stored == 0) fail(origin(), fmt::format("{} has no chunk at {}", name(), fmt::join(start, ",")));
  if (stored > plain + plain / 512 + 64) fail(origin(), name() + " has a chunk of impossible length");
  std::vector<char> bytes(stored);
  std::uint32_t skipped = 0;
  called(H5Dread_chunk(dataset_->getId(), H5P_DEFAULT, first.data(), &skipped, bytes.data()));
  if (skipped != 0) fail(origin(), name() + " has a chunk with filters left out");
}

void Dataset::read(const std::vector<std::uint64_t>& start, const std::vector<std::uint64_t>& extent,
                   void* into) const {
  guarded(origin(), "read " + name(), [&] {
    if (!layout_.chunk.empty()) check_chunk(start);
    dataset_->read(into, type_of(layout_.element), space_of(extent), box_in(*dataset_, start, extent));
  });
}

void Dataset::write_all(const void* from) const {
  guarded(origin(), "write " + name(), [&] { dataset_->write(from, type_of(layout_.element)); });
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

File File::create(const std::filesystem::path& path) {
  const auto origin = std::make_shared<Origin>(Origin{path.string(), true, 0});
  return guarded(*origin, "create the file", [&] {
    return File(std::make_shared<H5::H5File>(path.string(), H5F_ACC_EXCL, file_creation(), file_access(true)),
                origin);
  });
}

File File::open(const std::filesystem::path& path) {
  const auto origin = std::make_shared<Origin>(Origin{path.string(), false, std::filesystem::file_size(path)});
  return guarded(*origin, "open the file", [&] {
    const auto& defaults = H5::FileCreatPropList::DEFAULT;
    return File(std::make_shared<H5::H5File>(path.string(), H5F_ACC_RDONLY, defaults, file_access(false)), origin);
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
    auto made = file_->createDataSet(name, type_of(layout.element), space_of(layout.extent), creation_of(layout),
                                     uncached());
    return Dataset(std::make_shared<H5::DataSet>(std::move(made)), layout, shared_origin(), name);
  });
}

bool File::contains(const std::string& name) const {
  return guarded(origin(), "look for " + name, [&] { return file_->nameExists(name); });
}

Dataset File::dataset(const std::string& name) const {
  return guarded(origin(), "open " + name, [&] {
    if (!file_->nameExists(name)) fail(origin(), name + " is missing");
    const auto found = std::make_shared<H5::DataSet>(file_->openDataSet(name, uncached()));
    const std::optional<Element> element = element_of(*found);
    if (!element) fail(origin(), name + " has values of an unknown type");
    const std::vector<std::uint64_t> extent = extent_of(found->getSpace());
    const Layout layout{*element, extent, chunk_of(*found, extent.size())};
    return Dataset(found, layout, shared_origin(), name);
  });
}

// A close that fails leaves HDF5 with a file it frees a second time at exit, which ends the process; a flush that fails
// leaves one that can be abandoned. So all that can fail for want of space is done before closing.
void File::close() {
  guarded(origin(), "close the file", [&] {
    called(H5Fflush(file_->getId(), H5F_SCOPE_LOCAL));
    if (fsync(descriptor_of(*file_)) != 0) fail(origin(), fmt::format("cannot sync it: {}", std::strerror(errno)));
    file_->close();
  });
}

void File::abandon() {
  guarded(origin(), "abandon the file", [&] {
    write_nowhere(*file_);
    file_->close();
  });
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
