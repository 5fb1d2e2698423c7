/// Collocation on one panel of time: the polynomial of degree s that meets x' = A x + B q + E v in s points.
///
///     X(0) = x0,    X'(c_i h) = A X(c_i h) + B q(c_i h) + E v,    i = 1 .. s
///
/// with the Radau points c_1 < ... < c_s = 1, which damp what is much faster than the panel (L-stable), so a
/// tiny filter constant does no harm.                                                      [HairerWanner, IV.5]
/// order     2 s - 1 in the end point, s in between, for smooth q
/// shape     values on a panel belong to s + 1 nodes: c_0 = 0 and c_1 .. c_s
#pragma once

#include <Eigen/Core>

#include "engine/reference/open_chain.h"

namespace portrait::reference {

/// The nodes of a panel on [0, 1] and what belongs to them alone.
struct Nodes {
  Eigen::VectorXd at;           ///< c_0 .. c_s
  Eigen::MatrixXd integration;  ///< s x s: integral from 0 to c_i of the j-th Lagrange polynomial over c_1 .. c_s
  Eigen::MatrixXd to_series;    ///< (s+1) x (s+1): `PanelValues` to Chebyshev coefficients on the panel
  Eigen::Index stages() const { return integration.rows(); }
};

/// REQUIRES: 1 <= stages <= 20.
Nodes radau_nodes(int stages);

/// A signal on a panel: row 0 its value at the start, row i what it has gained at c_i; a column a step of those that are
/// simulated. Gains keep the digits: a filter with a tiny tau_f takes the slope of y on a tiny panel, and slopes of
/// values rounded at the size of y cost TV 1e-7 and more.
using PanelValues = Eigen::MatrixXd;
/// States: a row a state, a column a step.
using States = Eigen::MatrixXd;

/// What one panel of a given length does with the open chain: linear maps, made once and applied in every interval.
class Panel {
 public:
  /// E and F of `chain` have a column for each step that is simulated.
  Panel(const OpenChain& chain, const Nodes& nodes, double length);

  double length() const { return length_; }

  /// Goes over the panel with all steps side by side. `y`, `y_slope` are given at the s + 1 nodes; `x` is
  /// replaced by the states at the panel's end; z, z' and u are written to `outputs[kZ], outputs[kSlope],
  /// outputs[kU]`.
  void advance(const PanelValues& y, const PanelValues& y_slope, States& x, PanelValues outputs[kOutputs]) const;

 private:
  const OpenChain& chain_;
  double length_;
  Eigen::Index stages_;
  Eigen::MatrixXd from_slope_, from_y_, from_y_slope_;  ///< to the gains of X at c_1, ..., c_s, one below the other
};

}  // namespace portrait::reference
