/// Integral of a smooth function over panels that are halved where they are too wide.
///
/// Each panel has a Kronrod rule of 15 points and the Gauss rule of 7 among them; the panel on which the two differ
/// most is halved first, until all differences together are below a part of the integral. The Kronrod values that
/// are added up are far closer than that.
/// cost      15 values a panel
#pragma once

#include <array>
#include <cmath>
#include <queue>
#include <vector>

namespace portrait {

/// A stretch of the axis; `piece` tells the function which formula holds there.
struct Panel {
  int piece;
  double a, b;
};

class KronrodPanel {
 public:
  /// f(piece, x) for a < x < b.
  template <typename Function>
  KronrodPanel(const Panel& panel, const Function& f) : panel_(panel) {
    const double middle = 0.5 * (panel.a + panel.b), half = 0.5 * (panel.b - panel.a);
    double gauss = 0, magnitude = 0;
    for (std::size_t i = 0; i < kAt.size(); ++i) {
      const double left = f(panel.piece, middle - half * kAt[i]);
      const double right = i == 0 ? 0 : f(panel.piece, middle + half * kAt[i]);
      value_ += half * kKronrod[i] * (left + right);
      magnitude += half * kKronrod[i] * (std::abs(left) + std::abs(right));
      gauss += half * kGauss[i] * (left + right);
    }
    const double difference = std::abs(value_ - gauss);
    error_ = difference > kRounding * magnitude ? difference : 0;
  }

  const Panel& panel() const { return panel_; }
  double value() const { return value_; }
  double error() const { return error_; }
  bool operator<(const KronrodPanel& other) const { return error_ < other.error_; }

 private:
  static constexpr double kRounding = 1e-14;  ///< of the integral of |f|: below this no halving helps
  /// The middle point, then those right of it; Gauss has every second one.
  static constexpr std::array kAt = {0.0,
                                     0.207784955007898467600689403773245,
                                     0.405845151377397166906606412076961,
                                     0.586087235467691130294144691693013,
                                     0.741531185599394439863864773280788,
                                     0.864864423359769072789712788640926,
                                     0.949107912342758524526189684047851,
                                     0.991455371120812639206854697526329};
  static constexpr std::array kKronrod = {0.209482141084727828012999174891714, 0.204432940075298892414161999234649,
                                          0.190350578064785409913256402421014, 0.169004726639267902826583426598550,
                                          0.140653259715525918745189590510238, 0.104790010322250183839876322541518,
                                          0.063092092629978553290700663189204, 0.022935322010529224963732008058970};
  static constexpr std::array kGauss = {
      0.417959183673469387755102040816327, 0.0, 0.381830050505118944950369775488975, 0.0,
      0.279705391489276667901467771423780, 0.0, 0.129484966168869693270611432679082, 0.0};

  Panel panel_;
  double value_ = 0, error_ = 0;
};

/// `tolerance` is a part of the whole integral. REQUIRES: f is finite inside the panels and piecewise smooth.
template <typename Function>
double adaptive_integral(const std::vector<Panel>& panels, const Function& f, double tolerance) {
  std::priority_queue<KronrodPanel> open;
  double sum = 0, error = 0;
  for (const Panel& panel : panels) {
    const KronrodPanel first(panel, f);
    sum += first.value(), error += first.error();
    open.push(first);
  }
  while (error > tolerance * std::abs(sum) && open.top().error() > 0) {
    const KronrodPanel worst = open.top();
    open.pop();
    const auto [piece, a, b] = worst.panel();
    const double middle = 0.5 * (a + b);
    const KronrodPanel left({piece, a, middle}, f), right({piece, middle, b}, f);
    sum += left.value() + right.value() - worst.value();
    error += left.error() + right.error() - worst.error();
    open.push(left), open.push(right);
  }
  return sum;
}

}  // namespace portrait
