#include "engine/model/cell_explanation.h"

#include <cmath>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/rounding.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/model/hazard_maps.h"
#include "engine/model/size_words.h"

namespace palace {
namespace {

/// How a term is shown: its values times `factor`, in `unit`.
struct Look {
  const char* name;
  double factor;
  const char* unit;
  int decimals;
};

/// Probability and distance have a least value, the others a largest.
bool IsLeast(CellTerm term) {
  return term == CellTerm::kProbability || term == CellTerm::kHazardDistance;
}

Look LookOf(CellTerm term) {
  switch (term) {
    case CellTerm::kSlope:
      return {"Slope", kDegPerRad, "°", 1};
    case CellTerm::kRoughness:
      return {"Roughness", 100, " cm", 1};
    case CellTerm::kStep:
      return {"Step", 100, " cm", 1};
    case CellTerm::kProbability:
      return {"Safe as seen", 1, "", 3};
    case CellTerm::kHazardDistance:
      return {"Clear radius", 1, " m", 1};
  }
  PALACE_CHECK(false);
}

std::string Number(double value, int decimals, const char* unit) {
  if (!std::isfinite(value)) {
    return "––";
  }
  return WithNumbers(("%." + std::to_string(decimals) + "f").c_str(), value) + unit;
}

bool IsSize(CellTerm term) {
  return term == CellTerm::kSlope || term == CellTerm::kRoughness || term == CellTerm::kStep;
}

struct Bit {
  unsigned bit;
  const char* word;
};

template <std::size_t N>
std::string WordsOfBits(const Bit (&bits)[N], unsigned set) {
  std::string text;
  for (const Bit& bit : bits) {
    if ((set & bit.bit) != 0) {
      text += (text.empty() ? "" : ", ") + std::string(bit.word);
    }
  }
  return text;
}

}  // namespace

double RequiredSafeProbability(const SladSettings& settings, double sigma_m, double hidden_things) {
  const double noise = sigma_m / kProvisionalSigma_m;
  const double whole = settings.limits.min_safe_probability;
  // Below nothing, so that a limit of 0 stays one; unknown noise asks for the whole.
  return (noise >= 0 ? std::max(0.0, std::min(whole, 1 - noise * noise)) : whole) *
         ForgivenHidden(hidden_things);
}

double ForgivenHidden(double hidden_things) {
  return std::isnan(hidden_things) ? 1 : std::max(std::exp(-hidden_things), kOffered);
}

std::vector<ExplainedTerm> TermsOf(const LandingSite& site, const SladSettings& settings) {
  std::vector<ExplainedTerm> terms;
  const auto add = [&](CellTerm term, Figure figure, double limit) {
    // In the maps' own precision; an unknown value is over its limit.
    const auto value = static_cast<float>(figure.value), edge = static_cast<float>(limit);
    const bool inside = IsLeast(term) ? value >= edge : value <= edge;
    terms.push_back({term, figure, limit, !inside, false});
  };
  const bool modern = settings.mode == SladMode::kModern;
  add(CellTerm::kSlope, site.slope_rad, Rad(settings.limits.max_slope_deg));
  add(CellTerm::kRoughness, site.roughness_m, settings.limits.max_deviation_m);
  if (modern) {
    add(CellTerm::kStep, site.step_m, settings.limits.max_step_m);
    // The product was rounded to a map's precision: its quotient may be over 1 by that.
    const double as_seen = site.safe_probability / ForgivenHidden(site.hidden_things);
    add(CellTerm::kProbability, {std::min(as_seen, 1.0), 0},
        RequiredSafeProbability(settings, site.roughness_m.three_sigma / 3, 0));
  }
  add(CellTerm::kHazardDistance, {site.safe_distance_m, 0}, settings.lander.clear_radius_m());
  return terms;
}

bool BandCrossesLimit(const ExplainedTerm& term) {
  const double towards = IsLeast(term.term) ? -term.figure.three_sigma : term.figure.three_sigma;
  const double edge = term.figure.value + towards;
  return !term.over && (IsLeast(term.term) ? edge < term.limit : edge > term.limit);
}

TermWords WordsOf(const ExplainedTerm& term) {
  const Look look = LookOf(term.term);
  const auto shown = [&](double value) {
    return Number(value * look.factor, look.decimals, look.unit);
  };
  const double limit = term.limit * look.factor, value = term.figure.value * look.factor;
  TermWords words{look.name,
                  Number(term.over ? ShownBeyond(value, limit, look.decimals) : value,
                         look.decimals, look.unit),
                  "", ""};
  if (IsSize(term.term) && !std::isnan(KnownBelow(term.figure))) {
    words.value = "under " + shown(KnownBelow(term.figure));
  } else if (std::isfinite(term.figure.value) && term.figure.three_sigma > 0) {
    words.spread = "± " + shown(term.figure.three_sigma);
  }
  const int decimals = std::abs(limit - std::round(limit)) < 1e-6 ? 0 : look.decimals;
  words.limit = (IsLeast(term.term) ? "min " : "max ") + Number(limit, decimals, look.unit);
  return words;
}

const char* CellStateWord(CellState state) {
  switch (state) {
    case CellState::kUnknown:
      return "unknown";
    case CellState::kMeasured:
      return "measured";
    case CellState::kFilled:
      return "filled";
    case CellState::kBorder:
      return "border";
  }
  PALACE_CHECK(false);
}

std::string FlagWords(unsigned flags) {
  return WordsOfBits({{kFlagThinStructure, "thin structure"},
                      {kFlagNoTexture, "no texture"},
                      {kFlagShadow, "deep shadow"},
                      {kFlagMotion, "motion"},
                      {kFlagElevated, "elevated surface"},
                      {kFlagUnexplained, "unexplained mark"}},
                     flags);
}

std::string ReasonWords(unsigned reasons) {
  return WordsOfBits({{kHazardSlope, "slope"},
                      {kHazardRoughness, "roughness"},
                      {kHazardStep, "step"},
                      {kHazardUnknown, "unknown"},
                      {kHazardFlagged, "flagged"},
                      {kHazardProbability, "low safe probability"}},
                     reasons);
}

bool NearestHazard::IsSeen() const {
  return cell.has_value() && (reasons & ~unsigned{kHazardUnknown}) != 0;
}

std::string WhereWords(const NearestHazard& nearest) {
  const std::string all = !nearest.cell                         ? std::string("map edge")
                          : (nearest.reasons == kHazardFlagged) ? FlagWords(nearest.flags)
                                                                : ReasonWords(nearest.reasons);
  const std::string first =
      all.substr(0, all.find(','));  // the worst alone, to be read at a glance
  return first + ", " + Number(nearest.distance_m, 1, " m ") + DirectionWord(nearest.bearing_rad);
}

const char* DirectionWord(double bearing_rad) {
  constexpr const char* kWords[] = {"north", "north-east", "east", "south-east",
                                    "south", "south-west", "west", "north-west"};
  const long sector = std::lround(bearing_rad / (std::numbers::pi / 4));
  return kWords[((sector % 8) + 8) % 8];
}

}  // namespace palace
