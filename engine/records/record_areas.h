/// Characteristic areas from a recorded change of the input between two steady states, of whatever shape.
///
///     s U(s)/U_0 = sum (-1)^k U_k s^k,  U_k = int t^{k-1}/(k-1)! (u(inf) - u)/dU dt,  Y_k likewise
///     A_k = Y_k - sum_{i<k} A_i U_{k-i}                       from sY = G sU, power by power    [HO-PID 2.1, Kos2021 (2.11)]
///
/// For a plant with an integrator the slope of y stands in place of y; what is then integrated is the distance of y from its
/// last straight line. Held inputs and straight lines are integrated exactly, so a step costs no accuracy, wherever it
/// falls. Levels and slopes at both ends are fitted over samples, not read off one.
/// unit      those of the record
/// accuracy  of a record without noise: what y loses by being sampled: tests/engine/records/record_areas_test.cpp
#pragma once

#include <vector>

#include "engine/records/record.h"

namespace portrait::records {

struct RecordAreas {
  std::vector<double> areas;
  double settled_from;  ///< the last level or line was fitted to samples from here on
  Quality quality;
};

/// Of a self-regulating plant. `settled_from` in the record's time; without one (NaN) the last tenth.
/// Throws InputError: y still moves at the end, u ends where it began.
RecordAreas self_regulating_areas(const Record& record, std::size_t count, double settled_from);

/// Of a plant with one integrator. Throws InputError: y has not come to a straight line, u ends where it began.
RecordAreas integrating_areas(const Record& record, std::size_t count, double settled_from);

}  // namespace portrait::records
