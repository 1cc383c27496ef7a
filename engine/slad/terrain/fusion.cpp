#include "engine/slad/terrain/fusion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/hash.h"
#include "engine/slad/terrain/air_seen.h"
#include "engine/slad/terrain/elevation_map_builder.h"
#include "engine/slad/terrain/fine_ground.h"
#include "engine/slad/terrain/frame_registration.h"
#include "engine/slad/terrain/hole_filling.h"
#include "engine/slad/terrain/narrow_things.h"
#include "engine/slad/terrain/terrain_points.h"
#include "engine/slad/terrain/unexplained.h"

namespace palace {
namespace {

constexpr double kGate2 = 9;                   // three sigmas
constexpr double kGateFloor_m2 = 0.05 * 0.05;  // matching wobbles this much beyond its sigma
constexpr double kFusedFloor_m2 = 1e-5;
constexpr double kUnseenGrowth_m2 = 4e-6;  // a map unseen: 2 cm after a hundred maps
constexpr int kLongestMemory_frames = 50;
/// Stereo errs on the same ground by this much in every frame: texture under the window, steps of
/// whole pixels. It does not average away.
constexpr double kRepeated_px = 0.012;
/// What is left of a frame's place sideways, once its picture told the rest.
constexpr double kRegistered_m = 0.015;
/// The map follows the view once its centre is off by this share of its size.
constexpr double kSlack = 0.08;

/// The holes that are filled and the rim are no part of the layout, nor is how far a map of that
/// cell reaches.
bool SameLayout(const SladSettings& a, const SladSettings& b) {
  GridSettings grid = a.grid;
  grid.data_size_cells = b.grid.data_size_cells;
  grid.border_size_cells = b.grid.border_size_cells;
  if (grid.bounds == BoundsMode::kData) {
    grid.rows = b.grid.rows;
    grid.cols = b.grid.cols;
  }
  return a.mode == b.mode && grid == b.grid;
}

/// Of one size, and the centres near each other.
bool IsHeldBy(const GridGeometry& a, const GridGeometry& b) {
  return a.rows == b.rows && a.cols == b.cols &&
         std::abs(a.north_min_m - b.north_min_m) <= kSlack * a.rows * a.cell_m &&
         std::abs(a.east_min_m - b.east_min_m) <= kSlack * a.cols * a.cell_m;
}

/// Shifted by whole cells until the place lies within a quarter of the side from the centre.
GridGeometry KeptAround(GridGeometry grid, const Eigen::Vector2d& place) {
  const auto shift = [&](double min_m, int cells, double at_m) {
    const double side_m = cells * grid.cell_m;
    const double off_m = at_m - (min_m + side_m / 2);
    const double over_m = off_m - std::clamp(off_m, -side_m / 4, side_m / 4);
    return grid.cell_m * std::copysign(std::ceil(std::abs(over_m) / grid.cell_m), over_m);
  };
  grid.north_min_m += shift(grid.north_min_m, grid.rows, place.x());
  grid.east_min_m += shift(grid.east_min_m, grid.cols, place.y());
  return grid;
}

/// Of a cell's height over two cells, by the neighbours that are measured; 0 without a pair.
double SquaredGradient(const ElevationMap& frame, int r, int c) {
  const auto slope = [&](Cell a, Cell b) {
    const bool known = frame.geometry.Contains(a) && frame.geometry.Contains(b) &&
                       frame.state.at(a) == CellState::kMeasured &&
                       frame.state.at(b) == CellState::kMeasured;
    return known ? static_cast<double>(frame.height_m.at(b) - frame.height_m.at(a)) /
                       (2 * frame.geometry.cell_m)
                 : 0.0;
  };
  const double north = slope({r + 1, c}, {r - 1, c});
  const double east = slope({r, c - 1}, {r, c + 1});
  return north * north + east * east;
}

/// Height variance by which a pose laid sideways misplaces each cell.
GridF MisplacedVariance(const ViewPose& pose, const ElevationMap& frame) {
  const double position_m = pose.sigmas.position_m, attitude_rad = pose.sigmas.attitude_rad;
  const GridGeometry& g = frame.geometry;
  GridF variance_m2(g.rows, g.cols, 0.0F);
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      if (frame.state.at(r, c) != CellState::kMeasured) {
        continue;
      }
      const Eigen::Vector3d p_WQ(g.NorthOfRow(r), g.EastOfCol(c),
                                 -static_cast<double>(frame.height_m.at(r, c)));
      const double sideways2 = position_m * position_m +
                               attitude_rad * attitude_rad * (p_WQ - pose.X_WC.p).squaredNorm();
      variance_m2.at(r, c) = static_cast<float>(SquaredGradient(frame, r, c) * sideways2);
    }
  }
  return variance_m2;
}

