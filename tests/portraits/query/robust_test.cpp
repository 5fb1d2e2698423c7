/// Robust answers against plain loops over settings and dense plants, and against real simulation of random plants.
#include "portraits/query/robust.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "tests/oracle/random.h"
#include "tests/portraits/query/error_text.h"
#include "tests/portraits/query/memory_source.h"
#include "tests/portraits/query/real_loop.h"

namespace portrait {
namespace {

using oracle::Random;

/// What a sweep would store.
MemorySource swept(const Grid& grid) {
  MemorySource source(grid);
  std::vector<Setting> settings;
  for (std::uint64_t i = 0; i < setting_count(grid); ++i) settings.push_back(setting_at(grid, i));
  const std::vector<Measured> found = measure(grid, {}, settings, 0);
  for (std::uint64_t i = 0; i < found.size(); ++i) {
    source.status(i) = found[i].status;
    for (const Measure m : grid.measures) source.at(m, i) = found[i].measures[m];
  }
  return source;
}

RobustQuestion robust_question(const std::string& minimize, const std::vector<std::string>& where,
                               const PlantBox& box, Over over = Over::worst) {
  RobustQuestion question{
      .minimize = parse_expression({"--minimize", minimize}), .conditions = {}, .box = box, .over = over};
  for (const std::string& text : where) question.conditions.where.push_back(parse_constraint({"--where", text}));
  question.conditions.units.plant = box.nominal;
  return question;
}

// ---------------------------------------------------------------- an example, and 1,000 random plants

Grid ipdt_pid() {
  Grid grid;
  grid.family = {Plant::ipdt, 1, Prefilter::full};
  grid.horizon = Horizon::fixed(80);
  grid.measures = {Measure::IAE_w, Measure::IAE_d, Measure::TV0_yw, Measure::TV1_yd, Measure::TV2_uw, Measure::Ms};
  grid.axes = {Axis::linear(Parameter::kappa, 0.2, 1.0, 33), Axis::linear(Parameter::tau_i, 3, 12, 19),
               Axis::linear(Parameter::delta, 0, 0.4, 9)};
  grid.fixed = {{Parameter::tau_f, 0.1}, {Parameter::b, 0}, {Parameter::c, 0}};
  return grid;
}

/// K = 2 and Td = 0.5, both within +-20 %.
PlantBox twenty_percent() { return {{Plant::ipdt, 2, 0.5, 0}, {1.6, 2.4}, {0.4, 0.6}, {0, 0}}; }

/// How many of random plants of the box break a constraint under a real controller, each loop written down and simulated
/// in its own units.
int broken_of(int plants, const Grid& grid, const RobustQuestion& question, const Setting& setting,
              double* worst_violation) {
  Random random(2022);
  const RealController controller = controller_for({grid.family, setting}, question.box.nominal);
  int broken = 0;
  *worst_violation = -kInf;
  for (int i = 0; i < plants; ++i) {
    const RealPlant plant = question.box.at({random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)});
    const reference::Measured found =
        measured_in_real_units(controller, plant, grid.family, grid.horizon, question.conditions.units.steps);
    const Measured measured{setting, found.status, found.measures, question.box.nominal};
    bool breaks = found.status != Status::settled;
    for (const Constraint& constraint : question.conditions.where) {
      const double left = value_at(constraint.left, measured), right = value_at(constraint.right, measured);
      breaks = breaks || !holds(constraint.relation, left, right);
      *worst_violation = std::max(*worst_violation, left / right - 1);
    }
    broken += breaks ? 1 : 0;
  }
  return broken;
}

#ifdef PORTRAIT_SANITIZED
constexpr int kPlants = 100;
#else
constexpr int kPlants = 1000;
#endif

TEST(Robust, none_of_a_thousand_random_plants_breaks_a_constraint) {
  const MemorySource source = swept(ipdt_pid());
  const RobustQuestion question =
      robust_question("IAE_d", {"Ms <= 2", "TV1_yd <= 0.02", "TV2_uw <= 0.05"}, twenty_percent());
  const RobustAnswer answer = ask_robust(source, question);
  ASSERT_EQ(answer.top.size(), 1u);
  double violation = 0;
  EXPECT_EQ(broken_of(kPlants, source.grid(), question, answer.top[0].nominal.setting, &violation), 0);
  EXPECT_LE(violation, answer.top[0].over_box.constraints[0].bound);
  // The bound binds in a corner of the box: the fewer the plants, the further from it is the nearest.
  EXPECT_GT(violation, kPlants < 1000 ? -0.1 : -0.05) << "the example should come near a bound";
  // The nominal optimum, which keeps every bound on its own plant, breaks one on most of the others.
  ASSERT_TRUE(answer.nominal);
  const OverBox& nominal = answer.nominal->over_box;
  EXPECT_EQ(nominal.outcome, Outcome::beyond);
  const int some = kPlants / 4, broken = broken_of(some, source.grid(), question, nominal.setting, &violation);
  EXPECT_NEAR(static_cast<double>(broken) / some, nominal.share, kPlants < 1000 ? 0.2 : 0.1);
  EXPECT_GT(nominal.share, 0.5);
  double worst = -kInf;
  for (const WorstPlant& one : nominal.constraints) worst = std::max(worst, one.relative);
  EXPECT_LE(violation, worst);
  EXPECT_GT(violation, 1);
}

TEST(Robust, the_objective_orders_the_answers) {
  const MemorySource source = swept(ipdt_pid());
  RobustQuestion question = robust_question("IAE_w + IAE_d", {"Ms <= 2.2"}, twenty_percent());
  question.top = 5;
  for (const Over over : {Over::worst, Over::mean, Over::nominal}) {
    question.over = over;
    const RobustAnswer answer = ask_robust(source, question);
    ASSERT_EQ(answer.top.size(), 5u) << to_string(over);
    for (std::size_t i = 0; i < 5; ++i) {
      const RobustFound& found = answer.top[i];
      EXPECT_GE(found.nominal.objective, answer.top[i == 0 ? 0 : i - 1].nominal.objective);
      const double expected = over == Over::worst  ? found.over_box.objective.left
                              : over == Over::mean ? found.over_box.objective_mean
                                                   : found.over_box.objective_nominal;
      EXPECT_NEAR(found.nominal.objective, expected, 1e-5 * expected) << to_string(over);
      EXPECT_LE(found.over_box.objective_mean, found.over_box.objective.left);
      EXPECT_LE(found.over_box.objective.left, found.over_box.objective.bound);
    }
  }
}

TEST(Robust, does_not_depend_on_threads) {
  const MemorySource source = swept(ipdt_pid());
  RobustQuestion question = robust_question("IAE_d", {"Ms <= 2"}, twenty_percent());
  question.top = 3;
  question.conditions.threads = 1;
  const RobustAnswer one = ask_robust(source, question);
  question.conditions.threads = 3;
  const RobustAnswer three = ask_robust(source, question);
  ASSERT_EQ(one.top.size(), three.top.size());
  for (std::size_t i = 0; i < one.top.size(); ++i) {
    EXPECT_EQ(one.top[i].nominal.number, three.top[i].nominal.number);
    EXPECT_EQ(one.top[i].nominal.objective, three.top[i].nominal.objective);
    EXPECT_EQ(one.top[i].over_box.constraints[0].bound, three.top[i].over_box.constraints[0].bound);
  }
  EXPECT_EQ(one.loops, three.loops);
  EXPECT_EQ(one.examined, three.examined);
}

TEST(Robust, a_box_of_one_plant_gives_the_plain_answer) {
  const MemorySource source = swept(ipdt_pid());
  const RealPlant plant{Plant::ipdt, -3, 2, 0};
  const RobustQuestion robust =
      robust_question("IAE_d", {"Ms <= 1.8", "TV2_uw <= 0.001"}, {plant, {-3, -3}, {2, 2}, {0, 0}});
  const Question plain{.minimize = robust.minimize, .conditions = robust.conditions};
  const RobustAnswer answer = ask_robust(source, robust);
  ASSERT_EQ(answer.top.size(), 1u);
  EXPECT_EQ(answer.top[0].nominal.number, ask(source, plain).top[0].number);
  EXPECT_EQ(answer.nominal->nominal.number, answer.top[0].nominal.number);
}

TEST(Robust, says_what_is_nearest_when_no_setting_serves_all) {
  const MemorySource source = swept(ipdt_pid());
  PlantBox box = twenty_percent();
  box.K = {1.2, 3.5};
  const RobustAnswer answer = ask_robust(source, robust_question("IAE_d", {"Ms <= 1.3"}, box));
  EXPECT_TRUE(answer.top.empty());
  ASSERT_TRUE(answer.nearest);
  EXPECT_EQ(answer.nearest->outcome, Outcome::beyond);
  EXPECT_GT(answer.nearest->constraints[0].relative, 0);
  EXPECT_GT(answer.broken_by[0], 0u);
  EXPECT_GT(answer.nearest->share, 0);
  EXPECT_EQ(answer.broken_by[0] + answer.not_settled + answer.open, answer.examined);
  EXPECT_EQ(answer.loops, 4 * answer.examined) << "the corners were enough";
}

/// P or PI on an integrator of which the gain is uncertain.
Grid ipdt_pi(std::vector<Axis> axes) {
  Grid grid;
  grid.family = {Plant::ipdt, 0, Prefilter::none};
  grid.horizon = Horizon::fixed(100);
  grid.measures = {Measure::IAE_w, Measure::DC_yw};
  grid.axes = std::move(axes);
  grid.fixed = {{Parameter::delta, 0}};
  return grid;
}
PlantBox of_gains(double low, double high) { return {{Plant::ipdt, 1, 1, 0}, {low, high}, {1, 1}, {0, 0}}; }

/// Far from the order of the worst plants: what is best on the nominal one oscillates on others.
TEST(Robust, the_nominal_best_is_the_answer_where_it_serves_all) {
  const MemorySource source =
      swept(ipdt_pi({Axis::linear(Parameter::kappa, 0.1, 0.9, 33), Axis::list(Parameter::tau_i, {kInf})}));
  RobustQuestion question = robust_question("IAE_w", {}, of_gains(0.9, 1.6), Over::nominal);
  question.conditions.include_not_settled = true;
  const RobustAnswer answer = ask_robust(source, question);
  ASSERT_EQ(answer.top.size(), 1u);
  const Question plain{.minimize = question.minimize, .conditions = question.conditions};
  EXPECT_EQ(answer.top[0].nominal.number, ask(source, plain).top[0].number);
  EXPECT_EQ(answer.top[0].over_box.outcome, Outcome::within);
  EXPECT_GT(answer.top[0].over_box.objective.left, 1.2 * answer.top[0].nominal.objective);
}

/// A measure that jumps from 1 to 2, at most 2: no bound that allows for a jump is 2.
TEST(Robust, a_jump_up_to_the_limit_is_left_open) {
  const MemorySource source =
      swept(ipdt_pi({Axis::list(Parameter::kappa, {0.5}), Axis::list(Parameter::tau_i, {8})}));
  const RobustAnswer answer = ask_robust(source, robust_question("IAE_w", {"DC_yw <= 2"}, of_gains(0.5, 1.5)));
  EXPECT_TRUE(answer.top.empty());
  EXPECT_EQ(answer.examined, 1u);
  EXPECT_EQ(answer.broken_by[0] + answer.not_settled, 0u);
  EXPECT_EQ(answer.open, 1u);
  ASSERT_TRUE(answer.nearest);
  EXPECT_EQ(answer.nearest->outcome, Outcome::open);
  EXPECT_EQ(answer.nearest->constraints[0].left, 2);
}

/// More than are selected at first, and than a whole number of waves.
TEST(Robust, every_setting_is_examined_when_none_serves) {
  const MemorySource source =
      swept(ipdt_pi({Axis::linear(Parameter::kappa, 0.2, 0.5, 75), Axis::linear(Parameter::tau_i, 5, 12, 70)}));
  RobustQuestion question = robust_question("IAE_w", {}, of_gains(0.5, 30));
  question.top = 5000;
  question.conditions.include_not_settled = true;
  const RobustAnswer answer = ask_robust(source, question);
  EXPECT_TRUE(answer.top.empty());
  EXPECT_EQ(answer.admissible, 5250u);
  EXPECT_EQ(answer.examined, 5250u);
  EXPECT_EQ(answer.not_settled, 5250u);
}

TEST(Robust, names_of_axes_choose_the_nominal_setting) {
  const MemorySource source = swept(ipdt_pid());
  const RobustAnswer answer =
      ask_robust(source, robust_question("IAE_d", {"Ms <= 2", "delta == 0.2", "Kc <= 0.45"}, twenty_percent()));
  ASSERT_EQ(answer.top.size(), 1u);
  EXPECT_EQ(answer.top[0].nominal.setting.delta, 0.2);
  EXPECT_LE(answer.top[0].nominal.setting.kappa, 0.45);
  EXPECT_EQ(error_text([&] { ask_robust(source, robust_question("IAE_d", {"Ms == 2"}, twenty_percent())); }),
            "--where:1:1: cannot hold for every plant of a box: give it as <= or >=\n  Ms == 2\n  ^");
}

// ---------------------------------------------------------------- brute force

struct RandomCase {
  Grid grid;
  RobustQuestion question;
};

Grid random_small_grid(Random& random) {
  Grid grid;
  const auto plant = static_cast<Plant>(random.below(3));
  const int n = random.below(2);
  grid.family = {plant, n, usual_prefilter(n)};
  grid.horizon = Horizon::fixed(plant == Plant::fotd ? 60 : 120);
  grid.measures = {Measure::IAE_w,   Measure::IAE_d, Measure::TV0_yw, Measure::TV2_uw, Measure::TV2_ud,
                   Measure::u_max_w, Measure::Ms,    Measure::GM,     Measure::DM};
  if (plant == Plant::dipdt)
    grid.axes = {Axis::linear(Parameter::kappa, 0.02, 0.2, 5), Axis::linear(Parameter::delta, 0.25, 0.7, 4),
                 Axis::list(Parameter::tau_i, {8, 14, 22})};
  if (plant == Plant::ipdt)
    grid.axes = {Axis::linear(Parameter::kappa, 0.1, 0.8, 6), Axis::list(Parameter::tau_i, {4, 7, 12}),
                 Axis::linear(Parameter::delta, 0, 0.3, 3)};
  if (plant == Plant::fotd)
    grid.axes = {Axis::list(Parameter::tau_1, {1, 3}), Axis::linear(Parameter::kappa, 0.3, 2.4, 6),
                 Axis::list(Parameter::tau_i, {1.2, 2.5, 4}), Axis::linear(Parameter::tau_d, 0.1, 0.4, 2)};
  if (n > 0) grid.fixed = {{Parameter::tau_f, 0.15}};
  if (grid.family.prefilter != Prefilter::none) grid.fixed.push_back({Parameter::b, 0});
  if (grid.family.prefilter == Prefilter::full) grid.fixed.push_back({Parameter::c, 0});
  return grid;
}

PlantBox random_box(Random& random, Plant family) {
  const double K = random.log_uniform(0.2, 5) * (random.chance(0.3) ? -1 : 1), Td = random.log_uniform(0.1, 10);
  const double T1 = family == Plant::fotd ? 3 * Td : 0;
  const auto around = [&](double value) {
    const double part = random.uniform(0.02, 0.25);
    const double low = value - part * std::abs(value),
                 high = value + random.uniform(0.3, 1) * part * std::abs(value);
    return random.chance(0.15) ? Range{value, value} : Range{low, high};
  };
  PlantBox box{{family, K, Td, T1}, around(K), around(Td), {T1, T1}};
  if (family == Plant::fotd) box.T1 = around(T1);
  return box;
}

RandomCase random_robust_case(std::uint64_t seed) {
  Random random(seed);
  const Grid grid = random_small_grid(random);
  std::vector<std::string> where = {"Ms <= " + std::to_string(random.uniform(1.6, 3))};
  if (random.chance(0.5)) where.push_back("TV2_ud <= " + std::to_string(random.uniform(0.01, 0.3)));
  if (random.chance(0.5)) where.push_back("TV0_yw <= " + std::to_string(random.uniform(0.01, 0.3)));
  if (random.chance(0.3)) where.emplace_back("GM > 2.2");
  if (random.chance(0.3)) where.emplace_back("TV2_uw < 0.3 * u_max_w + 0.01*Kc^2");
  const auto over = static_cast<Over>(random.below(3));
  return {grid, robust_question(random.chance(0.5) ? "IAE_d" : "IAE_w + 2*TV2_uw", where,
                                random_box(random, grid.family.plant), over)};
}

/// Everything on a dense lattice of plants, by plain loops over single loops.
struct Dense {
  bool meets_all = true;
  double worst = -kInf;
};
Dense dense_of(const RandomCase& one, const Setting& setting, const std::vector<BoxPoint>& points) {
  Dense dense;
  const PlantBox& box = one.question.box;
  std::vector<Setting> settings;
  std::vector<RealPlant> plants;
  for (const BoxPoint& point : points) {
    plants.push_back(box.at(point));
    settings.push_back(
        normalised(controller_for({one.grid.family, setting}, box.nominal), plants.back(), one.grid.family));
  }
  const std::vector<Measured> found = measure(one.grid, {}, settings, 0);
  for (std::size_t i = 0; i < found.size(); ++i) {
    Measured real = found[i];
    for (const Measure m : one.grid.measures) real.measures[m] *= scale(m, plants[i]);
    real.setting = setting;  // names of axes and of the controller mean the nominal setting
    real.plant = box.nominal;
    dense.meets_all = dense.meets_all && real.status == Status::settled;
    for (const Constraint& c : one.question.conditions.where)
      dense.meets_all = dense.meets_all && holds(c.relation, value_at(c.left, real), value_at(c.right, real));
    dense.worst = std::max(dense.worst, value_at(one.question.minimize, real));
  }
  return dense;
}

std::vector<BoxPoint> lattice(const PlantBox& box, int steps) {
  std::vector<BoxPoint> points = {{0, 0, 0}};
  for (const std::size_t k : box.uncertain()) {
    std::vector<BoxPoint> more;
    for (const BoxPoint& point : points)
      for (int i = 0; i <= steps; ++i) {
        more.push_back(point);
        more.back()[k] = static_cast<double>(i) / steps;
      }
    points = more;
  }
  return points;
}

/// Whether a plant of the report really breaks something, simulated by itself in real units.
bool is_proof(const RandomCase& one, const OverBox& over) {
  if (std::isnan(over.Ms) || !over.right_status) return true;
  for (std::size_t j = 0; j < over.constraints.size(); ++j) {
    const WorstPlant& worst = over.constraints[j];
    if (!(worst.relative > 0)) continue;
    const RealController controller = controller_for({one.grid.family, over.setting}, one.question.box.nominal);
    const reference::Measured found =
        measured_in_real_units(controller, worst.plant, one.grid.family, one.grid.horizon, {});
    const Measured real{over.setting, found.status, found.measures, one.question.box.nominal};
    const Constraint& c = one.question.conditions.where[j];
    if (!holds(c.relation, value_at(c.left, real), value_at(c.right, real))) return true;
  }
  return false;
}

/// What is said of the worst plants, simulated one by one in real units.
void expect_as_simulated(const RandomCase& one, const OverBox& over) {
  const RealController controller = controller_for({one.grid.family, over.setting}, one.question.box.nominal);
  const auto simulated = [&](const RealPlant& plant) {
    const reference::Measured found =
        measured_in_real_units(controller, plant, one.grid.family, one.grid.horizon, {});
    return Measured{over.setting, found.status, found.measures, one.question.box.nominal};
  };
  const double objective = value_at(one.question.minimize, simulated(over.objective.plant));
  EXPECT_NEAR(over.objective.left, objective, 1e-6 * objective);
  for (std::size_t j = 0; j < over.constraints.size(); ++j) {
    const WorstPlant& worst = over.constraints[j];
    const Measured real = simulated(worst.plant);
    const double left = value_at(one.question.conditions.where[j].left, real);
    EXPECT_NEAR(worst.left, left, 1e-6 * (1 + std::abs(left)));
    EXPECT_NEAR(worst.right, value_at(one.question.conditions.where[j].right, real), 1e-6 * (1 + worst.right));
  }
}

#ifdef PORTRAIT_SANITIZED
constexpr std::uint64_t kCases = 4;
#else
constexpr std::uint64_t kCases = 20;
#endif

TEST(Robust, is_what_trying_every_setting_on_dense_plants_gives) {
  int answered = 0, open = 0, sharper = 0;
  for (std::uint64_t seed = 0; seed < kCases; ++seed) {
    SCOPED_TRACE(seed);
    RandomCase one = random_robust_case(seed);
    one.question.top = 3;
    const MemorySource source = swept(one.grid);
    const RobustAnswer answer = ask_robust(source, one.question);
    const auto points = lattice(one.question.box, one.question.box.uncertain().size() == 3 ? 8 : 20);
    const Question all{.minimize = one.question.minimize, .conditions = one.question.conditions, .top = 10000};
    const double best = answer.top.size() == 3 ? answer.top.back().nominal.objective : kInf;
    std::set<std::uint64_t> taken;
    answered += answer.top.empty() ? 0 : 1;
    for (const RobustFound& found : answer.top) {
      taken.insert(found.nominal.number);
      EXPECT_EQ(found.over_box.outcome, Outcome::within);
      EXPECT_TRUE(dense_of(one, found.nominal.setting, points).meets_all);
      expect_as_simulated(one, found.over_box);
    }
    for (const Found& found : ask(source, all).top) {
      const Dense dense = dense_of(one, found.setting, points);
      if (!dense.meets_all || taken.contains(found.number)) continue;
      const OverBox over = examine(one.grid, one.question, found.setting);
      const double objective = one.question.over == Over::worst  ? std::max(dense.worst, over.objective.left)
                               : one.question.over == Over::mean ? over.objective_mean
                                                                 : found.objective;
      if (objective > best) continue;
      // Better and not taken: either a plant between those of the lattice breaks it, or its bound stayed open.
      open += over.outcome == Outcome::open ? 1 : 0;
      sharper += over.outcome == Outcome::beyond ? 1 : 0;
      EXPECT_NE(over.outcome, Outcome::within) << setting_text({one.grid.family, found.setting});
      EXPECT_TRUE(over.outcome != Outcome::beyond || is_proof(one, over));
    }
  }
  EXPECT_GE(answered, static_cast<int>(kCases) / 3);
  EXPECT_LE(open, 2);
  EXPECT_LE(sharper, 5);
}

}  // namespace
}  // namespace portrait
