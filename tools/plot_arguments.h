/// What the kinds of `portrait plot` have in common on the command line, and how it is read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "portraits/query/query.h"
#include "portraits/reader.h"
#include "tools/pictures/loops.h"
#include "tools/pictures/map.h"

namespace portrait::tools {

/// The line as typed; empty means not given.
struct PlotArguments {
  std::string output, title, file, plant, prefilter, minimize, horizon = "auto";
  int n = -1;
  std::vector<std::string> settings, where, at, log;
  bool include_not_settled = false;
};

/// The options, in groups; each kind takes those it can use.
void add_output(CLI::App& kind, PlotArguments& a);
void add_question(CLI::App& kind, PlotArguments& a);
void add_loops(CLI::App& kind, PlotArguments& a, const char* settings_text);
void add_log(CLI::App& kind, PlotArguments& a, const char* text);

/// --plant "dipdt", "dipdt,K=2,Td=0.5" or "K=2,Td=0.5": a family, a real plant, or both. With a portrait the family is
/// the portrait's.
struct PlantArgument {
  Plant family;
  std::optional<RealPlant> real;
};
PlantArgument plant_argument(const std::string& text, std::optional<Plant> of_portrait);

/// --setting "LABEL: kappa=0.24 tau_i=8 delta=0.7": as query prints it; the label may be left out. `fixed` are the values
/// of what is not named.
pictures::NamedLoop named_loop(const std::string& text, const LoopFamily& family, const Setting& fixed);

/// The family of a figure without a portrait.
LoopFamily family_argument(const PlotArguments& a, Plant plant);

/// --minimize, --where, --plant for this portrait. REQUIRES: --minimize was given.
Question question_argument(const PlotArguments& a, const Grid& grid);

/// The values that all settings of the grid have.
Setting fixed_setting(const Grid& grid);

/// Whether --log names this.
bool is_log(const PlotArguments& a, const std::string& what);

/// "kappa=0.1..0.5" or "kappa=0.3"
struct ParameterRange {
  Parameter parameter;
  double from, to;
};
ParameterRange range_argument(const std::string& option, const std::string& text);
Parameter parameter_argument(const std::string& option, const std::string& text);

/// What goes into the picture's file.
pictures::About about(const std::string& title, const std::string& command_line);

}  // namespace portrait::tools
