/// portrait export: a slice of a portrait, or what a query admits, for other programs.

#include <algorithm>
#include <memory>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/version.h"
#include "engine/base/words.h"
#include "portraits/disk.h"
#include "portraits/output_file.h"
#include "portraits/query/export.h"
#include "portraits/reader.h"
#include "tools/arguments.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/progress.h"
#include "tools/query_output.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait export huba.h5 --slice delta=0.7,b=0 -o map.npy
  portrait export huba.h5 --where 'Ms <= 2' --where 'TV2_ud <= 0.1' --plant K=2,Td=0.5 -o good.csv
  portrait export huba.h5 --minimize IAE_d --where 'Ms <= 2' --top 100 --measures IAE_d,Ms -o best.csv

Writes a table for other programs. Without --where every setting of the slice (of the portrait,
without --slice), whatever its status; with --where those that a query calls admissible; with
--minimize the best of them, best first.

.csv   a head of names and a row for each setting; without -o it goes to stdout
.npy   numpy.load gives an array whose fields are the columns; without --where and --minimize
       its shape is that of the grid, the axes of the slice left out

What does not exist is nan, the status says why. Beside FILE stands FILE.json: units and meanings
of all columns, the axes, the fixed parameters, the codes of the status.)";

struct ExportArguments {
  std::string file, output, slice, measures, minimize, plant, step;
  std::vector<std::string> where;
  std::size_t top = 1;
  bool include_not_settled = false, force = false, quiet = false, json = false;
};

// ---------------------------------------------------------------- arguments

std::vector<std::string> words_in(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
}

Measure stored_measure(const std::string& name, const Grid& grid) {
  const std::optional<Measure> measure = measure_named(name);
  if (measure && std::find(grid.measures.begin(), grid.measures.end(), *measure) != grid.measures.end()) return *measure;
  std::vector<std::string_view> known;
  for (const Measure m : grid.measures) known.push_back(to_string(m));
  throw InputError(fmt::format("--measures: the portrait has no measure \"{}\"{}", name, suggestion(name, known)));
}

std::vector<Measure> measures_argument(const std::string& text, const Grid& grid) {
  if (text.empty()) return grid.measures;
  std::vector<Measure> measures;
  for (const std::string& name : words_in(text)) {
    measures.push_back(stored_measure(name, grid));
    if (std::count(measures.begin(), measures.end(), measures.back()) > 1)
      throw InputError(fmt::format("--measures: {} stands there twice", name));
  }
  return measures;
}

std::vector<std::pair<Parameter, double>> slice_argument(const std::string& text, const Grid& grid) {
  std::vector<std::pair<Parameter, double>> slice;
  if (text.empty()) return slice;
  std::vector<std::string_view> axes;
  for (const Axis& axis : grid.axes) axes.push_back(axis.name());
  for (const std::string& part : words_in(text)) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos)
      throw InputError(fmt::format("--slice: \"{}\" is not AXIS=VALUE, as delta=0.7", part));
    const std::string name = part.substr(0, equals);
    if (std::find(axes.begin(), axes.end(), name) == axes.end())
      throw InputError(fmt::format("--slice: \"{}\" is no axis of the portrait{}", name, suggestion(name, axes)));
    slice.emplace_back(*parameter_named(name), number_argument("--slice " + name, part.substr(equals + 1)));
    for (std::size_t i = 0; i + 1 < slice.size(); ++i)
      if (slice[i].first == slice.back().first) throw InputError(fmt::format("--slice: {} stands there twice", name));
  }
  return slice;
}

enum class Format { csv, npy };

Format format_argument(const std::string& output) {
  const std::string ending = std::filesystem::path(output).extension().string();
  if (output.empty() || ending == ".csv") return Format::csv;
  if (ending == ".npy") return Format::npy;
  throw InputError(fmt::format("-o {}: unknown kind of file \"{}\"{}", output, ending, suggestion(ending, {".csv", ".npy"})));
}

