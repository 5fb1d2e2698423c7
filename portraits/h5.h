/// The one door to HDF5: files, datasets and attributes, as far as a portrait needs them.
///
/// A file being written fails with StoreError, one being read with IntegrityError (StoreError when the system
/// failed, not the file); both name file and object and end with the library's own words. HDF5 itself prints
/// nothing.
///
/// Reading trusts nothing the file says: sizes are held against the size of the file before memory is asked
/// for, and a chunk's length and filters are checked; HDF5 1.10 does not do it. Chunks are encoded, written, read and
/// decoded outside (portraits/chunk_codec.h, portraits/data_file.h): HDF5 only keeps their places.
///
/// The parts behind this door: h5_call (errors), h5_driver (writing), h5_layout (types and shapes), h5_attributes.
///
/// HDF5 is entered by one thread at a time: the door has a lock. Reading chunks is for any number of threads at
/// once; everything else REQUIRES: a File and its datasets are used by one thread at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "portraits/chunk_codec.h"

namespace H5 {
class H5Object;
class DataSet;
class H5File;
}  // namespace H5

namespace portrait::h5 {

struct WriteFault;

/// How a value lies in the file, little endian; in memory the same type.
enum class Element { real64, real32, uint8, uint64 };
std::size_t size_of(Element element);

/// Type and shape of a dataset. With chunks: shuffled, deflated and checksummed, the first two unless a chunk
/// leaves them out; without: contiguous and plain.
struct Layout {
  Element element = Element::real64;
  std::vector<std::uint64_t> extent;  ///< along each axis; none: one number
  std::vector<std::uint64_t> chunk;   ///< along each axis; none: contiguous
  std::uint64_t count() const;        ///< values in all
  std::uint64_t bytes() const;        ///< of all values
  friend bool operator==(const Layout&, const Layout&) = default;
};

/// A file's name for messages, and what it is open for.
struct Origin {
  std::string file;
  bool writing = false;
  std::uint64_t bytes = 0;            ///< size of a file being read: nothing in it can be larger
  int descriptor = -1;
  std::shared_ptr<WriteFault> fault;  ///< of a file being written
};

/// Something with attributes: the root group or a dataset.
class Object {
 public:
  const std::string& name() const { return name_; }
  const Origin& origin() const { return *origin_; }

  void set_text(const std::string& attribute, const std::string& text) const;  ///< fixed length, UTF-8
  void set_texts(const std::string& attribute, const std::vector<std::string>& texts) const;
  void set_integer(const std::string& attribute, std::int64_t value) const;
  void set_real(const std::string& attribute, double value, Element element = Element::real64) const;
  void set_bytes(const std::string& attribute, const std::vector<std::uint8_t>& values) const;

  bool has(const std::string& attribute) const;
  std::string text(const std::string& attribute) const;
  std::int64_t integer(const std::string& attribute) const;
  double real(const std::string& attribute) const;

 protected:
  Object(std::shared_ptr<H5::H5Object> object, std::shared_ptr<const Origin> origin, std::string name);
  const std::shared_ptr<const Origin>& shared_origin() const { return origin_; }

 private:
  std::shared_ptr<H5::H5Object> object_;
  std::shared_ptr<const Origin> origin_;
  std::string name_;
};

/// Where a chunk lies in its file, filters applied; one at the far edge is whole.
struct ChunkPlace {
  std::uint64_t address = 0, length = 0;
  ChunkForm form = ChunkForm::plain;
  friend bool operator==(const ChunkPlace&, const ChunkPlace&) = default;
};

class Dataset : public Object {
 public:
  const Layout& layout() const { return layout_; }

  /// Notes where a chunk lies; its bytes are there already. And asks for it.
  /// REQUIRES: a chunked dataset, and the start of a chunk in it.
  void place_chunk(const std::vector<std::uint64_t>& start, const ChunkPlace& place) const;
  ChunkPlace place_of_chunk(const std::vector<std::uint64_t>& start) const;
  /// Its bytes.
  ChunkForm read_chunk(const std::vector<std::uint64_t>& start, std::vector<std::byte>& stored) const;
  /// All values of a contiguous dataset. REQUIRES: room for layout().count() values, which a reader has
  /// checked.
  void write_all(const void* from) const;
  /// The same from bytes that lie elsewhere in the file being written. REQUIRES: a single value.
  void copy_from(std::uint64_t address) const;
  void read_all(void* into) const;

  /// Makes this the scale of a dimension of that name; others attach it to their axes.
  void make_scale(const std::string& dimension) const;
  void attach_scale(std::uint32_t axis, const Dataset& scale, const std::string& label) const;

 private:
  friend class File;
  Dataset(std::shared_ptr<H5::DataSet> dataset, Layout layout, std::shared_ptr<const Origin> origin,
          std::string name);
  std::shared_ptr<H5::DataSet> dataset_;
  Layout layout_;
};

/// An HDF5 file and its root group.
class File : public Object {
 public:
  /// Makes an existing file an HDF5 file that any HDF5 since 1.8 can read, and keeps its bytes: the superblock goes
  /// to the start, everything else behind `end`.
  /// REQUIRES: the file has `end` bytes; the first 512 are free.
  static File create_behind(const std::filesystem::path& path, std::uint64_t end);
  /// An existing one, for reading only.
  static File open(const std::filesystem::path& path);

  void create_group(const std::string& name) const;
  Dataset create_dataset(const std::string& name, const Layout& layout) const;
  bool contains(const std::string& name) const;
  Dataset dataset(const std::string& name) const;

  /// Writes everything out and closes the file together with its datasets. REQUIRES: nothing of it is used
  /// afterwards.
  void close();
  /// Closes the file without writing anything more to it: for one that is to be removed, perhaps since the disk is
  /// full. REQUIRES: as close.
  void abandon();

 private:
  File(std::shared_ptr<H5::H5File> file, std::shared_ptr<const Origin> origin);
  std::shared_ptr<H5::H5File> file_;
};

/// Whether the file begins as HDF5 files do.
bool is_hdf5(const std::filesystem::path& path);

/// "1.10.8"
std::string library_version();

}  // namespace portrait::h5
