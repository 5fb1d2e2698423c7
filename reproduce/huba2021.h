/// The loops of Example 6 of Huba2021: 1/(1 + s)^4 under six controllers with their filters and prefilters.
#pragma once

#include <vector>

#include "reproduce/loops.h"

namespace portrait::reproduce {

struct Designed {
  rules::Tuned tuned;
  double T, Td;
};

/// SPI, SPID, 1PI, 2PID, 3PIDA, 4PIDAJ as (99) states them, and with the two that were simulated otherwise.
std::vector<Designed> example6();
std::vector<Designed> example6_corrected();
rules::RulePlant example6_plant();

/// Tables 1 and 2 under noise.
Numbers example6_light_noise(const PublishedTable& table);
Numbers example6_filtered_noise(const PublishedTable& table);

}  // namespace portrait::reproduce