ExportRequest request_from(const ExportArguments& a, const Grid& grid) {
  ExportRequest request{.conditions = {}, .slice = slice_argument(a.slice, grid), .measures = measures_argument(a.measures, grid)};
  Conditions& conditions = request.conditions;
  for (const std::string& text : a.where) conditions.where.push_back(parse_constraint({"--where", text}));
  if (!a.plant.empty()) conditions.units.plant = real_plant_argument("--plant", a.plant, grid.family.plant);
  if (!a.step.empty()) conditions.units.steps = step_argument("--step", a.step);
  conditions.include_not_settled = a.include_not_settled;
  return request;
}

// ---------------------------------------------------------------- what stands beside the table

Json json_columns(const std::vector<TableColumn>& columns) {
  Json list = Json::array();
  for (const TableColumn& column : columns)
    list.push_back({{"name", column.name}, {"unit", column.unit}, {"meaning", column.meaning}});
  return list;
}

Json json_status_codes() {
  Json codes = Json::object();
  for (std::size_t code = 0; code < kStatusNames.size(); ++code) codes[std::to_string(code)] = kStatusNames[code];
  return codes;
}

Json json_about(const ExportArguments& a, const PortraitReader& portrait, const Export& table,
                const std::vector<TableColumn>& columns, const std::vector<std::uint64_t>& shape) {
  const Grid& grid = portrait.grid();
  Json axes = Json::array(), fixed = Json::object(), slice = Json::object();
  for (const Axis& axis : grid.axes) {
    const std::vector<Parameter> left = table.free_axes();
    if (std::find(left.begin(), left.end(), axis.parameter()) == left.end()) continue;
    Json values = Json::array();
    for (const double value : axis.values()) values.push_back(json_number(value));
    axes.push_back({{"name", axis.name()}, {"values", values}});
  }
  for (const FixedParameter& f : grid.fixed) fixed[std::string(to_string(f.parameter))] = json_number(f.value);
  for (const auto& [parameter, value] : slice_argument(a.slice, grid)) slice[std::string(to_string(parameter))] = json_number(value);
  Json about{{"portrait", a.file}, {"title", grid.title}, {"program", program_version()}, {"shape", shape},
             {"axes", axes}, {"slice", slice}, {"fixed", fixed}, {"columns", json_columns(columns)},
             {"status", json_status_codes()}, {"missing", "nan"}};
  if (!a.minimize.empty()) about["minimize"] = a.minimize;
  return about;
}

// ---------------------------------------------------------------- the table

/// Where rows go: a file, or stdout.
class Table {
 public:
  Table(const ExportArguments& a, std::vector<TableColumn> columns, std::vector<std::uint64_t> shape)
      : format_(format_argument(a.output)), columns_(std::move(columns)), shape_(std::move(shape)) {
    if (!a.output.empty()) file_.emplace(a.output, a.force ? Existing::replace : Existing::refuse);
  }

  void write(const TableRows& rows) {
    if (!begun_) put(head());
    begun_ = true;
    put(format_ == Format::csv ? csv_rows(columns_, rows) : npy_rows(columns_, rows));
  }

  /// `rows`: how many there are, where the shape is not that of the grid.
  void finish(const std::optional<std::uint64_t>& rows) {
    if (rows) shape_ = {*rows};
    if (format_ == Format::npy) file_->write_again_at_start(head());
    if (file_) file_->publish();
  }

  const std::vector<TableColumn>& columns() const { return columns_; }
  const std::vector<std::uint64_t>& shape() const { return shape_; }

 private:
  std::string head() const { return format_ == Format::csv ? csv_head(columns_) : npy_head(columns_, shape_); }
  void put(const std::string& text) {
    if (file_)
      file_->write(text);
    else
      print_text(text);
  }

  Format format_;
  std::vector<TableColumn> columns_;
  std::vector<std::uint64_t> shape_;
  std::optional<OutputFile> file_;
  bool begun_ = false;
};

