/// What a tuning rule is: from a plant and a few choices to a controller, with its name, equations and preconditions.
///
/// A rule works in the units of the plant it is given. It throws InputError that names the precondition which fails, never a
/// controller outside its domain.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/loop/forms.h"
#include "engine/loop/loop.h"
#include "engine/rules/areas.h"
#include "engine/rules/model_based.h"

namespace portrait::rules {

/// K Z(s)/(s^k P_1(s) P_2(s) ...) e^{-Td s}: constant terms of Z and P are 1, K may be of either sign.
struct RulePlant {
  int integrators = 0;
  double K = 1;
  Polynomial zeros{1};
  std::vector<Polynomial> poles;
  double Td = 0;
  std::string name;               ///< as the user called it, for messages
  std::optional<Areas> measured;  ///< areas of a recorded response, in place of those of the formula
};

RulePlant dipdt(double K, double Td);
RulePlant ipdt(double K, double Td);
RulePlant jotd(double K, double Td, double Tj, int j);  ///< fotd for j = 1

/// Areas of s^k G(s), measured or computed.
Areas areas_of(const RulePlant& plant, std::size_t count);
/// Lags T_i when all poles are real and left of 0, and there are no zeros; longest first.
std::optional<std::vector<double>> real_lags(const RulePlant& plant);

struct OptionInfo {
  std::string_view name;  ///< "m": the option is --m
  std::string_view meaning;
  std::string_view usually;  ///< the value without it; empty: left out, or found by the rule
};

/// The user's choices for one rule.
class Choices {
 public:
  Choices(std::string_view rule, std::vector<OptionInfo> known, std::map<std::string, std::string> given);

  bool has(std::string_view name) const;
  /// Given, or as usual; an InputError when there is neither.
  double number(std::string_view name) const;
  double positive(std::string_view name) const;
  double within(std::string_view name, double least, double most) const;
  int whole(std::string_view name, int least, int most) const;
  std::string word(std::string_view name, const std::vector<std::string_view>& words) const;

 private:
  std::optional<std::string> text(std::string_view name) const;

  std::string rule_;
  std::vector<OptionInfo> known_;
  std::map<std::string, std::string> given_;
};

/// A number the rule found on its way, worth showing: the dominant pole, the areas, ...
struct Finding {
  std::string name;
  double value;
};

/// What a rule gives, in the plant's units.
struct Tuned {
  /// C(s) = numerator/denominator acting on r - y, without the n-fold filter; a PID also as `pid`.
  Quotient controller;
  std::optional<StandardForm> pid;
  int n = 0;  ///< order of the filter 1/(Tf s + 1)^n; a PID with n = 0 takes the derivative of the measured output
  double Tf = 0;
  Prefilter prefilter = Prefilter::none;    ///< of a PID, with b and c
  double b = 0, c = 0;                      ///< full: time, time^2; pi: b a pure number
  std::optional<Quotient> other_prefilter;  ///< in place of the three
  std::vector<Finding> findings;
};

/// A PID, n and prefilter still to be chosen.
Tuned tuned(const StandardForm& pid);
/// The general controller of gains K_-1, K_0, ...
Tuned tuned(const std::vector<double>& gains, int n, double Tf);

struct Rule {
  std::string_view name;        ///< "huba2022-qrdp"
  std::string_view controller;  ///< "PID"
  std::string_view plants;      ///< in words: "dipdt"
  std::string_view line;        ///< what it aims at
  std::string_view source;      ///< "Huba2022 (21)-(27)"
  std::vector<OptionInfo> options;
  Tuned (*tune)(const RulePlant& plant, const Choices& choices);
};

/// Throws InputError: "huba2022-qrdp needs a dipdt plant, K e^(-Td s)/s^2: this one has 1 integrator".
[[noreturn]] void fail_precondition(std::string_view rule, const std::string& what);

}  // namespace portrait::rules
