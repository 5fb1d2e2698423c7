#include "portraits/h5_layout.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

#include "portraits/h5_call.h"

namespace portrait::h5 {
namespace {

/// What the file says of its deflated chunks: no reader looks at it. Ours are made by portraits/run_deflate.h.
constexpr unsigned kDeflateLevel = 1;
constexpr unsigned kCreationOrder = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;

std::vector<std::uint64_t> extent_of(const H5::DataSpace& space) {
  std::vector<hsize_t> sizes(static_cast<std::size_t>(space.getSimpleExtentNdims()));
  if (!sizes.empty()) space.getSimpleExtentDims(sizes.data());
  return {sizes.begin(), sizes.end()};
}

std::vector<std::uint64_t> chunk_of(const H5::DataSet& dataset, std::size_t axes) {
  const H5::DSetCreatPropList list = dataset.getCreatePlist();
  if (list.getLayout() != H5D_CHUNKED) return {};
  std::vector<hsize_t> chunk(axes);
  list.getChunk(static_cast<int>(axes), chunk.data());
  return {chunk.begin(), chunk.end()};
}

void chunk_and_filter(const H5::DSetCreatPropList& list, const Layout& layout) {
  const std::vector<hsize_t> chunk(layout.chunk.begin(), layout.chunk.end());
  list.setChunk(static_cast<int>(chunk.size()), chunk.data());
  list.setShuffle();
  // Mandatory: a chunk that leaves deflate out says so in its mask.
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

std::optional<Element> element_of(const H5::DataSet& dataset) {
  const H5::DataType type = dataset.getDataType();
  for (const Element element : {Element::real64, Element::real32, Element::uint8, Element::uint64})
    if (type == type_of(element)) return element;
  return std::nullopt;
}

H5::DataSpace space_of(const std::vector<std::uint64_t>& extent) {
  if (extent.empty()) return H5::DataSpace(H5S_SCALAR);
  const std::vector<hsize_t> sizes(extent.begin(), extent.end());
  return H5::DataSpace(static_cast<int>(sizes.size()), sizes.data());
}

H5::StrType text_type(std::size_t length) {
  H5::StrType type(H5::PredType::C_S1, std::max<std::size_t>(length, 1));
  type.setCset(H5T_CSET_UTF8);
  type.setStrpad(H5T_STR_NULLPAD);
  return type;
}

std::optional<Layout> layout_of(const H5::DataSet& dataset) {
  const std::optional<Element> element = element_of(dataset);
  if (!element) return std::nullopt;
  const std::vector<std::uint64_t> extent = extent_of(dataset.getSpace());
  return Layout{*element, extent, chunk_of(dataset, extent.size())};
}

H5::DSetCreatPropList dataset_creation(const Layout& layout) {
  H5::DSetCreatPropList list;
  // Attributes stay in the header, where HDF5 checksums them and finds them at once.
  called(H5Pset_attr_phase_change(list.getId(), 64, 60));
  called(H5Pset_attr_creation_order(list.getId(), kCreationOrder));
  called(H5Pset_obj_track_times(list.getId(), false));
  set_fill(list, layout.element);
  if (!layout.chunk.empty()) chunk_and_filter(list, layout);
  return list;
}

// Tiles are whole chunks: caching them gains nothing.
H5::DSetAccPropList dataset_access() {
  H5::DSetAccPropList list;
  list.setChunkCache(0, 0, 1);
  return list;
}

void keep_order(hid_t creation_list) {
  called(H5Pset_link_creation_order(creation_list, kCreationOrder));
  called(H5Pset_attr_creation_order(creation_list, kCreationOrder));
  called(H5Pset_obj_track_times(creation_list, false));
}

}  // namespace portrait::h5
