/// Random expressions as trees: printed with no parenthesis that the grammar can spare, and evaluated plainly.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <rapidcheck.h>

#include "engine/base/words.h"
#include "engine/loop/loop.h"
#include "portraits/query/columns.h"

namespace portrait {

struct Tree {
  std::string symbol;  ///< operator or function; "" for a number, "name" for a quantity
  double number = 0;
  Quantity quantity = Measure::IAE_w;
  std::vector<Tree> children;
};

/// How tightly a piece of text holds together: sums, products, signs, powers, operands.
enum Tightness { sum = 1, product, sign, power, operand };

inline std::string print(const Tree& tree, Tightness at_least = sum);

inline std::string print_call(const Tree& tree) {
  std::string text = tree.symbol + "(";
  for (std::size_t i = 0; i < tree.children.size(); ++i) text += (i == 0 ? "" : ", ") + print(tree.children[i]);
  return text + ")";
}

inline std::string print(const Tree& tree, Tightness at_least) {
  const std::string& s = tree.symbol;
  if (s.empty()) return number_text(tree.number);
  if (s == "name") return std::string(to_string(tree.quantity));
  if (s.size() > 1) return print_call(tree);
  const auto wrapped = [&](Tightness own, const std::string& text) {
    return own >= at_least ? text : "(" + text + ")";
  };
  const std::vector<Tree>& c = tree.children;
  if (c.size() == 1) return wrapped(sign, "-" + print(c[0], sign));
  if (s == "+" || s == "-") return wrapped(sum, print(c[0], sum) + " " + s + " " + print(c[1], product));
  if (s == "*" || s == "/") return wrapped(product, print(c[0], product) + s + print(c[1], sign));
  return wrapped(power, print(c[0], operand) + s + print(c[1], sign));
}

using Lookup = std::function<double(Quantity)>;

inline double folded(const std::string& function, const std::vector<double>& values) {
  double best = values[0];
  for (const double value : values) {
    if (std::isnan(value)) return kNaN;
    if (function == "min" ? value < best : value > best) best = value;
  }
  return best;
}

inline double value_of(const Tree& tree, const Lookup& lookup) {
  const std::string& s = tree.symbol;
  if (s.empty()) return tree.number;
  if (s == "name") return lookup(tree.quantity);
  std::vector<double> v;
  for (const Tree& child : tree.children) v.push_back(value_of(child, lookup));
  if (s == "min" || s == "max") return folded(s, v);
  if (s == "abs") return std::abs(v[0]);
  if (s == "sqrt") return std::sqrt(v[0]);
  if (s == "log") return std::log(v[0]);
  if (s == "exp") return std::exp(v[0]);
  if (v.size() == 1) return -v[0];
  if (s == "+") return v[0] + v[1];
  if (s == "-") return v[0] - v[1];
  if (s == "*") return v[0] * v[1];
  if (s == "/") return v[0] / v[1];
  return std::isnan(v[0]) || std::isnan(v[1]) ? kNaN : std::pow(v[0], v[1]);
}

inline Tree random_leaf(const std::vector<Quantity>& quantities) {
  Tree leaf;
  if (*rc::gen::arbitrary<bool>()) {
    leaf.symbol = "name";
    leaf.quantity = *rc::gen::elementOf(quantities);
  } else {
    leaf.number = *rc::gen::element(0.0, 0.1, 0.5, 1.0, 2.0, 3.0, 1e-300, 1e300, kInf);
  }
  return leaf;
}

/// At most `levels` operators deep. Only within a property: it draws from RapidCheck.
inline Tree random_tree(int levels, const std::vector<Quantity>& quantities) {
  if (levels == 0 || *rc::gen::inRange(0, 4) == 0) return random_leaf(quantities);
  Tree tree;
  tree.symbol =
      *rc::gen::element<std::string>("+", "-", "*", "/", "^", "negate", "abs", "sqrt", "log", "exp", "min", "max");
  const bool many = tree.symbol == "min" || tree.symbol == "max";
  const bool two = tree.symbol.size() == 1;
  const int count = many ? *rc::gen::inRange(2, 5) : two ? 2 : 1;
  if (tree.symbol == "negate") tree.symbol = "-";
  for (int i = 0; i < count; ++i) tree.children.push_back(random_tree(levels - 1, quantities));
  return tree;
}

/// The same bits, or NaN both.
inline bool identical(double a, double b) {
  return a == b ? std::signbit(a) == std::signbit(b) : std::isnan(a) && std::isnan(b);
}

}  // namespace portrait
