/// Plants, controllers and prefilters as users write them for loops beyond the normalised families.
///
///     tf:NUM/DEN                  coefficients from the highest power down: tf:34/13.5,54.25,55,1
///     standard:Kc=,Ti=,TD=        Kc (1 + 1/(Ti s) + TD s)              Ti is inf, TD 0 when it is not given
///     series:Kc=,Ti=,TD=          Kc (1 + 1/(Ti s)) (1 + TD s)
///     parallel:Kp=,Ki=,Kd=        Kp + Ki/s + Kd s
///     1,2.5,0.3                   gains K_-1, K_0, ..., K_m
///
/// All throw InputError with the option's name.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/loop/general_loop.h"

namespace portrait::tools {

/// Whether the text is a transfer function.
bool is_transfer_function(std::string_view text);
TransferFunction transfer_function_argument(std::string_view option, std::string_view text);

std::vector<double> numbers_argument(std::string_view option, std::string_view text);

ParallelForm pid_argument(std::string_view option, std::string_view text);

/// "w=2,d=-0.5" for the given names; `otherwise` where a name is not given.
std::vector<double> named_numbers_argument(std::string_view option, std::string_view text,
                                           const std::vector<std::string_view>& names, double otherwise);

}  // namespace portrait::tools
