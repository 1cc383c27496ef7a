// Limits as people see them: what is measured, how much is allowed, and who acts beyond it.
//
// A row is made where its limit is enforced, from the very numbers of that rule; the screen draws
// it and compares nothing. A row that nobody enforces is for information: it is never over.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/model/landing_site.h"
#include "engine/model/settings/settings.h"

namespace palace {

enum class LimitId : std::uint8_t {
  // of a site, on its newest map
  kSlope,
  kRoughness,
  kStep,
  kClearRadius,
  kUnknownCells,
  kProbability,
  kHeightNoise,
  kAirSeen,
  kApproach,
  // of the approach and the descent
  kOffPath,
  kFromCentre,
  kDescentRate,
  kCoherence,
  kResidual,
  kWind,
  kOffWind,
  // of the cameras
  kRowError,
  kExposure,
  kRangeScale,
  // what a descent holds by, beside the site's own
  kLeftCameraAge,
  kRightCameraAge,
  kPairAge,
  kPoseAge,
  kInvalidPose,
  kStatusAge,
  kGroundAge,
  kImageTime,
  kTilt,
  kVisionOutage,
  kConfirmHeight,
  kBeside,
};

enum class EnforcedBy : std::uint8_t {
  kNobody,
  kGuard,    ///< approve is blocked, a selection ends
  kHold,     ///< the descent holds; so low that nobody should hover, it aborts
  kAlarm,    ///< an alarm asks the operator to act
  kVehicle,  ///< the vehicle refuses by itself
};
/// "guard"; of kNobody "for information".
const char* EnforcedByWord(EnforcedBy by);

/// Values in SI, shown as value times shown_per_unit in `unit`.
struct LimitRow {
  LimitId id = LimitId::kSlope;
  const char* label = "";
  double value = NAN;        ///< NaN unknown
  double three_sigma = NAN;  ///< NaN: no band is known
  double limit = NAN;
  bool is_least = false;  ///< the limit is a least value, not a largest
  const char* unit = "";
  double shown_per_unit = 1;
  int decimals = 1;  ///< of the shown value
  EnforcedBy enforced_by = EnforcedBy::kNobody;
  bool over = false;  ///< beyond the limit, as the rule that enforces it sees it
  /// For how long it must be over before it is acted upon: "0.4 s, or 3 of 5 maps"; empty: at once.
  std::string lasts{};
};

/// The row with `over` set: a known value on the wrong side, unless nobody enforces the limit.
LimitRow Judged(LimitRow row);
/// How much of the limit is used: 1 at the limit, above 1 beyond it. Value over limit; of a least
/// value limit over value; of a probability (1 - p) / (1 - limit). NaN where the value is unknown.
double ShareUsed(const LimitRow& row);
/// "9.2 m/s", as shown; unknown is "––".
std::string ValueWords(const LimitRow& row);
std::string LimitWords(const LimitRow& row);
/// Null when there is no such row.
const LimitRow* FindLimit(const std::vector<LimitRow>& rows, LimitId id);

/// What a site's figures are held against, as the selection and every re-check hold them: guard G8,
/// and the descent stops. Thesis mode has neither step nor probability.
std::vector<LimitRow> SiteLimits(const LandingSite& site, const SladSettings& settings);

}  // namespace palace
