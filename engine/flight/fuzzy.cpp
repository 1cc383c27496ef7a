#include "engine/flight/fuzzy.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"

namespace palace {
namespace {

/// An output term, scaled by the weight of its rule.
struct Fired {
  double weight;
  FuzzyTerm term;

  double At(double y) const { return weight * Membership(term, y); }
};

double Weight(const FuzzyRule& rule, std::span<const double> inputs) {
  double weight = 1;
  for (const FuzzyClause& clause : rule.all_of) {
    PALACE_CHECK(clause.input >= 0 && clause.input < std::ssize(inputs), clause.input);
    const double holds = Membership(clause.term, inputs[static_cast<std::size_t>(clause.input)]);
    weight = std::min(weight, clause.is_not ? 1 - holds : holds);
  }
  return weight;
}

void SortAndKeepOnce(std::vector<double>& places) {
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
}

/// Between two of these every scaled term is linear and none overtakes another.
std::vector<double> LinearPieces(const std::vector<Fired>& fired) {
  std::vector<double> corners = {0, 1};
  for (const Fired& one : fired) {
    for (const double y : {one.term.a, one.term.b, one.term.c, one.term.d}) {
      if (y > 0 && y < 1) {
        corners.push_back(y);
      }
    }
  }
  SortAndKeepOnce(corners);
  std::vector<double> places = corners;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    // Asked inside of the piece: at its ends upright sides have two values.
    const double quarter = (corners[k + 1] - corners[k]) / 4;
    const double y1 = corners[k] + quarter;
    const double y3 = corners[k + 1] - quarter;
    for (std::size_t i = 0; i < fired.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double lead1 = fired[i].At(y1) - fired[j].At(y1);
        const double lead3 = fired[i].At(y3) - fired[j].At(y3);
        if (lead1 == lead3) {
          continue;  // side by side
        }
        const double crossing = y1 + (y3 - y1) * lead1 / (lead1 - lead3);
        if (crossing > corners[k] && crossing < corners[k + 1]) {
          places.push_back(crossing);
        }
      }
    }
  }
  SortAndKeepOnce(places);
  return places;
}

}  // namespace

double Membership(const FuzzyTerm& term, double x) {
  if (std::isnan(x)) {
    return x;
  }
  if (x < term.a || x > term.d) {
    return 0;
  }
  return x < term.b   ? (x - term.a) / (term.b - term.a)
         : x > term.c ? (term.d - x) / (term.d - term.c)
                      : 1;
}

std::optional<double> Infer(std::span<const FuzzyRule> rules, std::span<const double> inputs) {
  if (std::any_of(inputs.begin(), inputs.end(), [](double x) { return std::isnan(x); })) {
    return std::nullopt;
  }
  std::vector<Fired> fired;
  for (const FuzzyRule& rule : rules) {
    const double weight = Weight(rule, inputs);
    if (weight > 0) {
      fired.push_back({weight, rule.then});
    }
  }
  const auto highest = [&](double y) {
    double f = 0;
    for (const Fired& one : fired) {
      f = std::max(f, one.At(y));
    }
    return f;
  };
  const std::vector<double> places = LinearPieces(fired);
  double area = 0, moment = 0;
  for (std::size_t k = 0; k + 1 < places.size(); ++k) {
    const double width = places[k + 1] - places[k];
    const double middle = places[k] + width / 2;
    const double rise = 2 * (highest(middle + width / 4) - highest(middle - width / 4));
    const double part = width * highest(middle);
    // f = f(middle) + (y - middle) rise / width over the piece.
    area += part;
    moment += part * middle + rise * width * width / 12;
  }
  return area > 0 ? std::optional(moment / area) : std::nullopt;
}

}  // namespace palace
