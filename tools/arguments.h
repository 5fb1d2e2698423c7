/// Arguments as users write them, turned into what the library takes. All throw InputError with the option's name.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/loop/horizon.h"
#include "engine/loop/real_plant.h"
#include "engine/measures/catalogue.h"
#include "engine/sweep/method.h"
#include "grids/grid.h"
#include "portraits/query/plant_box.h"
#include "portraits/query/query_units.h"

namespace portrait::tools {

/// "0.25", "inf". `option` is for the message.
double number_argument(std::string_view option, std::string_view text);

/// A number of dead times above 0, or "auto".
Horizon horizon_argument(std::string_view option, std::string_view text);

/// A number of dead times above 0, finite; nothing when the text is empty.
std::optional<double> sampling_argument(std::string_view option, std::string_view text);

Plant plant_family_argument(std::string_view option, std::string_view text);
Prefilter prefilter_argument(std::string_view option, std::string_view text);
Measure measure_argument(std::string_view option, std::string_view name);
Method method_argument(std::string_view option, std::string_view text);

/// "K=2.5,Td=0.4[,T1=3]" for a plant of this family; K is 1 when it is not given.
RealPlant real_plant_argument(std::string_view option, std::string_view text, Plant family);

/// "K=1.6..2.4,Td=0.4..0.6[,T1=2..3]": plants around the nominal one, by default that in the middle. What is not named is
/// as in the nominal plant; without one K is 1.
PlantBox uncertain_argument(std::string_view option, std::string_view text, const std::optional<RealPlant>& nominal,
                            Plant family);

/// "w=2,d=0.5": sizes of steps, 1 where none is given.
StepSizes step_argument(std::string_view option, std::string_view text);

/// "kappa=0.2,tau_i=8,delta=0.5": a setting of the grid's family; what is not named has the grid's fixed value, an axis
/// must be named.
Setting setting_argument(std::string_view option, std::string_view text, const Grid& grid);

}  // namespace portrait::tools
