// Figures of a site as people and files read them.
#include "engine/model/cell_explanation.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palace {
namespace {

double SafeAsSeen(double safe_probability, double hidden_things) {
  LandingSite site;
  site.safe_probability = safe_probability;
  site.hidden_things = hidden_things;
  const auto terms = TermsOf(site, SladSettings{});
  const auto term = std::find_if(terms.begin(), terms.end(), [](const ExplainedTerm& each) {
    return each.term == CellTerm::kProbability;
  });
  return term != terms.end() ? term->figure.value : -1;
}

/// Maps keep floats: exp(-0.05) rounded to one is more than itself.
TEST(TermsOfASite, NoProbabilityIsOverOne) {
  bool rounded_up = false;
  for (const double hidden : {0.01, 0.05, 0.1, 0.15, 0.2}) {
    const double kept = static_cast<double>(static_cast<float>(std::exp(-hidden)));
    rounded_up = rounded_up || kept > std::exp(-hidden);
    EXPECT_LE(SafeAsSeen(kept, hidden), 1.0) << hidden;
    EXPECT_NEAR(SafeAsSeen(kept, hidden), 1.0, 1e-6) << hidden;
    EXPECT_NEAR(SafeAsSeen(0.5 * kept, hidden), 0.5, 1e-6) << hidden;
  }
  EXPECT_TRUE(rounded_up) << "nothing was tried";
  EXPECT_TRUE(std::isnan(SafeAsSeen(NAN, 0.05))) << "unknown stays unknown";
}

}  // namespace
}  // namespace palace
