/// A recorded change of a plant's input and what its output did: samples of t, u, y.
///
/// Between samples u is held, as a converter holds it, and y is a straight line: a step that falls between two samples is a
/// step at the first of them that has it.
/// unit      those of the record
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace portrait::records {

struct Record {
  std::vector<double> t, u, y;

  std::size_t size() const { return t.size(); }
};

/// "t,u,y" with a header or without, in any order of named columns; numbers parted by comma, semicolon, tab or spaces; lines
/// that begin with # are comments. Throws InputError with file and line: wrong columns, no number, times that do not rise.
Record read_record(std::string_view text, const std::string& source);

/// What is worth knowing before a record is trusted.
struct Quality {
  double start;               ///< when u first leaves its initial level
  double before_u, before_y;  ///< levels before
  double drift;               ///< slope of y before, by least squares; 0 with fewer than 3 samples
  double noise;               ///< standard deviation of y from sample to sample
  double longest_gap, usual_gap;
  std::vector<std::string> remarks;  ///< in words: gaps, few samples before the change, drift
};

/// Throws InputError when u never changes or there is too little of the record.
Quality quality(const Record& record);

}  // namespace portrait::records
