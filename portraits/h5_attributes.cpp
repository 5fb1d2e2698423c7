#include <algorithm>
#include <utility>

#include <H5Cpp.h>
#include <fmt/format.h>

#include "portraits/h5.h"
#include "portraits/h5_call.h"
#include "portraits/h5_layout.h"

namespace portrait::h5 {
namespace {

constexpr std::uint64_t kLongestText = std::uint64_t{64} << 20;

std::string quoted(const std::string& attribute, const Object& object) {
  return object.name().empty() ? fmt::format("attribute {}", attribute)
                               : fmt::format("attribute {} of {}", attribute, object.name());
}

H5::Attribute open_attribute(const H5::H5Object& object, const Origin& origin, const std::string& attribute,
                             const std::string& place) {
  if (!object.attrExists(attribute)) fail(origin, place + " is missing");
  H5::Attribute found = object.openAttribute(attribute);
  if (found.getSpace().getSimpleExtentNpoints() != 1) fail(origin, place + " is not a single value");
  return found;
}

}  // namespace

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

}  // namespace portrait::h5
