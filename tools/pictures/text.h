/// Text for people inside pictures and pages: labels with units, and the escapes of the languages it stands in.
#pragma once

#include <string>
#include <string_view>

#include "engine/loop/real_plant.h"
#include "portraits/query/expression.h"

namespace portrait::pictures {

/// & < > " ' as XML and HTML write them; control characters, which neither may hold, as "?".
std::string xml_text(std::string_view text);

/// "kappa = Kc K Td^2", "tau_i = Ti/Td"
std::string label(Parameter parameter, Plant plant);

/// "IAE_w, integral of absolute error, setpoint step [y Td]"; an expression of several as typed, with "[normalised]"
/// or "[real units]".
std::string label(const Expression& expression, bool real_units);
/// "IAE_w [y Td]"
std::string short_label(Measure measure, bool real_units);

/// Of a normalised measure in powers of y, u and Td; of a real one in those of y, u and time. Empty for a pure number.
std::string unit_text(Unit unit, bool real_units);

}  // namespace portrait::pictures