/// The best settings of a query: the slice becomes constraints of their own.
TableRows best_rows(const ExportArguments& a, const PortraitReader& portrait, const ExportRequest& request,
                    const Export& table) {
  Question question{.minimize = parse_expression({"--minimize", a.minimize}), .conditions = request.conditions, .top = a.top};
  for (const auto& [parameter, value] : request.slice)
    question.conditions.where.push_back(
        parse_constraint({"--slice", fmt::format("{} == {}", to_string(parameter), number_text(value))}));
  const Answer answer = ask(portrait, question);
  TableRows rows = table.rows_of(answer.top);
  std::vector<double>& objective = rows.values.emplace_back();
  for (const Found& found : answer.top) objective.push_back(found.objective);
  return rows;
}

int run(const ExportArguments& a) {
  const PortraitReader portrait(a.file);
  const ExportRequest request = request_from(a, portrait.grid());
  const Export of(portrait, request);
  const bool whole = request.conditions.where.empty() && a.minimize.empty();
  std::vector<TableColumn> columns = of.columns();
  if (!a.minimize.empty()) columns.push_back({"objective", unit_note(request.conditions.units), a.minimize});
  Table table(a, columns, whole ? of.shape() : std::vector<std::uint64_t>{0});
  std::uint64_t rows = 0;
  if (a.minimize.empty()) {
    rows = of.for_each([&](const TableRows& block) { table.write(block); });
  } else {
    const TableRows best = best_rows(a, portrait, request, of);
    if (best.count > 0) table.write(best);
    rows = best.count;
  }
  if (rows == 0) {
    print_message("no admissible setting: nothing is written");
    return kNoneAdmissible;
  }
  table.finish(whole ? std::nullopt : std::optional(rows));
  if (!a.output.empty())
    disk::write_whole_file(a.output + ".json", json_about(a, portrait, of, table.columns(), table.shape()).dump(2) + "\n");
  if (a.json)
    print_json({{"rows", rows}, {"columns", columns.size()}, {"shape", table.shape()}, {"file", a.output}});
  else if (!a.quiet && !a.output.empty())
    print_message(fmt::format("{} rows of {} columns written to {}; units and meanings: {}.json", grouped(rows),
                              columns.size(), a.output, a.output));
  return kDone;
}

}  // namespace

void add_export(CLI::App& app, Invocation& invocation) {
  auto a = std::make_shared<ExportArguments>();
  CLI::App* verb = add_verb(app, "export", "a slice of a portrait, or what a query admits, as CSV or NPY", kHelp);
  verb->add_option("file", a->file, "portrait file")->required();
  verb->add_option("-o,--output", a->output, "FILE.csv or FILE.npy (default: CSV to stdout)");
  verb->add_option("--slice", a->slice, "AXIS=VALUE[,...]: only these values of axes");
  add_many(*verb, "--where", a->where, "a constraint, EXPR <= X (or <, >=, >, ==); any number of times");
  verb->add_option("--minimize", a->minimize, "an expression: the best settings, best first");
  verb->add_option("--top", a->top, "with --minimize, how many of them")->capture_default_str();
  verb->add_option("--measures", a->measures, "NAME[,...]: only these, in this order (default: all)");
  verb->add_option("--plant", a->plant, "K=..,Td=..[,T1=..]: measures in the units of this plant, and its controllers");
  verb->add_option("--step", a->step, "w=..,d=..: sizes of the steps in setpoint and disturbance (1 each)");
  verb->add_flag("--include-not-settled", a->include_not_settled,
                 "with --where, also settings whose responses had not settled at the horizon");
  verb->add_flag("--force", a->force, "replace an existing file");
  verb->add_flag("--quiet", a->quiet, "no summary");
  verb->add_flag("--json", a->json, "the summary as one JSON object");
  verb->callback([a, &invocation] {
    if (a->json && a->output.empty()) throw InputError("--json: the table goes to stdout; give -o FILE");
    invocation.exit_code = run(*a);
  });
}

}  // namespace portrait::tools
