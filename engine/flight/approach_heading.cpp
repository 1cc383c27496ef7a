#include "engine/flight/approach_heading.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/flight/fuzzy.h"

namespace palace {
namespace {

// The outer two overhang [0, 1], so that only their inner halves count.
constexpr FuzzyTerm kVeryPoor{-0.25, 0, 0, 0.25};
constexpr FuzzyTerm kPoor{0, 0.25, 0.25, 0.5};
constexpr FuzzyTerm kFair{0.25, 0.5, 0.5, 0.75};
constexpr FuzzyTerm kGood{0.5, 0.75, 0.75, 1};
constexpr FuzzyTerm kVeryGood{0.75, 1, 1, 1.25};

constexpr double kSunExponent = 1;
constexpr double kOrientationExponent = 0.7;

constexpr FuzzyTerm BelowDeg(double full, double none) { return FuzzyBelow(Rad(full), Rad(none)); }
constexpr FuzzyTerm AboveDeg(double none, double full) { return FuzzyAbove(Rad(none), Rad(full)); }
constexpr FuzzyTerm BetweenDeg(double a, double b, double c, double d) {
  return {Rad(a), Rad(b), Rad(c), Rad(d)};
}

/// Inputs: flare, shadow, glint and the sun's elevation.
const std::vector<FuzzyRule>& SunRules() {
  constexpr FuzzyTerm kNear = BelowDeg(30, 55), kInView = BelowDeg(12, 28);
  constexpr bool kNot = true;
  constexpr FuzzyClause kNight{3, BelowDeg(-6, 2)}, kDay{3, BelowDeg(-6, 2), kNot};
  constexpr FuzzyClause kSunNear{0, kNear}, kSunNotNear{0, kNear, kNot};
  constexpr FuzzyClause kSunMid{0, BetweenDeg(30, 55, 75, 100)}, kSunFar{0, AboveDeg(75, 100)};
  constexpr FuzzyClause kShadow{1, kInView}, kNoShadow{1, kInView, kNot};
  constexpr FuzzyClause kGlint{2, kInView}, kNoGlint{2, kInView, kNot};
  static const std::vector<FuzzyRule> rules = {
      {{kNight}, kVeryGood},
      {{kDay, kSunNear}, kVeryPoor},
      {{kDay, kSunMid, kNoShadow, kNoGlint}, kGood},
      {{kDay, kSunFar, kNoShadow, kNoGlint}, kVeryGood},
      {{kGlint, kSunNotNear}, kPoor},
      {{kShadow, kSunNotNear}, kFair},
  };
  return rules;
}

/// Inputs: the angle between course and wind, and the wind's speed in m/s.
const std::vector<FuzzyRule>& WindRules() {
  constexpr FuzzyClause kHead{0, BelowDeg(20, 50)};
  constexpr FuzzyClause kCross{0, BetweenDeg(20, 50, 100, 130)};
  constexpr FuzzyClause kTail{0, AboveDeg(100, 130)};
  constexpr FuzzyClause kCalm{1, FuzzyBelow(1.5, 3.5)};
  constexpr FuzzyClause kModerate{1, {1.5, 3.5, 6, 9}};
  constexpr FuzzyClause kStrong{1, FuzzyAbove(6, 9)};
  static const std::vector<FuzzyRule> rules = {
      {{kCalm}, kVeryGood},          {{kModerate, kHead}, kVeryGood}, {{kModerate, kCross}, kFair},
      {{kModerate, kTail}, kPoor},   {{kStrong, kHead}, kVeryGood},   {{kStrong, kCross}, kPoor},
      {{kStrong, kTail}, kVeryPoor},
  };
  return rules;
}

/// Input: the angle between course and wanted heading.
const std::vector<FuzzyRule>& OrientationRules() {
  static const std::vector<FuzzyRule> rules = {
      {{{0, BelowDeg(10, 40)}}, kVeryGood},
      {{{0, BetweenDeg(10, 40, 80, 110)}}, kFair},
      {{{0, AboveDeg(80, 110)}}, kPoor},
  };
  return rules;
}

/// The rules leave no gap (a test sweeps them). If they did, a course in it would be the worst.
double ScoreOf(const std::vector<FuzzyRule>& rules, std::initializer_list<double> inputs) {
  return Infer(rules, {inputs.begin(), inputs.size()}).value_or(0);
}

double WindExponent(double wind_mps) { return wind_mps < 3 ? 0.5 : wind_mps <= 8 ? 1.5 : 3; }

double TurnBetween(double a_rad, double b_rad) { return std::abs(WrapAngle(a_rad - b_rad)); }

/// Unit vector: north, east, up.
Eigen::Vector3d Direction(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double SunScore(const HeadingConditions& now, double heading_rad) {
  const Eigen::Vector3d boresight = Direction(heading_rad, -now.depression_rad);
  const Eigen::Vector3d sun = Direction(now.sun_azimuth_rad, now.sun_elevation_rad);
  const Eigen::Vector3d mirrored = Direction(now.sun_azimuth_rad, -now.sun_elevation_rad);
  return ScoreOf(SunRules(), {AngleBetween(boresight, sun), AngleBetween(boresight, -sun),
                              AngleBetween(boresight, mirrored), now.sun_elevation_rad});
}

HeadingScore ScoreHeading(const HeadingConditions& now, int k) {
  const bool wind_known =
      std::isfinite(now.wind_from_rad) && std::isfinite(now.wind_mps) && now.wind_mps >= 0;
  const bool sun_known = std::isfinite(now.sun_azimuth_rad) &&
                         std::isfinite(now.sun_elevation_rad) && std::isfinite(now.depression_rad);
  HeadingScore score;
  score.heading_rad = ApproachHeading(k);
  score.is_blocked = now.blocked.test(static_cast<std::size_t>(k));
  double exponents = 0;
  double product = 1;
  const auto take = [&](double factor, double exponent) {
    product *= std::pow(factor, exponent);
    exponents += exponent;
    return factor;
  };
  if (wind_known) {
    const double off_rad = TurnBetween(score.heading_rad, now.wind_from_rad);
    score.tailwind_mps = -now.wind_mps * std::cos(off_rad);
    score.is_downwind = !(score.tailwind_mps <= now.max_tailwind_mps);
    score.wind = take(ScoreOf(WindRules(), {off_rad, now.wind_mps}), WindExponent(now.wind_mps));
  }
  if (sun_known) {
    score.sun = take(SunScore(now, score.heading_rad), kSunExponent);
  }
  if (std::isfinite(now.wanted_rad)) {
    score.orientation =
        take(ScoreOf(OrientationRules(), {TurnBetween(score.heading_rad, now.wanted_rad)}),
             kOrientationExponent);
  }
  score.combined = exponents > 0 ? std::pow(product, 1 / exponents) : 1;
  return score;
}

}  // namespace

HeadingCurve ScoreHeadings(const HeadingConditions& conditions) {
  HeadingCurve curve;
  const auto worth = [&](const HeadingScore& score) {
    return std::isfinite(conditions.present_rad)
               ? score.combined * (1 - kTurnPenalty / std::numbers::pi *
                                           TurnBetween(score.heading_rad, conditions.present_rad))
               : score.combined;
  };
  double most = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < kApproachHeadings; ++k) {
    HeadingScore& score = curve.headings[static_cast<std::size_t>(k)];
    score = ScoreHeading(conditions, k);
    most = score.IsVetoed() ? most : std::max(most, worth(score));
  }
  // The scores are plateaus: what is equal must not be told apart by its rounding.
  double least_turn_rad = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kApproachHeadings; ++k) {
    const HeadingScore& score = curve.headings[static_cast<std::size_t>(k)];
    const double turn_rad = std::isfinite(conditions.wanted_rad)
                                ? TurnBetween(score.heading_rad, conditions.wanted_rad)
                                : 0;
    if (!score.IsVetoed() && worth(score) >= most - kEqualScores &&
        turn_rad < least_turn_rad - kEqualScores) {
      least_turn_rad = turn_rad;
      curve.best = k;
    }
  }
  return curve;
}

}  // namespace palace
