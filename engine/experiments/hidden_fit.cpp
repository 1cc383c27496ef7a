#include "engine/experiments/hidden_fit.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "engine/core/check.h"

namespace palace {
namespace {

constexpr int kTried = 61;
constexpr double kLeast = 1e-12;  // of a logarithm

double Logarithm(double value) { return std::log(std::max(value, kLeast)); }

}  // namespace

double HiddenAt(const JudgedSite& site, double things_per_m2) {
  PALACE_CHECK(site.hidden.size() == std::size(kHiddenDensities), site.hidden.size());
  const auto above = std::upper_bound(std::begin(kHiddenDensities) + 1,
                                      std::end(kHiddenDensities) - 1, things_per_m2);
  const auto i = static_cast<std::size_t>(above - std::begin(kHiddenDensities));
  const double low = std::log(kHiddenDensities[i - 1]), high = std::log(kHiddenDensities[i]);
  const double share = std::clamp((Logarithm(things_per_m2) - low) / (high - low), 0.0, 1.0);
  return std::exp((1 - share) * Logarithm(site.hidden[i - 1]) + share * Logarithm(site.hidden[i]));
}

double LogLikelihood(std::span<const JudgedSite> sites, double things_per_m2) {
  double sum = sites.empty() ? std::numeric_limits<double>::quiet_NaN() : 0;
  for (const JudgedSite& site : sites) {
    const double hidden = HiddenAt(site, things_per_m2);
    sum += site.unsafe ? Logarithm(-std::expm1(-hidden)) : -hidden;
  }
  return sum;
}

double FitDensity(std::span<const JudgedSite> sites) {
  double best = std::numeric_limits<double>::quiet_NaN(), most = 0;
  for (int i = 0; i < kTried; ++i) {
    const double density = std::pow(10.0, -3 + 3.0 * i / (kTried - 1));
    const double likelihood = LogLikelihood(sites, density);
    if (std::isnan(best) ? !std::isnan(likelihood) : likelihood > most) {
      best = density;
      most = likelihood;
    }
  }
  return best;
}

std::vector<LeftOut> LeaveOneOut(std::span<const JudgedSite> sites) {
  std::vector<LeftOut> all;
  for (const JudgedSite& site : sites) {
    const bool known = std::any_of(all.begin(), all.end(),
                                   [&](const LeftOut& one) { return one.family == site.family; });
    if (!known) {
      all.push_back({.family = site.family});
    }
  }
  for (LeftOut& one : all) {
    std::vector<JudgedSite> others;
    std::copy_if(sites.begin(), sites.end(), std::back_inserter(others),
                 [&](const JudgedSite& site) { return site.family != one.family; });
    one.things_per_m2 = FitDensity(others);
    for (const JudgedSite& site : sites) {
      if (site.family == one.family) {
        ++one.sites;
        one.unsafe += site.unsafe ? 1 : 0;
        one.said_unsafe += -std::expm1(-HiddenAt(site, one.things_per_m2));
      }
    }
    one.said_unsafe /= one.sites;
  }
  return all.size() < 2 ? std::vector<LeftOut>() : all;
}

}  // namespace palace
