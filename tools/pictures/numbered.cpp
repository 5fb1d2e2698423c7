#include "tools/pictures/numbered.h"

#include <cmath>

#include <fmt/format.h>

#include "tools/pictures/labels.h"

namespace portrait::pictures {

double Span::share(double value) const {
  return log ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

std::string numbered(Script& script, const std::vector<Mark>& marks, Span x, Span y, Point panel,
                     const std::vector<Point>& drawn) {
  const auto in_characters = [&](Point p) { return Point{x.share(p.x) * panel.x, y.share(p.y) * panel.y}; };
  std::vector<Point> at, obstacles;
  std::vector<std::size_t> widths;
  for (const Mark& mark : marks) {
    at.push_back(in_characters(mark.at));
    widths.push_back(std::to_string(at.size()).size());
  }
  for (const Point p : drawn) obstacles.push_back(in_characters(p));
  const std::vector<LabelPlace> places = label_places(at, widths, obstacles, panel);
  std::string plots;
  for (std::size_t k = 0; k < marks.size(); ++k) {
    const auto [px, py] = marks[k].at;
    script.line(fmt::format("set label '{}' at {:.8g},{:.8g} center offset {:.3g},{:.3g} front boxed", k + 1, px,
                            py, places[k].dx, places[k].dy));
    const std::string point = script.data({{marks[k].at}});
    plots += fmt::format(", {} using 1:2 with points pt 7 ps 1.1 lc rgb 'white' notitle", point);
    plots += fmt::format(", {} using 1:2 with points pt 6 ps 1.1 lw 2 lc rgb 'black' title {}", point,
                         quoted(fmt::format("{}  {}", k + 1, marks[k].label)));
  }
  return plots;
}

}  // namespace portrait::pictures
