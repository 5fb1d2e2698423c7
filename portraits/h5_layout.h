/// Our layouts in HDF5's terms: types, spaces, and how datasets are created and opened.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <H5Cpp.h>

#include "portraits/h5.h"

namespace portrait::h5 {

const H5::PredType& type_of(Element element);
/// Nothing for a type we do not write.
std::optional<Element> element_of(const H5::DataSet& dataset);

/// No extent: a single value.
H5::DataSpace space_of(const std::vector<std::uint64_t>& extent);
/// Fixed length, UTF-8.
H5::StrType text_type(std::size_t length);

/// Type, extent and chunk of a dataset in a file. Nothing for a type we do not write.
std::optional<Layout> layout_of(const H5::DataSet& dataset);

H5::DSetCreatPropList dataset_creation(const Layout& layout);
H5::DSetAccPropList dataset_access();
/// Of a group, the root among them: names and attributes keep their order, nothing depends on the time of day.
void keep_order(hid_t creation_list);

}  // namespace portrait::h5
