#include "tools/pictures/contours.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace portrait::pictures {
namespace {

using Edge = std::pair<std::size_t, std::size_t>;  ///< two nodes, the lower first

Edge edge(std::size_t a, std::size_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

/// Corners of cell (i, j) that are finite, counterclockwise; empty when fewer than three.
std::vector<std::size_t> corners(const Field& field, std::size_t i, std::size_t j) {
  const std::size_t n = field.x.size(), origin = j * n + i;
  std::vector<std::size_t> nodes;
  for (const std::size_t node : {origin, origin + 1, origin + n + 1, origin + n})
    if (std::isfinite(field.at(node))) nodes.push_back(node);
  if (nodes.size() < 3) nodes.clear();
  return nodes;
}

/// A corner of the part of a cell at or above the level: a node, or a cut through an edge. Walked counterclockwise, the
/// cell's border leaves the part at one cut and comes back at the next.
struct Vertex {
  enum class Kind { node, leaves, returns } kind;
  Edge edge;  ///< of a node twice the node
};

std::vector<Vertex> part_above(const Field& field, const std::vector<std::size_t>& nodes, double level) {
  std::vector<Vertex> part;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const std::size_t here = nodes[k], next = nodes[(k + 1) % nodes.size()];
    const bool above = field.at(here) >= level;
    if (above) part.push_back({Vertex::Kind::node, {here, here}});
    if (above != (field.at(next) >= level))
      part.push_back({above ? Vertex::Kind::leaves : Vertex::Kind::returns, edge(here, next)});
  }
  return part;
}

double between(double a, double b, double t, bool log) {
  return log ? std::exp(std::lerp(std::log(a), std::log(b), t)) : std::lerp(a, b, t);
}

/// The whole cells first .. end - 1 of row j.
Outline row_of_cells(const Field& field, std::size_t first, std::size_t end, std::size_t j) {
  return {{field.x[first], field.y[j]},
          {field.x[end], field.y[j]},
          {field.x[end], field.y[j + 1]},
          {field.x[first], field.y[j + 1]}};
}

bool is_whole(const std::vector<Vertex>& part) {
  return part.size() == 4 &&
         std::all_of(part.begin(), part.end(), [](const Vertex& v) { return v.kind == Vertex::Kind::node; });
}

using Neighbours = std::map<Edge, std::vector<Edge>>;

/// A line runs from each cut at which the border leaves the part to the one at which it returns.
void join(const std::vector<Vertex>& part, Neighbours& neighbours) {
  for (std::size_t k = 0; k < part.size(); ++k) {
    if (part[k].kind != Vertex::Kind::leaves) continue;
    const Edge from = part[k].edge, to = part[(k + 1) % part.size()].edge;
    neighbours[from].push_back(to);
    neighbours[to].push_back(from);
  }
}

std::vector<Edge> follow(Neighbours& neighbours, Edge start) {
  std::vector<Edge> line{start};
  while (!neighbours[line.back()].empty()) {
    const Edge here = line.back(), next = neighbours[here].back();
    neighbours[here].pop_back();
    auto& back = neighbours[next];
    back.erase(std::find(back.begin(), back.end(), here));
    line.push_back(next);
  }
  return line;
}

}  // namespace

Crossing interpolated(const Field& field, double level) {
  return [&field, level](std::size_t a, std::size_t b) -> Point {
    const double t = (level - field.at(a)) / (field.at(b) - field.at(a));
    const Point p = field.point(a), q = field.point(b);
    return {between(p.x, q.x, t, field.log_x), between(p.y, q.y, t, field.log_y)};
  };
}

std::vector<Outline> areas_above(const Field& field, double level, const Crossing& crossing) {
  std::vector<Outline> areas;
  for (std::size_t j = 0; j + 1 < field.y.size(); ++j) {
    std::size_t whole = 0;  // cells of the run that ends before cell i
    for (std::size_t i = 0; i + 1 < field.x.size(); ++i) {
      const std::vector<Vertex> part = part_above(field, corners(field, i, j), level);
      if (is_whole(part)) {
        ++whole;
        continue;
      }
      if (whole > 0) areas.push_back(row_of_cells(field, i - whole, i, j));
      whole = 0;
      if (part.empty()) continue;
      Outline& outline = areas.emplace_back();
      for (const Vertex& v : part)
        outline.push_back(v.kind == Vertex::Kind::node ? field.point(v.edge.first)
                                                       : crossing(v.edge.first, v.edge.second));
    }
    const std::size_t cells = field.x.size() - 1;
    if (whole > 0) areas.push_back(row_of_cells(field, cells - whole, cells, j));
  }
  return areas;
}

std::vector<Outline> lines_at(const Field& field, double level, const Crossing& crossing) {
  Neighbours neighbours;
  for (std::size_t j = 0; j + 1 < field.y.size(); ++j)
    for (std::size_t i = 0; i + 1 < field.x.size(); ++i)
      join(part_above(field, corners(field, i, j), level), neighbours);
  std::vector<Outline> lines;
  const auto trace = [&](const Edge& start) {
    Outline& line = lines.emplace_back();
    for (const Edge& cut : follow(neighbours, start)) line.push_back(crossing(cut.first, cut.second));
  };
  std::vector<Edge> ends, all;
  for (const auto& [cut, others] : neighbours) {
    all.push_back(cut);
    if (others.size() == 1) ends.push_back(cut);
  }
  for (const Edge& end : ends)  // open lines first, from one of their ends
    if (neighbours[end].size() == 1) trace(end);
  for (const Edge& cut : all)
    while (!neighbours[cut].empty()) trace(cut);
  return lines;
}

}  // namespace portrait::pictures
