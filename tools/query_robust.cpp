#include "tools/query_robust.h"

#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "portraits/query/robust.h"
#include "tools/arguments.h"
#include "tools/exit_codes.h"
#include "tools/query_output.h"

namespace portrait::tools {
namespace {

std::string percent(double part) { return fmt::format("{:.3g} %", 100 * part); }

/// "K=1.2 Td=0.8": what varies.
std::string plant_words(const PlantBox& box, const RealPlant& plant) {
  const double values[] = {plant.K, plant.Td, plant.T1};
  std::string text;
  for (const std::size_t k : box.uncertain())
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", name_of_uncertain(box.nominal.family, k), short_number(values[k]));
  return text.empty() ? "the plant" : text;
}

std::string box_words(const PlantBox& box) {
  const Range ranges[] = {box.K, box.Td, box.T1};
  std::string text;
  for (const std::size_t k : box.uncertain())
    text += fmt::format("{}{} in {}..{}", text.empty() ? "" : ", ", name_of_uncertain(box.nominal.family, k),
                        number_text(ranges[k].low), number_text(ranges[k].high));
  return text.empty() ? "one plant" : text;
}

// ---------------------------------------------------------------- JSON

Json json_worst(const WorstPlant& worst) {
  return {{"plant", json_plant(worst.plant)},           {"value", json_number(worst.left)},
          {"bound", json_number(worst.right)},          {"excess", json_number(worst.relative)},
          {"excess_at_most", json_number(worst.bound)}, {"share_broken", json_number(worst.share)}};
}

Json json_over_box(const QueryRequest& request, const OverBox& over) {
  Json constraints = Json::array(), patch = Json::object();
  for (std::size_t j = 0; j < over.constraints.size(); ++j) {
    Json one{{"constraint", request.conditions.where[j].text()}};
    one.update(json_worst(over.constraints[j]));
    constraints.push_back(one);
  }
  for (const Extent& extent : over.patch)
    patch[std::string(to_string(extent.parameter))] = {
        {"from", json_number(extent.low)}, {"to", json_number(extent.high)}, {"leaves_grid", extent.leaves_grid}};
  return {{"guaranteed", over.outcome == Outcome::within},
          {"outcome", over.outcome == Outcome::within   ? "every plant meets every constraint"
                      : over.outcome == Outcome::beyond ? "some plant breaks a constraint"
                                                        : "open: the bound decides nothing"},
          {"objective_nominal", json_number(over.objective_nominal)},
          {"objective_mean", json_number(over.objective_mean)},
          {"objective_worst",
           {{"value", json_number(over.objective.left)},
            {"plant", json_plant(over.objective.plant)},
            {"at_most", json_number(over.objective.bound)}}},
          {"Ms_worst", {{"value", json_number(over.Ms)}, {"plant", json_plant(over.Ms_plant)}}},
          {"share_not_settled", json_number(over.share_wrong_status)},
          {"constraints", constraints},
          {"share_broken", json_number(over.share)},
          {"patch", patch}};
}

Json json_robust_found(const QueryRequest& request, const QueryUnits& units, const RobustFound& found) {
  Json json = json_found(request.grid(), units, found.nominal);
  json["over_box"] = json_over_box(request, found.over_box);
  return json;
}

Json json_box(const PlantBox& box) {
  const Range ranges[] = {box.K, box.Td, box.T1};
  Json json = Json::object();
  for (const std::size_t k : box.uncertain())
    json[std::string(name_of_uncertain(box.nominal.family, k))] = {{"from", ranges[k].low}, {"to", ranges[k].high}};
  return json;
}

Json json_answer(const QueryRequest& request, const RobustQuestion& question, const RobustAnswer& answer) {
  Json top = Json::array(), broken = Json::array();
  for (const RobustFound& found : answer.top)
    top.push_back(json_robust_found(request, question.conditions.units, found));
  for (std::size_t j = 0; j < answer.broken_by.size(); ++j)
    broken.push_back({{"constraint", question.conditions.where[j].text()}, {"rejects", answer.broken_by[j]}});
  Json json{
      {"optimum", top.empty() ? Json(nullptr) : top.front()},
      {"top", top},
      {"nominal_optimum",
       answer.nominal ? json_robust_found(request, question.conditions.units, *answer.nominal) : Json(nullptr)},
      {"uncertain", json_box(question.box)},
      {"objective_over", to_string(question.over)},
      {"admissible_nominal", answer.admissible},
      {"total", answer.total},
      {"examined", answer.examined},
      {"open", answer.open},
      {"loops", answer.loops},
      {"rejected_at_corners", broken},
      {"rejected_not_settled", answer.not_settled}};
  if (answer.nearest) {
    json["least_violation"] = json_over_box(request, *answer.nearest);
    json["least_violation"]["settings"] = json_settings({request.grid().family, answer.nearest->setting});
  }
  add_units(json, request.grid(), question.conditions);
  return json;
}

// ---------------------------------------------------------------- text

std::string constraint_lines(const QueryRequest& request, const PlantBox& box, const OverBox& over) {
  std::size_t width = 0;
  for (const Constraint& constraint : request.conditions.where) width = std::max(width, constraint.text().size());
  std::string text;
  for (std::size_t j = 0; j < over.constraints.size(); ++j) {
    const WorstPlant& worst = over.constraints[j];
    const std::string& name = request.conditions.where[j].text();
    if (worst.relative <= kDeepest) {
      text += fmt::format("  {:<{}}  {}\n", name, width, "far from broken, or a choice of the setting");
      continue;
    }
    if (std::isinf(worst.relative)) {
      text += fmt::format("  {:<{}}  does not exist at {}: broken; on {} of the box\n", name, width,
                          plant_words(box, worst.plant), percent(worst.share));
      continue;
    }
    text += fmt::format("  {:<{}}  worst {} at {}", name, width, short_number(worst.left),
                        plant_words(box, worst.plant));
    if (worst.relative > 0)
      text += fmt::format(": broken, by {}; on {} of the box\n", percent(worst.relative), percent(worst.share));
    else
      text += fmt::format(": {} to spare, nowhere less than {}\n", percent(-worst.relative),
                          percent(std::max(0.0, -worst.bound)));
  }
  return text;
}

std::string patch_lines(const OverBox& over) {
  std::vector<std::string> moves, leaving;
  for (const Extent& extent : over.patch) {
    moves.push_back(
        fmt::format("{} {}..{}", to_string(extent.parameter), short_number(extent.low), short_number(extent.high)));
    if (extent.leaves_grid) leaving.emplace_back(to_string(extent.parameter));
  }
  if (moves.empty()) return "";
  std::string text = fmt::format("  its patch of the portrait: {}\n", fmt::join(moves, ", "));
  if (!leaving.empty())
    text += fmt::format("  beyond the grid in {}: simulated there, as everywhere on the patch\n",
                        fmt::join(leaving, ", "));
  return text;
}

std::string over_box_text(const QueryRequest& request, const RobustQuestion& question, const OverBox& over) {
  const std::string& objective = question.minimize.text();
  std::string text = fmt::format("  {}: nominal {}", objective, short_number(over.objective_nominal));
  if (!std::isnan(over.objective_mean)) text += fmt::format(", mean {}", short_number(over.objective_mean));
  const std::string there = plant_words(question.box, over.objective.plant);
  text += std::isnan(over.objective.left)
              ? fmt::format(", does not exist at {}", there)
              : fmt::format(", worst {} at {}", short_number(over.objective.left), there);
  if (std::isfinite(over.objective.bound))
    text += fmt::format(", nowhere more than {}", short_number(over.objective.bound));
  text += "\n" + constraint_lines(request, question.box, over);
  text += std::isnan(over.Ms) ? fmt::format("  unstable at {}\n", plant_words(question.box, over.Ms_plant))
                              : fmt::format("  Ms: worst {} at {}\n", short_number(over.Ms),
                                            plant_words(question.box, over.Ms_plant));
  if (!over.right_status)
    text += fmt::format("  does not settle within the horizon at {}; on {} of the box\n",
                        plant_words(question.box, over.wrong_status_plant), percent(over.share_wrong_status));
  return text + patch_lines(over);
}

std::string nominal_text(const QueryRequest& request, const RobustQuestion& question, const RobustAnswer& answer) {
  if (!answer.nominal) return "";
  const RobustFound& nominal = *answer.nominal;
  if (!answer.top.empty() && answer.top.front().nominal.number == nominal.nominal.number)
    return "\nthe optimum for the nominal plant alone is the same setting\n";
  std::string text = fmt::format(
      "\nthe optimum for the nominal plant alone, {} = {} at {}, {}\n", question.minimize.text(),
      short_number(nominal.over_box.objective_nominal), setting_text(request.grid(), nominal.nominal),
      nominal.over_box.outcome == Outcome::within ? "also serves every plant"
      : nominal.over_box.share > 0 ? fmt::format("fails on {} of the box", percent(nominal.over_box.share))
                                   : "is not guaranteed");
  if (!answer.top.empty())
    text += fmt::format(
        "  serving every plant costs {} on the nominal one\n",
        percent(answer.top.front().over_box.objective_nominal / nominal.over_box.objective_nominal - 1));
  return text + over_box_text(request, question, nominal.over_box);
}

std::string counts_text(const RobustQuestion& question, const RobustAnswer& answer) {
  std::string text = fmt::format(
      "{} of {} settings are admissible for the nominal plant; {} were tried on others, {} loops simulated\n",
      answer.admissible, answer.total, answer.examined, answer.loops);
  for (std::size_t j = 0; j < answer.broken_by.size(); ++j)
    if (answer.broken_by[j] > 0)
      text += fmt::format("  {} rejects {} at the corners of the box\n", question.conditions.where[j].text(),
                          answer.broken_by[j]);
  if (answer.not_settled > 0)
    text += fmt::format("  {} do not settle, or lack the objective, at a corner\n", answer.not_settled);
  if (answer.open > 0)
    text += fmt::format("  {} left out: the bound between plants decides nothing\n", answer.open);
  return text;
}

std::string answer_text(const QueryRequest& request, const RobustQuestion& question, const RobustAnswer& answer) {
  const RobustFound& best = answer.top.front();
  std::string text =
      fmt::format("{}, {} over {}: {} at {} (nominal {})\n", question.minimize.text(), to_string(question.over),
                  box_words(question.box), short_number(best.nominal.objective),
                  setting_text(request.grid(), best.nominal), plant_text(question.box.nominal));
  text += over_box_text(request, question, best.over_box);
  text += fmt::format("  {} plants more, spread evenly over the box: none breaks a constraint\n", kProofPlants);
  text += "\n" + counts_text(question, answer) + nominal_text(request, question, answer);
  if (answer.top.size() > 1) text += "\nnext best\n";
  for (std::size_t i = 1; i < answer.top.size(); ++i)
    text += fmt::format("  {:>3}  {:>12}  {}\n", i + 1, short_number(answer.top[i].nominal.objective),
                        setting_text(request.grid(), answer.top[i].nominal));
  if (!question.conditions.where.empty())
    text += "\nconstraints\n" + units_text(request.grid(), question.conditions);
  return text + found_text(request.grid(), question.conditions.units, best.nominal);
}

std::string none_text(const QueryRequest& request, const RobustQuestion& question, const RobustAnswer& answer) {
  std::string text = fmt::format("no setting serves every plant with {}\n", box_words(question.box));
  text += counts_text(question, answer);
  if (answer.nearest)
    text += fmt::format("least violation at {}:\n",
                        portrait::setting_text(Loop{request.grid().family, answer.nearest->setting})) +
            over_box_text(request, question, *answer.nearest);
  text.pop_back();
  return text;
}

RobustQuestion question_from(const QueryRequest& request, const RobustArguments& a) {
  const Grid& grid = request.grid();
  RobustQuestion question{
      .minimize = parse_expression({"--minimize", a.minimize}),
      .conditions = request.conditions,
      .box = uncertain_argument("--uncertain", a.uncertain, request.conditions.units.plant, grid.family.plant),
      .top = a.top};
  question.conditions.units.plant = question.box.nominal;
  const auto over = over_named(a.over);
  if (!over)
    throw InputError(fmt::format("--objective-over: unknown word \"{}\"{}", a.over,
                                 suggestion(a.over, {kOverNames.begin(), kOverNames.end()})));
  question.over = *over;
  return question;
}

int print_setting(const QueryRequest& request, const RobustQuestion& question, const std::string& text) {
  const Setting setting = setting_argument("--why", text, request.grid());
  if (const auto reason = why_invalid(Loop{request.grid().family, setting}))
    throw InputError(fmt::format("--why: {}", *reason));
  const OverBox over = examine(request.grid(), question, setting);
  if (request.form == OutputForm::json) {
    Json json = json_over_box(request, over);
    json["settings"] = json_settings({request.grid().family, setting});
    add_units(json, request.grid(), question.conditions);
    print_json(json);
    return kDone;
  }
  const char* words = over.outcome == Outcome::within   ? "serves every plant with"
                      : over.outcome == Outcome::beyond ? "does not serve every plant with"
                                                        : "is not guaranteed for every plant with";
  print_text(fmt::format("{} {} {}\n", portrait::setting_text(Loop{request.grid().family, setting}), words,
                         box_words(question.box)) +
             over_box_text(request, question, over) + units_text(request.grid(), question.conditions));
  return kDone;
}

}  // namespace

int print_robust(const QueryRequest& request, const RobustArguments& a) {
  const RobustQuestion question = question_from(request, a);
  if (!a.why.empty()) return print_setting(request, question, a.why);
  const RobustAnswer answer = ask_robust(request.portrait, question);
  if (request.form == OutputForm::json) print_json(json_answer(request, question, answer));
  if (answer.top.empty()) {
    print_message(none_text(request, question, answer));
    return kNoneAdmissible;
  }
  if (request.form == OutputForm::text) print_text(answer_text(request, question, answer));
  if (request.form != OutputForm::csv) return kDone;
  std::vector<Found> rows;
  for (const RobustFound& found : answer.top) rows.push_back(found.nominal);
  print_text(csv_text(request.grid(), rows));
  return kDone;
}

}  // namespace portrait::tools
