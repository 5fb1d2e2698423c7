/// Integrals of an input that is held between samples, exact at any time.
#pragma once

#include "engine/records/record.h"

namespace portrait::records {

class HeldInput {
 public:
  /// u less its first value; 0 before the record.
  explicit HeldInput(const Record& record);

  double integral(double t) const;         ///< int u
  double double_integral(double t) const;  ///< int int u
  /// Samples of the answer of 1/(T s + 1) at the given times less Td, which must rise.
  std::vector<double> lagged(const std::vector<double>& times, double Td, double T) const;

 private:
  std::size_t interval(double t) const;

  std::vector<double> t_, u_, once_, twice_;
};

}  // namespace portrait::records
