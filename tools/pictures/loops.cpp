#include "tools/pictures/loops.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "engine/loop/open_loop.h"
#include "engine/loop/sensitivity.h"
#include "engine/loop/stability.h"
#include "engine/reference/response.h"
#include "tools/pictures/simplify.h"

namespace portrait::pictures {
namespace {

constexpr Size kResponsesSize{20, 14}, kNyquistSize{14, 14};
constexpr std::size_t kPoints = 4000;
constexpr double kInvisible = 1e-4;  // of a panel

/// Factors from normalised t, y and u to real ones, after each step (engine/loop/real_plant.h).
struct Scale {
  double t = 1, y = 1, u = 1;
};

Scale scale_of(std::size_t step, const std::optional<RealPlant>& plant) {
  if (!plant) return {};
  const double g = input_gain(*plant);
  return step == reference::kSetpoint ? Scale{plant->Td, 1, 1 / g} : Scale{plant->Td, g, 1};
}

Sampled sampled(const reference::StepResponse& response, double horizon, std::size_t most) {
  Sampled result;
  for (const reference::Piece& piece : response.pieces) {
    const double share = piece.length / horizon * static_cast<double>(most);
    const int points = std::max(1, static_cast<int>(share));
    for (int i = 0; i <= points; ++i) {
      const double x = 2.0 * i / points - 1;
      result.t.push_back(piece.start + 0.5 * (x + 1) * piece.length);
      result.y.push_back(reference::value(piece.y, x));
      result.u.push_back(reference::value(piece.u, x));
    }
  }
  return result;
}

Outline curve(const Sampled& samples, const std::vector<double>& values, double t, double factor) {
  Outline points;
  for (std::size_t i = 0; i < values.size(); ++i) points.push_back({samples.t[i] * t, values[i] * factor});
  return simplified(points, kInvisible);
}

Outline circle(Point centre, double radius) {
  constexpr int kSteps = 180;
  Outline points;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSteps;
    points.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return points;
}

struct Panel {
  std::size_t step;
  bool is_y;
  const char* title;
};
constexpr std::array<Panel, 4> kPanels = {{{reference::kSetpoint, true, "unit setpoint step"},
                                           {reference::kDisturbance, true, "unit input disturbance"},
                                           {reference::kSetpoint, false, ""},
                                           {reference::kDisturbance, false, ""}}};

std::string axis(const char* what, const char* unit, bool real) {
  return fmt::format("set ylabel '{} [{}]'", what, real ? "real units" : unit);
}

void responses_panel(Script& script, const Panel& panel, const std::vector<NamedLoop>& loops,
                     const std::vector<std::vector<Sampled>>& all, const std::optional<RealPlant>& plant) {
  const Scale scale = scale_of(panel.step, plant);
  script.line("set title " + quoted(panel.title));
  script.line(panel.is_y ? axis("output y", "1", plant.has_value())
                         : axis("controller output u", "1", plant.has_value()));
  const bool keyed = panel.is_y && panel.step == reference::kSetpoint;
  script.line(keyed ? "set key bottom right" : "unset key");
  std::string plots;
  for (std::size_t k = 0; k < loops.size(); ++k) {
    const Sampled& samples = all[k][panel.step];
    plots += fmt::format(
        "{}{} using 1:2 with lines {} title {}", k > 0 ? ", " : "plot ",
        script.data({curve(samples, panel.is_y ? samples.y : samples.u, scale.t, panel.is_y ? scale.y : scale.u)}),
        curve_style(k), quoted(loops[k].label));
  }
  script.line(plots);
}

double frequency_with_gain(const OpenLoop& loop, double gain, double from) {
  double omega = from;
  const bool rising = from < 1;
  for (int i = 0; i < 400; ++i) {
    const double here = gain_at(loop, omega);
    if (rising ? here <= gain : here >= gain) break;
    omega *= rising ? 1.1 : 1 / 1.1;
  }
  return omega;
}

}  // namespace

std::vector<Sampled> sampled_responses(const Loop& loop, Horizon horizon, std::size_t most) {
  const reference::Response response = reference::simulate(loop, horizon);
  std::vector<Sampled> result;
  for (const auto& step : response.steps) result.push_back(sampled(step, response.horizon, most));
  return result;
}

std::vector<Point> nyquist_curve(const Loop& loop, double largest, double smallest, std::size_t points) {
  const OpenLoop open = open_loop(loop);
  const double low = frequency_with_gain(open, largest, 1e-6);
  const double high = std::max(frequency_with_gain(open, smallest, 1e4), 30.0);
  std::vector<Point> curve;
  for (std::size_t i = 0; i < points; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(points - 1);
    const std::complex<double> L = response_at(open, low * std::pow(high / low, t));
    curve.push_back({L.real(), L.imag()});
  }
  return curve;
}

Script responses(const std::string& title, const std::vector<NamedLoop>& loops, Horizon horizon,
                 const std::optional<RealPlant>& plant) {
  std::vector<std::vector<Sampled>> all;
  double end = 0;
  for (const NamedLoop& named : loops) {
    all.push_back(sampled_responses(named.loop, horizon, kPoints));
    end = std::max(end, all.back()[0].t.back());
  }
  const double Td = plant ? plant->Td : 1;
  Script script(kResponsesSize);
  script.line("set multiplot layout 2,2 title " + quoted(title));
  script.line(fmt::format("set xrange [0:{:.8g}]\nset xlabel {}", end * Td,
                          quoted(plant ? "time [unit of Td]" : "time [Td]")));
  for (const Panel& panel : kPanels) responses_panel(script, panel, loops, all, plant);
  script.line("unset multiplot");
  return script;
}

Script nyquist(const std::string& title, const std::vector<NamedLoop>& loops, double Ms) {
  Script script(kNyquistSize);
  script.line("set title " + quoted(title));
  script.line("set xlabel 'Re L(j omega) [1]'\nset ylabel 'Im L(j omega) [1]'");
  script.line(
      "set size ratio -1\nset xrange [-2.5:1]\nset yrange [-2:1.5]\nset key bottom right\nset zeroaxis lc rgb "
      "'#888888'");
  std::string plots = fmt::format("plot {} using 1:2 with lines lw 1 lc rgb '#888888' dt 3 title 'unit circle'",
                                  script.data({circle({0, 0}, 1)}));
  plots +=
      fmt::format(", {} using 1:2 with points pt 1 ps 1.4 lw 2 lc rgb 'black' notitle", script.data({{{-1, 0}}}));
  if (Ms > 1)
    plots += fmt::format(", {} using 1:2 with lines lw 1.4 lc rgb 'black' dt 2 title 'Ms = {:.4g}'",
                         script.data({circle({-1, 0}, 1 / Ms)}), Ms);
  for (std::size_t k = 0; k < loops.size(); ++k) {
    const OpenLoop open = open_loop(loops[k].loop);
    const bool stable = is_stable(open);
    const double own = stable ? sensitivity_peak(open).value : 0;
    const std::string label =
        stable ? fmt::format("{}, Ms = {:.4g}", loops[k].label, own) : loops[k].label + ", unstable";
    plots += fmt::format(", {} using 1:2 with lines {} title {}",
                         script.data({simplified(nyquist_curve(loops[k].loop, 8, 0.02, kPoints), kInvisible)}),
                         curve_style(k), quoted(label));
    if (Ms <= 1 && stable && std::isfinite(own))
      plots += fmt::format(", {} using 1:2 with lines lw 0.8 lc rgb '{}' dt 3 notitle",
                           script.data({circle({-1, 0}, 1 / own)}), curve_colour(k));
  }
  script.line(plots);
  return script;
}

Script bars(const std::string& title, const std::vector<std::string>& loops, const std::vector<Bars>& measures) {
  const int columns = std::min<int>(3, static_cast<int>(measures.size()));
  const int rows = (static_cast<int>(measures.size()) + columns - 1) / columns;
  Script script({columns == 1 ? 12.0 : 20.0, 1.5 + 6.5 * rows});
  script.line(fmt::format("set multiplot layout {},{} title {}", rows, columns, quoted(title)));
  script.line(
      "set style fill pattern border\nset boxwidth 0.7\nset tmargin 2.5\nunset key\nset xtics rotate by -40 "
      "noenhanced");
  script.line(fmt::format("set xrange [-0.6:{}]\nset yrange [0:*]", static_cast<double>(loops.size()) - 0.4));
  std::string tics;
  for (std::size_t k = 0; k < loops.size(); ++k)
    tics += fmt::format("{}{} {}", k > 0 ? ", " : "", quoted(loops[k]), k);
  script.line("set xtics (" + tics + ")");
  for (const Bars& measure : measures) {
    script.line("set ylabel " + quoted(measure.label));
    std::string plots;
    for (std::size_t k = 0; k < measure.values.size(); ++k)
      plots += fmt::format("{}{} using 1:2 with boxes fs pattern {} lc rgb '{}' title {}", k > 0 ? ", " : "plot ",
                           script.table({{static_cast<double>(k), measure.values[k]}}), k % 7 + 1, curve_colour(k),
                           quoted(loops[k]));
    script.line(plots);
  }
  script.line("unset multiplot");
  return script;
}

}  // namespace portrait::pictures
