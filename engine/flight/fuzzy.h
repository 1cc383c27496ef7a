// A small Mamdani inference: rules in words over numbers, to one number in [0, 1].
//
//   membership      trapezoid: 0 up to a, rising to 1 at b, 1 to c, falling to 0 at d
//   weight of rule  w_r = min of its clauses ("is not": 1 - membership)
//   result          f(y) = max over the rules of w_r times the membership of y in its output term
//   answer          integral of y f(y) / integral of f(y), over 0 <= y <= 1
//
// The centroid is exact: f is linear between the corners of the terms and where their sides cross.
// Source: Mamdani and Assilian 1975, An experiment in linguistic synthesis with a fuzzy logic
// controller. We deviate: a rule's weight scales its output term (Larsen 1980) where they cut it
// off, and the answer is the centroid where they take the place of the maximum. Scaled terms keep
// their own centroid, so that the answer of one rule does not move with its weight.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace palace {

/// a <= b <= c <= d. b = c is a triangle, a = b or c = d an upright side.
struct FuzzyTerm {
  double a, b, c, d;
};

/// 1 up to `full`, 0 from `none` on; and the other way round.
constexpr FuzzyTerm FuzzyBelow(double full, double none) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {-kInfinity, -kInfinity, full, none};
}
constexpr FuzzyTerm FuzzyAbove(double none, double full) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {none, full, kInfinity, kInfinity};
}

/// In [0, 1]; NaN for NaN.
double Membership(const FuzzyTerm& term, double x);

/// "Input `input` is (not) `term`". What the numbers of the input mean, its caller says.
struct FuzzyClause {
  int input;
  FuzzyTerm term;
  bool is_not = false;
};

/// If all clauses hold, the answer is `then`. A rule without clauses holds fully.
struct FuzzyRule {
  std::vector<FuzzyClause> all_of;
  FuzzyTerm then;
};

/// Nothing where no rule fires, where what fires has no area within [0, 1], or where an input is
/// NaN: no middle value is made up. Clauses must name inputs that are given.
std::optional<double> Infer(std::span<const FuzzyRule> rules, std::span<const double> inputs);

}  // namespace palace
