#include "engine/slad/terrain/fusion.h"

#include <gtest/gtest.h>

#include "tests/slad/worlds.h"

namespace palace {
namespace {

using testing::CameraPose;
using testing::Flat;
using testing::SeeWorld;
using testing::WithBox;

struct Errors {
  double rms_m = 0;
  double predicted_m = 0;
  int cells = 0;
};

/// Errors against a world over cells seen, after removing their mean.
Errors ErrorsOf(const ElevationMap& map, const testing::Height& world) {
  double sum = 0, square = 0, variance = 0;
  Errors errors;
  for (int r = 0; r < map.geometry.rows; ++r) {
    for (int c = 0; c < map.geometry.cols; ++c) {
      if (map.state.at(r, c) == CellState::kMeasured) {
        const double off = double(map.height_m.at(r, c)) -
                           world(map.geometry.NorthOfRow(r), map.geometry.EastOfCol(c));
        sum += off;
        square += off * off;
        variance += double(map.variance_m2.at(r, c));
        ++errors.cells;
      }
    }
  }
  errors.rms_m = std::sqrt(square / errors.cells - std::pow(sum / errors.cells, 2));
  errors.predicted_m = std::sqrt(variance / errors.cells);
  return errors;
}

TEST(TerrainFusion, TenFramesLowerTheNoise) {
  TerrainFusion fusion;
  const RigidTransform X_WC = CameraPose(15.24, Rad(45));
  Errors first, last;
  for (std::uint64_t frame = 1; frame <= 10; ++frame) {
    const auto map = fusion.Add(SeeWorld(Flat(), X_WC, 0.15, frame), SladSettings{});
    last = ErrorsOf(*map, Flat());
    first = frame == 1 ? last : first;
  }
  EXPECT_GT(last.cells, 5000);
  EXPECT_LT(last.rms_m, first.rms_m / 2.5);
  EXPECT_LT(last.predicted_m, first.predicted_m / 2.5);
  EXPECT_GT(last.predicted_m, 0.5 * last.rms_m);
}

// The edge of the map is no hazard of the ground: about a place that matters it keeps away.
TEST(TerrainFusion, TheMapStaysAroundAPlaceWhereverTheViewGoes) {
  TerrainFusion fusion;
  const Eigen::Vector2d place(14, 1);
  for (int frame = 0; frame < 8; ++frame) {
    RigidTransform X_WC = CameraPose(15.24, Rad(45));
    X_WC.p.x() += 1.5 * frame;
    const auto map =
        fusion.Add(SeeWorld(Flat(), X_WC, 0.05, std::uint64_t(frame) + 1), SladSettings{}, place);
    const GridGeometry& g = map->geometry;
    const double side_m = g.rows * g.cell_m;
    const double off_m = std::abs(place.x() - (g.north_min_m + side_m / 2));
    EXPECT_LE(off_m, side_m / 4 + g.cell_m) << frame;
    EXPECT_EQ(map->state.at(*g.CellFromPoint(place.x(), place.y())), CellState::kMeasured);
  }
}

TEST(TerrainFusion, FrameTiltsAreRegistered) {
  TerrainFusion fusion;
  RandomStream random(3, "attitude");
  const auto world = WithBox(Flat(), 15, 1, 1.0, 0.75);
  std::shared_ptr<const ElevationMap> map;
  double steps_square = 0;
  double before = 0;
  for (std::uint64_t frame = 1; frame <= 12; ++frame) {
    const RigidTransform truth = CameraPose(15.24, Rad(45));
    const EulerAngles error{Rad(0.3) * random.Normal(), Rad(0.3) * random.Normal(), 0};
    RigidTransform believed = CameraPose(15.24, Rad(45), 0, error);
    believed.p.z() += 0.05 * random.Normal();
    RangeMap range = SeeWorld(world, truth, 0.08, frame);
    range.pose->X_WC = believed;
    map = fusion.Add(range, SladSettings{});
    const auto cell = map->geometry.CellFromPoint(18, 3);
    ASSERT_TRUE(cell);
    const double height = double(map->height_m.at(*cell));
    if (frame > 6) {
      steps_square += std::pow(height - before, 2);
    }
    before = height;
  }
  // 0.3 deg at 20 m is 0.1 m a frame; registered, the map moves by its mean only.
  EXPECT_LT(std::sqrt(steps_square / 6), 0.035);
  const auto table = map->geometry.CellFromPoint(15, 1);
  const auto beside = map->geometry.CellFromPoint(15, -1.5);
  ASSERT_TRUE(table && beside);
  EXPECT_NEAR(double(map->height_m.at(*table) - map->height_m.at(*beside)), 0.75, 0.08);
}

// What is taken from a frame's heights is told as a motion of its camera.
TEST(TerrainFusion, TheRegisteredPoseIsThatOfTheFramesBefore) {
  TerrainFusion fusion;
  const auto world = WithBox(Flat(), 15, 1, 1.0, 0.75);
  const RigidTransform truth = CameraPose(15.24, Rad(45));
  for (std::uint64_t frame = 1; frame <= 10; ++frame) {
    fusion.Add(SeeWorld(world, truth, 0.02, frame), SladSettings{});
  }
  RangeMap range = SeeWorld(world, truth, 0.02, 11);
  RigidTransform& believed = range.pose->X_WC;
  believed = CameraPose(15.24, Rad(45), 0, {Rad(0.4), -Rad(0.3), 0});
  believed.p.z() += 0.2;
  fusion.Add(range, SladSettings{});
  const RigidTransform laid = fusion.registered() * believed;
  // Points of the ground lie where the frames before laid them: heights are told, nothing sideways.
  for (const Eigen::Vector3d& p_C : {Eigen::Vector3d(0, 0, 21), {3, 2, 18}, {-4, -3, 26}}) {
    const double before_m = std::abs((believed * p_C - truth * p_C).z());
    EXPECT_LT(std::abs((laid * p_C - truth * p_C).z()), 0.1 * before_m + 0.01) << p_C.transpose();
  }
}

TEST(TerrainFusion, MapFollowsTheViewByWholeCells) {
  TerrainFusion fusion;
  const SladSettings settings;
  GridGeometry first;
  const auto world = WithBox(Flat(), 14.0, 0, 0.9, 0.8);
  for (int frame = 0; frame < 8; ++frame) {
    const RigidTransform X_WC = CameraPose(15.24, Rad(45), 0.5 * frame);
    const auto map = fusion.Add(SeeWorld(world, X_WC, 0.05, std::uint64_t(frame) + 1), settings);
    first = frame == 0 ? map->geometry : first;
    const double shift = (map->geometry.north_min_m - first.north_min_m) / settings.grid.cell_m;
    EXPECT_NEAR(shift, std::round(shift), 1e-6);
    const auto box = map->geometry.CellFromPoint(14.0, 0.0);
    ASSERT_TRUE(box);
    EXPECT_NEAR(double(map->height_m.at(*box)), 0.8, 0.1) << frame;
    if (frame == 7) {
      EXPECT_GT(shift, 5);
    }
  }
}

// Once seen is a false match as well as a thing: a tenth of a second later it is told.
TEST(TerrainFusion, NewObstacleReplacesTheGroundOnItsSecondSighting) {
  TerrainFusion fusion;
  const RigidTransform X_WC = CameraPose(15.24, Rad(60));
  const auto see = [&](const testing::Height& world, std::uint64_t seed) {
    return fusion.Add(SeeWorld(world, X_WC, 0.05, seed), SladSettings{});
  };
  for (std::uint64_t i = 1; i <= 5; ++i) {
    see(Flat(), i);
  }
  const auto box = WithBox(Flat(), 9, 0, 1.2, 1.0);
  const auto once = see(box, 6);
  const auto cell = once->geometry.CellFromPoint(9, 0);
  ASSERT_TRUE(cell);
  EXPECT_NEAR(double(once->height_m.at(*cell)), 0, 0.05);
  const auto twice = see(box, 7);
  EXPECT_NEAR(double(twice->height_m.at(*cell)), 1.0, 0.1);
}

TEST(TerrainFusion, OrderOfTenFramesDoesNotMatter) {
  // The same frames, noise and pose errors included, in three orders.
  constexpr std::uint64_t kSeed = 11;
  constexpr int kFrames = 10;
  RandomStream random(kSeed, "order");
  const auto world = WithBox(Flat(), 14, 1, 1.0, 0.5);
  std::vector<RangeMap> ranges;
  for (std::uint64_t i = 0; i < kFrames; ++i) {
    const RigidTransform truth = CameraPose(15.24, Rad(45));
    const EulerAngles error{Rad(0.1) * random.Normal(), Rad(0.1) * random.Normal(), 0};
    ranges.push_back(SeeWorld(world, truth, 0.08, 100 + i));
    RigidTransform& believed = ranges.back().pose->X_WC;
    believed = CameraPose(15.24, Rad(45), 0, error);
    believed.p.z() += 0.03 * random.Normal();
  }
  const auto fuse = [&](auto index_of) {
    TerrainFusion fusion;
    std::shared_ptr<const ElevationMap> map;
    for (int i = 0; i < kFrames; ++i) {
      const auto at = static_cast<std::size_t>(index_of(i));
      map = fusion.Add(ranges[at], SladSettings{});
    }
    return map;
  };
  const auto forward = fuse([](int i) { return i; });
  for (const int stride : {9, 3}) {  // backwards; every third, round and round
    const auto other = fuse([&](int i) { return (i * stride + 5) % kFrames; });
    const GridGeometry& g = forward->geometry;
    int cells = 0, apart = 0;
    double square = 0, offset = 0;
    for (int r = 0; r < g.rows; ++r) {
      for (int c = 0; c < g.cols; ++c) {
        const auto at = other->geometry.CellFromPoint(g.NorthOfRow(r), g.EastOfCol(c));
        if (!at || forward->frame_count.at(r, c) < kFrames ||
            other->frame_count.at(*at) < kFrames) {
          continue;
        }
        // Before a thing tops are raised to the rays of the newest view: there a few cells differ.
        const double off = double(forward->Measured().at(r, c) - other->Measured().at(*at));
        const double off_top = double(forward->height_m.at(r, c) - other->height_m.at(*at));
        const double sigma = std::sqrt(double(forward->variance_m2.at(r, c)));
        ++cells;
        offset += off_top;
        square += off * off / (sigma * sigma);
        apart += std::abs(off_top) > 3 * sigma ? 1 : 0;
      }
    }
    ASSERT_GT(cells, 4000);
    // Registration and the gate know the past, so the order is not quite nothing: a tenth of a
    // sigma. Forgetting from the first frame on would cost up to twice that.
    EXPECT_LT(std::sqrt(square / cells), 0.12) << "seed " << kSeed << " stride " << stride;
    EXPECT_LT(apart, cells / 500);
    EXPECT_NEAR(offset / cells, 0, 0.002);
  }
}

TEST(TerrainFusion, AgeIsTheTimeSinceACellWasLastSeen) {
  TerrainFusion fusion;
  const RigidTransform near = CameraPose(15.24, Rad(60));
  const RigidTransform north = CameraPose(15.24, Rad(60), 1.0);
  const auto see = [&](const RigidTransform& X_WC, double time_s) {
    RangeMap range = SeeWorld(Flat(), X_WC, 0.02, 1);
    range.time = AddSeconds({}, time_s);
    return fusion.Add(range, SladSettings{});
  };
  const auto first = see(near, 1.0);
  const auto last = see(north, 3.5);
  int old = 0, fresh = 0, never = 0;
  for (int r = 0; r < last->geometry.rows; ++r) {
    for (int c = 0; c < last->geometry.cols; ++c) {
      const float age_s = last->age_s.at(r, c);
      if (last->state.at(r, c) != CellState::kMeasured) {
        ASSERT_TRUE(std::isnan(age_s));
        ++never;
      } else if (last->frame_count.at(r, c) == 2 || age_s == 0) {
        ASSERT_EQ(age_s, 0.0F);
        ++fresh;
      } else {
        ASSERT_NEAR(double(age_s), 2.5, 1e-6);
        ++old;
      }
    }
  }
  EXPECT_GT(old, 20);
  EXPECT_GT(fresh, 1000);
  EXPECT_GT(never, 20);
  EXPECT_EQ(first->age_s.at(50, 50), 0.0F);
}

// What stands in a cell narrower than the cell is not averaged away, and level noise is not raised.
TEST(TerrainFusion, APostNarrowerThanACellKeepsItsHeight) {
  const auto post = WithBox(Flat(), 9.08, 0.08, 0.09, 1.0);
  const RigidTransform X_WC = CameraPose(15.24, Rad(60));
  TerrainFusion fusion;
  std::shared_ptr<const ElevationMap> map;
  for (std::uint64_t i = 1; i <= 10; ++i) {
    map = fusion.Add(SeeWorld(post, X_WC, 0.03, i), SladSettings{});
  }
  double highest = 0;
  for (double n = 8.8; n < 9.4; n += 0.05) {
    for (double e = -0.2; e < 0.4; e += 0.05) {
      const auto cell = map->geometry.CellFromPoint(n, e);
      ASSERT_TRUE(cell);
      highest = std::max(highest, double(map->height_m.at(*cell)));
    }
  }
  EXPECT_GT(highest, 0.5);
  const Errors level = ErrorsOf(*map, post);
  EXPECT_LT(level.rms_m, 0.05);
}

// No evidence writes into the measured ground: it is the mean of what was seen, and never above the
// top; where nothing stands the two are one.
TEST(TerrainFusion, MeasuredGroundLiesUnderTheTopAndIsNotRaised) {
  const auto rocks = WithBox(WithBox(Flat(), 9.08, 0.08, 0.12, 0.3), 7, 1, 0.3, 0.2);
  TerrainFusion fusion;
  std::shared_ptr<const ElevationMap> map;
  for (std::uint64_t i = 1; i <= 10; ++i) {
    const RigidTransform X_WC = CameraPose(15.24, Rad(60), 0.3 * static_cast<double>(i));
    map = fusion.Add(SeeWorld(rocks, X_WC, 0.03, i), SladSettings{});
  }
  ASSERT_TRUE(map->measured_m.rows() == map->height_m.rows());
  double raised_m = 0, highest_m = 0;
  int same = 0, cells = 0;
  for (std::size_t i = 0; i < map->state.cells().size(); ++i) {
    ASSERT_EQ(std::isnan(map->measured_m.cells()[i]), std::isnan(map->height_m.cells()[i]));
    if (map->state.cells()[i] == CellState::kMeasured) {
      const double top_m = double(map->height_m.cells()[i]),
                   measured_m = double(map->measured_m.cells()[i]);
      EXPECT_GE(top_m, measured_m - 1e-5);
      raised_m = std::max(raised_m, top_m - measured_m);
      highest_m = std::max(highest_m, measured_m);
      same += top_m - measured_m < 1e-4 ? 1 : 0;
      ++cells;
    }
  }
  EXPECT_GT(raised_m, 0.05) << "the narrow rock stands in the top";
  EXPECT_LT(highest_m, 0.33) << "nothing is measured higher than it is";
  EXPECT_GT(same, cells / 2);
}

TEST(TerrainFusion, APictureWithoutRangesLeavesTheNoise) {
  TerrainFusion fusion;
  const RigidTransform X_WC = CameraPose(15.24, Rad(45));
  RangeMap range = SeeWorld(Flat(), X_WC, 0.15, 1);
  const auto seen = fusion.Add(range, SladSettings{});
  for (ImageF* layer : {&range.depth_m, &range.depth_sigma_m, &range.disparity_px}) {
    std::fill(layer->pixels().begin(), layer->pixels().end(), kUnknownValue);
  }
  const auto blind = fusion.Add(range, SladSettings{});
  const auto cell = seen->geometry.CellFromPoint(15, 0);
  ASSERT_TRUE(cell && blind->geometry == seen->geometry);
  EXPECT_GE(blind->variance_m2.at(*cell), seen->variance_m2.at(*cell));
}

TEST(TerrainFusion, EmptyRangeMapGivesAllUnknown) {
  TerrainFusion fusion;
  const auto nothing = [](double, double) { return -1e9; };
  const RigidTransform X_WC = CameraPose(15, Rad(45));
  const auto map = fusion.Add(SeeWorld(nothing, X_WC, 0.1, 1), SladSettings{});
  for (const CellState state : map->state.cells()) {
    ASSERT_EQ(state, CellState::kUnknown);
  }
}

}  // namespace
}  // namespace palace
