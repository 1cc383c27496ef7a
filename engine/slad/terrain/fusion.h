// Terrain fusion: elevation of many frames in one map that moves with the view.
//
// Each cell keeps a mean m, its variance P and a count. A frame's cell mean z with variance R is
// first corrected by a plane (offset, north tilt, east tilt) fitted robustly to z - m, because the
// noise of attitude and position moves a frame as a whole (the map takes 1/(1 + n) of that plane
// after n frames, n at most 50, so that its own tilt becomes the mean of theirs; the frame takes
// the rest), then fused as (sideways it is moved before, by its picture: sideways_registration.h)
//
//   1/P' = lambda/P + 1/R,   m' = P' (lambda m / P + z / R)
//
// lambda is 1 for the first frames_fused frames of a cell, so that their order does not matter, and
// 1 - 1/frames_fused from then on: the weight of frames_fused frames is kept.
//
// Of a cell's points the mean is fused as the measured ground, and by the same weights the mean
// with the relief inside the cell as its top. What frames disagree about by more than noise is
// relief (frame_spread.h): it is added to the published top. So is what the pictures show that is
// too narrow for stereo's window (narrow_things.h). None of them touches the measured ground.
// The pictures do: where they know the ground better than stereo, both the measured ground and its
// variance are what they tell, and the top moves along (fine_ground.h). Last, the variance of what
// stereo repeats in every frame, which no fusing takes away, is added. All this is of the map that
// is given out; m and P stay as fused.
//
// A cell disagrees beyond the gate
//
//   (z - m)^2 > 9 (P + R + g^2 s^2) + (5 cm)^2,
//   s^2 = position sigma^2 + (attitude sigma * range)^2, of the frame's pose.
//
// It is then not averaged: it counts in the spread only, and the second disagreement in a row on
// the same side replaces the cell. A pose laid sideways by s misplaces ground of gradient g (the
// frame's own, over two cells): an edge that wanders is no contradiction. It stays out of R,
// because it says where an edge is, not whether. Unseen cells keep their height while their
// variance and age grow; age is the data time since a frame last
// held the cell, agreeing or not. Thesis mode fuses nothing: Add is ElevationFromRange.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <Eigen/Dense>

#include "engine/model/elevation_map.h"
#include "engine/model/range_map.h"
#include "engine/model/settings/settings.h"
#include "engine/slad/terrain/fine_relief.h"
#include "engine/slad/terrain/frame_spread.h"
#include "engine/slad/terrain/sideways_registration.h"
#include "engine/slad/terrain/terrain_points.h"

namespace palace {

class TerrainFusion {
 public:
  /// Forgets all frames.
  void Reset();
  /// Fuses one range map, which has a pose and a baseline, and returns the new map. A change of
  /// mode, cell size, grid size or bounds starts afresh. `around`: a place (north, east) that the
  /// map keeps in its middle half wherever the view goes, so that its edge comes not near it.
  /// `left` and `right`: the pictures that belong to it, null without: then nothing tells what the
  /// pose lays aside, and nothing finer than stereo's window is known.
  std::shared_ptr<const ElevationMap> Add(const RangeMap& range, const SladSettings& settings,
                                          const std::optional<Eigen::Vector2d>& around = {},
                                          const ImageU8* left = nullptr,
                                          const ImageU8* right = nullptr);

  /// From where navigation says the camera of the newest frame was to where it was laid, in W.
  const RigidTransform& registered() const { return registered_; }

 private:
  void MoveTo(const GridGeometry& geometry);
  void AddFine(const RangeMap& range, const ImageU8* left, const ImageU8* right,
               const PlaneCorrection& off);
  /// What was taken from the frame's heights.
  PlaneCorrection Register(ElevationMap& frame);
  PlaneCorrection FuseFrame(const RangeMap& range, const TerrainPoints& points,
                            const SladSettings& settings);
  void Age(Timestamp now);
  void Fuse(const ElevationMap& frame, const GridF& misplaced_m2, int frames_fused);

  ElevationMap map_;                ///< measured cells only; holes are filled in what Add returns
  Grid<std::int8_t> disagreement_;  ///< sign of the last frame that failed the gate, 0 none
  Grid<FrameSpread> spread_;
  SidewaysRegistration sideways_;
  FineRelief fine_;
  Grid<std::uint8_t> standing_;  ///< of its places, see TakeNarrowThings
  SladSettings layout_;          ///< settings the grid was laid out with
  RigidTransform registered_;
  int frames_ = 0;
  std::uint64_t last_ranges_ = 0;  ///< sampled hash of the last range map and its pose
};

}  // namespace palace
