#include "tools/pictures/text.h"

#include <fmt/format.h>

namespace portrait::pictures {
namespace {

std::string bracketed(const std::string& unit) { return unit.empty() ? "" : " [" + unit + "]"; }

}  // namespace

std::string xml_text(std::string_view text) {
  std::string escaped;
  for (const char c : text) switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? '?' : c;
    }
  return escaped;
}

std::string label(Parameter parameter, Plant plant) {
  return fmt::format("{} = {}", to_string(parameter), normalisation(parameter, plant));
}

std::string unit_text(Unit unit, bool real_units) {
  const std::string time = real_units ? "time" : "Td";
  switch (unit) {
    case Unit::one:
      return "";
    case Unit::output:
      return "y";
    case Unit::output_time:
      return "y " + time;
    case Unit::output_time2:
      return "y " + time + "^2";
    case Unit::output2_time:
      return "y^2 " + time;
    case Unit::output2_time2:
      return "y^2 " + time + "^2";
    case Unit::input:
      return "u";
    case Unit::input_per_output:
      return "u/y";
    case Unit::time:
      return time;
    case Unit::per_time:
      return "rad/" + time;
    case Unit::degree:
      return "degrees";
  }
  return "";
}

std::string short_label(Measure measure, bool real_units) {
  return std::string(to_string(measure)) + bracketed(unit_text(info(measure).unit, real_units));
}

std::string label(const Expression& expression, bool real_units) {
  const auto quantity = expression.single_quantity();
  if (quantity && std::holds_alternative<Measure>(*quantity)) {
    const MeasureInfo& measure = info(std::get<Measure>(*quantity));
    return fmt::format("{}, {}{}", measure.name, measure.long_name, bracketed(unit_text(measure.unit, real_units)));
  }
  return fmt::format("{} [{}]", expression.text(), real_units ? "real units" : "normalised");
}

}  // namespace portrait::pictures
