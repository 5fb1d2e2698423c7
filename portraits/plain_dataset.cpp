#include "portraits/plain_dataset.h"

#include <span>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "portraits/digest.h"
#include "portraits/schema.h"

namespace portrait {
namespace {

template <typename Value>
std::string digest_of_values(const std::vector<Value>& values) {
  return digest_text(digest_of(std::as_bytes(std::span(values))));
}

template <typename Value>
std::vector<Value> read_plain(const h5::File& file, const std::string& name, h5::Element element,
                              std::size_t axes) {
  const h5::Dataset dataset = file.dataset(name);
  const h5::Layout& layout = dataset.layout();
  const auto broken = [&](const char* what) {
    throw IntegrityError(fmt::format("{}: {} {}", file.origin().file, name, what));
  };
  if (layout.element != element || layout.extent.size() != axes || !layout.chunk.empty())
    broken(axes == 0   ? "is not a single number"
           : axes == 1 ? "is not a row of numbers"
                       : "is not a table of numbers");
  if (layout.count() > file.origin().bytes / sizeof(Value)) broken("is larger than the file");
  std::vector<Value> values(layout.count());
  dataset.read_all(values.data());
  if (digest_of_values(values) != dataset.text(schema::kDigest))
    broken("holds other values than were written (its digest differs)");
  return values;
}

template <typename Value>
void write_values(const h5::Dataset& dataset, const std::vector<Value>& values) {
  PORTRAIT_CHECK_EQ(dataset.layout().count(), values.size());
  dataset.write_all(values.data());
  dataset.set_text(schema::kDigest, digest_of_values(values));
}

}  // namespace

std::vector<double> read_reals(const h5::File& file, const std::string& name, std::size_t axes) {
  return read_plain<double>(file, name, h5::Element::real64, axes);
}

std::vector<std::uint64_t> read_row_of_uint64(const h5::File& file, const std::string& name) {
  return read_plain<std::uint64_t>(file, name, h5::Element::uint64, 1);
}

void write_plain(const h5::Dataset& dataset, const std::vector<double>& values) { write_values(dataset, values); }

void write_plain(const h5::Dataset& dataset, const std::vector<std::uint64_t>& values) {
  write_values(dataset, values);
}

}  // namespace portrait
