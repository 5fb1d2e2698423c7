/// The kinds of answer that `portrait query` gives beside the best settings.
#pragma once

#include <string>
#include <vector>

#include "portraits/query/query.h"
#include "portraits/reader.h"

namespace portrait::tools {

enum class OutputForm { text, json, csv };

/// What a question said, as far as every kind of answer needs it.
struct QueryRequest {
  const PortraitReader& portrait;
  Conditions conditions;
  OutputForm form = OutputForm::text;

  const Grid& grid() const { return portrait.grid(); }
};

/// --pareto 'A,B[,C]' --points N. Gives the exit code, as those below.
int print_pareto(const QueryRequest& request, const std::string& expressions, std::size_t points);

/// --region: how large the admissible region is, where it lies, what shape it has.
int print_region(const QueryRequest& request);

/// --why SETTING: which constraints fail and by how much, and the nearest admissible setting. With an objective also how
/// it compares with the best.
int print_why(const QueryRequest& request, const std::string& setting, const std::string& minimize);

struct AlongRequest {
  std::string minimize, along;  ///< "Ms=1.3..2.0:15"
  bool refine = false;          ///< between grid points
  std::string setting;          ///< of --why: its regret too; may be empty
  bool rules = false;           ///< and that of every tuning rule
};

/// --along: the best objective along a bound. The regret of a setting is what it costs more than the best under its own
/// value of the bound.
int print_along(const QueryRequest& request, const AlongRequest& asked);

}  // namespace portrait::tools
