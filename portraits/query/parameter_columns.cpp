#include "portraits/query/parameter_columns.h"

#include <algorithm>

#include "engine/base/check.h"

namespace portrait {
namespace {

std::size_t position(Parameter parameter) { return static_cast<std::size_t>(parameter); }

}  // namespace

ParameterColumns::ParameterColumns(const Grid& grid) : sources_(kParameterCount) {
  for (const FixedParameter& fixed : grid.fixed) sources_[position(fixed.parameter)] = Source{{fixed.value}, 1};
  std::uint64_t stride = 1;
  for (auto axis = grid.axes.rbegin(); axis != grid.axes.rend(); ++axis) {
    sources_[position(axis->parameter())] = Source{axis->values(), stride};
    stride *= axis->size();
  }
}

void ParameterColumns::repeat(const Source& source, std::uint64_t first, std::size_t count,
                              std::vector<double>& values) {
  values.resize(count);
  std::uint64_t index = first / source.stride % source.values.size();
  std::uint64_t left = source.stride - first % source.stride;
  for (std::size_t done = 0; done < count;) {
    const auto run = static_cast<std::size_t>(std::min<std::uint64_t>(left, count - done));
    std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(done), run, source.values[index]);
    done += run;
    index = (index + 1) % source.values.size();
    left = source.stride;
  }
}

void ParameterColumns::read(Parameter parameter, std::uint64_t first, std::size_t count,
                            std::vector<double>& values) const {
  if (const auto& source = sources_[position(parameter)]) return repeat(*source, first, count, values);
  const bool wants_delta = parameter == Parameter::delta;
  PORTRAIT_CHECK(wants_delta || parameter == Parameter::tau_d);
  const auto& given = sources_[position(wants_delta ? Parameter::tau_d : Parameter::delta)];
  const auto& kappa = sources_[position(Parameter::kappa)];
  PORTRAIT_CHECK(given && kappa);
  std::vector<double> gains;
  repeat(*kappa, first, count, gains);
  repeat(*given, first, count, values);
  for (std::size_t i = 0; i < count; ++i) values[i] = wants_delta ? gains[i] * values[i] : values[i] / gains[i];
}

/// An axis increases, and a run that reaches its end starts again at its beginning.
Interval ParameterColumns::spanned(const Source& source, std::uint64_t first, std::size_t count) {
  const std::uint64_t from = first / source.stride, to = (first + count - 1) / source.stride;
  const std::uint64_t size = source.values.size();
  const bool whole = to - from >= size || from % size > to % size;
  return {whole ? source.values.front() : source.values[from % size],
          whole ? source.values.back() : source.values[to % size], false};
}

Interval ParameterColumns::bound(Parameter parameter, std::uint64_t first, std::size_t count) const {
  if (const auto& source = sources_[position(parameter)]) return spanned(*source, first, count);
  const bool wants_delta = parameter == Parameter::delta;
  PORTRAIT_CHECK(wants_delta || parameter == Parameter::tau_d);
  const auto& given = sources_[position(wants_delta ? Parameter::tau_d : Parameter::delta)];
  const auto& kappa = sources_[position(Parameter::kappa)];
  PORTRAIT_CHECK(given && kappa);
  const Interval gain = spanned(*kappa, first, count), other = spanned(*given, first, count);
  return wants_delta ? gain * other : other / gain;
}

}  // namespace portrait
