// A family's world seen from a hover, and its sites held against the truth: what `evaluate ground`
// does with one field.
//
//   World, ViewPlan -> ten drawn pairs -> stereo -> Slad -> TerrainDecision -> SiteTruth
//
// A site is judged by every touchdown within the navigation error of its middle: the worst of a
// grid of them, each over the disc of the vehicle's radius (ground_truth.h). Frames: W, metres,
// heights up-positive. Ground that nobody knows counts as grossly unsafe.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/experiments/field_trial.h"
#include "engine/experiments/kept_pictures.h"
#include "engine/model/settings/settings.h"
#include "engine/world/families/view_plan.h"
#include "engine/world/ground_truth.h"

namespace palace {

/// Ten frames of the world as the plan looks at it: its lens, exposure, blur and vignetting; pose
/// errors `pose_errors` times the plan's. Errors are stereo's refusals and those of `kept`.
Result<std::vector<FieldFrame>> LookAtGround(const World& world, const ViewPlan& plan,
                                             double pose_errors, const StereoSettings& settings,
                                             std::uint64_t seed, KeptPictures kept = {});

/// By how much the worst touchdown breaks the limits.
struct SiteTruth {
  /// Largest share of a limit that is used: 1 is the limit. Infinity: water, something that moves,
  /// or off the grid.
  double worst_of_limit = 0;
  const char* what =
      "";  ///< which limit: "slope", "deviation", "step", "water", "moving", "unknown"

  enum class Verdict : std::uint8_t {
    kWithin,
    kOver,          ///< by up to 1.2 times a limit
    kUnsafe,        ///< by more
    kGrosslyUnsafe  ///< by more than 1.5 times
  };
  Verdict verdict() const;
  static constexpr double kUnsafe = 1.2, kGross = 1.5;
};
inline constexpr int kSiteVerdictCount = 4;
const char* SiteVerdictName(SiteTruth::Verdict verdict);

SiteTruth TruthOfSite(const World& world, const Eigen::Vector2d& place_m, const Lander& lander,
                      const TruthLimits& limits, double time_s);

/// Whether both cameras see a disc about a place whole from the middle of the hover. Things that hide
/// it are not asked.
bool SeenWhole(const World& world, const ViewPlan& plan, const Eigen::Vector2d& place_m,
               double radius_m);

/// Whether the camera at the middle of the hover sees, whole and in both pictures, a disc of that
/// radius on which every limit is kept to `share`. Things that hide it are not asked.
bool SeesSafeDisc(const World& world, const ViewPlan& plan, double radius_m,
                  const TruthLimits& limits, double share);

}  // namespace palace