/// Of the pose and every 89th range: two exposures of one scene never share them all.
std::uint64_t SampledHash(const RangeMap& range) {
  constexpr std::size_t kStride = 89;
  const RigidTransform& X_WC = range.pose->X_WC;
  ContentHash hash;
  for (int i = 0; i < 3; ++i) {
    hash.Add(X_WC.p[i]);
    hash.Add(X_WC.R(i, 0));
    hash.Add(X_WC.R(i, 2));
  }
  const auto& depths = range.depth_m.pixels();
  for (std::size_t i = 0; i < depths.size(); i += kStride) {
    hash.Add(depths[i]);
  }
  return hash.value();
}

/// Of the error that stereo repeats in every frame, per measured cell.
GridF RepeatedVariance(const RangeMap& range, const ElevationMap& map) {
  const RigidTransform& X_WC = range.pose->X_WC;
  const double focal_times_baseline = range.FocalTimesBaseline();
  const GridGeometry& g = map.geometry;
  GridF variance_m2(g.rows, g.cols, 0.0F);
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      if (map.state.at(r, c) == CellState::kMeasured) {
        const Eigen::Vector3d p_WQ(g.NorthOfRow(r), g.EastOfCol(c),
                                   -static_cast<double>(map.height_m.at(r, c)));
        const double depth_m = X_WC.R.col(2).dot(p_WQ - X_WC.p);
        const double error_m = kRepeated_px * depth_m * depth_m / focal_times_baseline;
        variance_m2.at(r, c) = static_cast<float>(error_m * error_m);
      }
    }
  }
  return variance_m2;
}

/// Lowers heights by the correction: up and down, and by a turn about the middle of the ground that
/// was compared; then sideways.
RigidTransform MotionOf(const PlaneCorrection& off, const Eigen::Vector2d& by_m) {
  const Eigen::Vector3d turn(off.east_tilt, -off.north_tilt, 0);
  const Eigen::Vector3d about(off.north_m, off.east_m, -off.height_m);
  RigidTransform motion;
  if (turn.norm() > 0) {
    motion.R = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  }
  motion.p = about - motion.R * about + Eigen::Vector3d(by_m.x(), by_m.y(), off.offset_m);
  return motion;
}

void AddVariance(const GridF& variance_m2, ElevationMap& map) {
  for (std::size_t i = 0; i < variance_m2.cells().size(); ++i) {
    map.variance_m2.cells()[i] += variance_m2.cells()[i];
  }
}

}  // namespace

void TerrainFusion::Reset() {
  map_ = ElevationMap{};
  disagreement_ = {};
  spread_ = {};
  sideways_.Reset();
  fine_.Reset();
  standing_ = {};
  frames_ = 0;
  registered_ = {};
}

