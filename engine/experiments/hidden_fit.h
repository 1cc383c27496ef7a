// Leave one family out: how many rocks and holes lie hidden a square metre, fitted on the sites of
// all families but one and reported on that one.
//
// SLAD says that nothing over a limit hides under a site with the chance exp(-H(n)), n things a
// square metre (hidden_things.h). Of sites held against their truth the likelihood of n is
//
//   log l(n) = - sum over the safe of H(n) + sum over the unsafe of log(1 - exp(-H(n)))
//
// Fitted is the n where it is largest. Nothing else is fitted, and no family judges its own.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace palace {

/// Densities for which a site says what it hides, 1/m^2; between them H runs straight in
/// logarithms.
inline constexpr double kHiddenDensities[] = {0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1};

struct JudgedSite {
  std::string family;
  std::vector<double> hidden;  ///< H for each of kHiddenDensities
  bool unsafe = false;
};

/// H of one site at a density, held at the ends.
double HiddenAt(const JudgedSite& site, double things_per_m2);

/// NaN without a site.
double LogLikelihood(std::span<const JudgedSite> sites, double things_per_m2);
/// Where it is largest, of 61 densities from 0.001 to 1 evenly spaced in logarithms.
double FitDensity(std::span<const JudgedSite> sites);

struct LeftOut {
  std::string family;
  int sites = 0;
  double things_per_m2 = 0;  ///< fitted on the others
  double said_unsafe = 0;    ///< of these sites, by that density, mean
  int unsafe = 0;
};
/// One a family, in the order of first appearance; families alone are none.
std::vector<LeftOut> LeaveOneOut(std::span<const JudgedSite> sites);

}  // namespace palace
