#include "engine/model/cell_explanation.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/units.h"
#include "engine/model/hazard_maps.h"

namespace palace {
namespace {

/// How a term is shown: its values times `factor`, in `unit`.
struct Look {
  const char* name;
  double factor;
  const char* unit;
  int decimals;
  bool least;
};

Look LookOf(CellTerm term) {
  switch (term) {
    case CellTerm::kSlope:
      return {"Slope", kDegPerRad, "°", 1, false};
    case CellTerm::kRoughness:
      return {"Roughness", 100, " cm", 1, false};
    case CellTerm::kStep:
      return {"Step", 100, " cm", 1, false};
    case CellTerm::kProbability:
      return {"Safe probability", 1, "", 3, true};
    case CellTerm::kHazardDistance:
      return {"Clear radius", 1, " m", 1, true};
  }
  PALACE_CHECK(false);
}

std::string Number(double value, int decimals, const char* unit) {
  if (!std::isfinite(value)) {
    return "––";
  }
  char text[48];
  std::snprintf(text, sizeof text, "%.*f%s", decimals, value, unit);
  return text;
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

TermWords WordsOf(const ExplainedTerm& term) {
  const Look look = LookOf(term.term);
  const auto shown = [&](double value) {
    return Number(value * look.factor, look.decimals, look.unit);
  };
  TermWords words{look.name, shown(term.figure.value), "", ""};
  if (std::isfinite(term.figure.value) && term.figure.three_sigma > 0) {
    words.spread = "± " + shown(term.figure.three_sigma);
  }
  const double limit = term.limit * look.factor;
  const int decimals = std::abs(limit - std::round(limit)) < 1e-6 ? 0 : look.decimals;
  words.limit = (look.least ? "min " : "max ") + Number(limit, decimals, look.unit);
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
                      {kFlagElevated, "elevated surface"}},
                     flags);
}

std::string ReasonWords(unsigned reasons) {
  return WordsOfBits({{kHazardSlope, "slope"},
                      {kHazardRoughness, "roughness"},
                      {kHazardStep, "step"},
                      {kHazardUnknown, "unknown"},
                      {kHazardFlagged, "flagged"},
                      {kHazardProbability, "safe probability"}},
                     reasons);
}

const char* DirectionWord(double bearing_rad) {
  constexpr const char* kWords[] = {"north", "north-east", "east", "south-east",
                                    "south", "south-west", "west", "north-west"};
  const long sector = std::lround(bearing_rad / (std::numbers::pi / 4));
  return kWords[((sector % 8) + 8) % 8];
}

}  // namespace palace