std::shared_ptr<const ElevationMap> TerrainFusion::Add(const RangeMap& range,
                                                       const SladSettings& settings,
                                                       const std::optional<Eigen::Vector2d>& around,
                                                       const ImageU8* left, const ImageU8* right) {
  PALACE_CHECK(range.pose.has_value() && range.FocalTimesBaseline() > 0, range.baseline_m);
  if (!SameLayout(settings, layout_)) {
    Reset();
  }
  layout_ = settings;
  if (settings.mode == SladMode::kThesis) {
    return std::make_shared<const ElevationMap>(ElevationFromRange(range, settings));
  }
  const TerrainPoints points = PointsFromRange(range);
  if (!points.empty() || frames_ == 0) {
    const GridGeometry seen = LayOutGrid(ChooseBounds(points, settings, &range), settings);
    const GridGeometry wanted = around ? KeptAround(seen, *around) : seen;
    // A picture without a point says nothing about where to look: the map stays.
    const bool strayed =
        frames_ > 0 && around && KeptAround(map_.geometry, *around) != map_.geometry;
    if (frames_ == 0 || strayed || !IsHeldBy(wanted, map_.geometry)) {
      MoveTo(wanted);
    }
  }
  Age(range.time);
  const std::uint64_t ranges = SampledHash(range);
  // The very same ranges from the same place again, as of a still picture, say nothing new.
  if (frames_ == 0 || points.empty() || ranges != last_ranges_) {
    SidewaysRegistration::Shift shift;
    if (left != nullptr) {
      shift = sideways_.Add(range, *left, map_.geometry, settings.fusion.frames_fused);
    }
    PlaneCorrection off;
    if (shift.told) {
      RangeMap moved = range;
      moved.pose->X_WC.p.head<2>() += shift.by_m;
      moved.pose->sigmas.position_m = kRegistered_m;
      off = FuseFrame(moved, PointsFromRange(moved), settings);
      AddFine(moved, left, right, off);
    } else {
      off = FuseFrame(range, points, settings);
      AddFine(range, left, right, off);
    }
    registered_ = MotionOf(off, shift.by_m);
  }
  last_ranges_ = ranges;
  // Frames without a point do not count: the first real one lays out the grid.
  frames_ += points.empty() ? 0 : 1;
  map_.attitude_sigma_rad = range.pose->sigmas.attitude_rad;
  auto published = std::make_shared<ElevationMap>(map_);
  AddReliefBetweenFrames(spread_, *published);
  // Without pictures nothing is known of narrow things: the figures are there, and say so.
  const FineSums sums = fine_.Sums();
  TakeFineGround(sums, *published);
  const GridF repeated_m2 = RepeatedVariance(range, *published);
  const Viewpoint view{range.camera, range.pose->X_WC.p};
  TakeNarrowThings(sums, view, repeated_m2, standing_, *published);
  TakeMarks(Unexplained(fine_.seen()), view, range.FocalTimesBaseline(), *published);
  AddVariance(repeated_m2, *published);
  FillHoles(*published, settings.grid.data_size_cells, settings.grid.border_size_cells);
  return published;
}

void TerrainFusion::AddFine(const RangeMap& range, const ImageU8* left, const ImageU8* right,
                            const PlaneCorrection& off) {
  const auto fits = [&](const ImageU8* picture) {
    return picture != nullptr && picture->width() == range.disparity_px.width() &&
           picture->height() == range.disparity_px.height();
  };
  if (fits(left) && fits(right)) {
    fine_.Add(range, *left, *right, off, kLongestMemory_frames);
  }
}

PlaneCorrection TerrainFusion::FuseFrame(const RangeMap& range, const TerrainPoints& points,
                                         const SladSettings& settings) {
  ElevationMap frame =
      AccumulateCells(points, map_.geometry, settings.mode, kCorrelatedPixels, range.time);
  const PlaneCorrection off = Register(frame);
  AddAirSeen(range.camera, range.pose->X_WC, frame, map_.air_seen_to_m);
  Fuse(frame, MisplacedVariance(*range.pose, frame), settings.fusion.frames_fused);
  return off;
}

void TerrainFusion::MoveTo(const GridGeometry& geometry) {
  const GridGeometry old = map_.geometry;
  map_.geometry = geometry;
  for (GridF* layer :
       {&map_.height_m, &map_.measured_m, &map_.variance_m2, &map_.age_s, &map_.air_seen_to_m}) {
    *layer = MovedTo(geometry, old, *layer, kUnknownValue);
  }
  map_.frame_count = MovedTo(geometry, old, map_.frame_count);
  map_.state = MovedTo(geometry, old, map_.state, CellState::kUnknown);
  disagreement_ = MovedTo(geometry, old, disagreement_);
  spread_ = MovedTo(geometry, old, spread_);
  const GridGeometry places = FineRelief::PlacesOf(geometry);
  standing_ = MovedTo(places, FineRelief::PlacesOf(old), standing_);
  fine_.MoveTo(geometry);
}

PlaneCorrection TerrainFusion::Register(ElevationMap& frame) {
  if (frames_ == 0) {
    return {};
  }
  const PlaneCorrection correction = RegisterFrame(frame, map_);
  // The map moves a little towards each frame, so that its own tilt becomes the mean of theirs
  // and does not stay the first frame's.
  const double map_gain = 1.0 / (1 + std::min(frames_, kLongestMemory_frames));
  ApplyCorrection(correction, map_gain, map_);
  ApplyCorrection(correction, map_gain - 1, frame);
  fine_.Raise(correction, map_gain);
  PlaneCorrection taken = correction;
  taken.offset_m *= 1 - map_gain;
  taken.north_tilt *= 1 - map_gain;
  taken.east_tilt *= 1 - map_gain;
  return taken;
}

void TerrainFusion::Age(Timestamp now) {
  const auto passed_s = static_cast<float>(std::max(0.0, SecondsBetween(map_.time, now)));
  for (float& age_s : map_.age_s.cells()) {
    age_s += passed_s;  // NaN stays NaN
  }
  map_.time = now;
}

void TerrainFusion::Fuse(const ElevationMap& frame, const GridF& misplaced_m2, int frames_fused) {
  const int memory = std::max(1, frames_fused);
  for (std::size_t i = 0; i < frame.state.cells().size(); ++i) {
    float& mean = map_.height_m.cells()[i];
    float& measured = map_.measured_m.cells()[i];
    float& variance = map_.variance_m2.cells()[i];
    std::uint16_t& count = map_.frame_count.cells()[i];
    CellState& state = map_.state.cells()[i];
    std::int8_t& disagreement = disagreement_.cells()[i];
    FrameSpread& spread = spread_.cells()[i];
    float& age_s = map_.age_s.cells()[i];
    const double p = static_cast<double>(variance);
    if (frame.state.cells()[i] != CellState::kMeasured) {
      variance = static_cast<float>(p + kUnseenGrowth_m2);
      continue;
    }
    age_s = 0;
    const double z = static_cast<double>(frame.height_m.cells()[i]);
    const double measured_z = static_cast<double>(frame.measured_m.cells()[i]);
    const double noise = static_cast<double>(frame.variance_m2.cells()[i]);
    const double m = static_cast<double>(mean);
    const double off = z - m;
    const bool known = state == CellState::kMeasured;
    const double expected = p + noise + static_cast<double>(misplaced_m2.cells()[i]);
    const bool agrees = known && off * off <= kGate2 * expected + kGateFloor_m2;
    const std::int8_t side = off > 0 ? 1 : -1;
    if (known && !agrees && disagreement != side) {
      spread.Add(off, noise, memory);
      disagreement = side;
      continue;
    }
    disagreement = 0;
    if (!agrees) {
      mean = static_cast<float>(z);
      measured = static_cast<float>(measured_z);
      variance = static_cast<float>(noise);
      count = 1;
      state = CellState::kMeasured;
      if (known) {
        const auto cols = static_cast<std::size_t>(map_.geometry.cols);
        fine_.Forget({static_cast<int>(i / cols), static_cast<int>(i % cols)});
      }
      // Something new stands there. Where something is gone, what was seen of it fades slowly.
      if (known && off < 0) {
        spread.Add(off, noise, memory);
        spread.Follow(off);
      } else {
        spread = FrameSpread{};
        spread.Add(0, noise, memory);
      }
      continue;
    }
    const double remember = count < memory ? 1 : 1 - 1.0 / memory;
    const double fused = 1 / (remember / p + 1 / noise);
    mean = static_cast<float>(fused * (remember * m / p + z / noise));
    measured = static_cast<float>(
        fused * (remember * static_cast<double>(measured) / p + measured_z / noise));
    spread.Add(off, noise, memory);
    spread.Follow(static_cast<double>(mean) - m);
    variance = static_cast<float>(std::max(fused, kFusedFloor_m2));
    count = static_cast<std::uint16_t>(std::min<int>(count + 1, memory));
  }
}

}  // namespace palace
