#include "engine/experiments/touchdown_field.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/random.h"
#include "engine/core/units.h"

namespace palace {
namespace {

/// Height at (north, east) of things laid one over the other.
class Ground {
 public:
  Ground(GroundKind kind, double side_m, RandomStream& random) : random_(random), side_m_(side_m) {
    AddSlope(kind == GroundKind::kSlope ? Rad(random.Uniform(4, 14)) : Rad(random.Uniform(0, 5)));
    AddWaves(random.Uniform(0.3, 1.5), random.Uniform(0, 0.006));  // grass, gravel
    if (kind == GroundKind::kMixed) {
      AddSlope(Rad(random.Uniform(0, 5)));
    }
    if (kind == GroundKind::kWaves || kind == GroundKind::kMixed) {
      const double longest_m = random.Uniform(0.8, 8);
      const double steepest = random.Uniform(0.01, kind == GroundKind::kMixed ? 0.12 : 0.3);
      AddWaves(longest_m, std::min(0.2, steepest * longest_m / (2 * M_PI)));
    }
    if (kind == GroundKind::kRocks || kind == GroundKind::kMixed) {
      const double height_m = random.Uniform(0.03, 0.35);
      const int count = 1 + random.Index(kind == GroundKind::kMixed ? 8 : 24);
      for (int k = 0; k < count; ++k) {
        AddRock(height_m * random.Uniform(0.5, 1), random.Uniform(1, 3));
      }
    }
    if (kind == GroundKind::kMounds) {
      for (int k = 3 + random.Index(8); k > 0; --k) {
        AddMound();
      }
    }
    if (kind == GroundKind::kSteps) {
      AddStep();
    }
  }

  double At(double north_m, double east_m) const {
    double z = north_gradient_ * north_m + east_gradient_ * east_m;
    for (const Wave& wave : waves_) {
      z += wave.amplitude_m * std::sin(wave.north * north_m + wave.east * east_m + wave.phase);
    }
    for (const Bump& bump : bumps_) {
      const double r2 = (std::pow(north_m - bump.north_m, 2) + std::pow(east_m - bump.east_m, 2)) /
                        (bump.radius_m * bump.radius_m);
      z += bump.round ? bump.height_m * std::exp(-r2)
                      : bump.height_m * std::sqrt(std::max(0.0, 1 - r2));
    }
    if (step_m_ != 0) {
      z += north_m * std::cos(step_rad_) + east_m * std::sin(step_rad_) > step_at_m_ ? step_m_ : 0;
    }
    return z;
  }

 private:
  struct Wave {
    double amplitude_m, north, east, phase;
  };
  struct Bump {
    double north_m, east_m, radius_m, height_m;
    bool round;
  };

  double Place() { return random_.Uniform(-side_m_ / 2, side_m_ / 2); }
  void AddSlope(double slope_rad) {
    const double azimuth = random_.Uniform(0, 2 * M_PI);
    north_gradient_ += std::tan(slope_rad) * std::cos(azimuth);
    east_gradient_ += std::tan(slope_rad) * std::sin(azimuth);
  }
  /// Three waves of like length, any direction.
  void AddWaves(double length_m, double amplitude_m) {
    for (int k = 0; k < 3; ++k) {
      const double azimuth = random_.Uniform(0, 2 * M_PI);
      const double number = 2 * M_PI / (length_m * random_.Uniform(0.7, 1.4));
      waves_.push_back({amplitude_m * random_.Uniform(0.2, 0.6), number * std::cos(azimuth),
                        number * std::sin(azimuth), random_.Uniform(0, 2 * M_PI)});
    }
  }
  void AddRock(double height_m, double width_per_height) {
    const double radius_m = std::max(0.06, height_m * width_per_height / 2);
    bumps_.push_back({Place(), Place(), radius_m, height_m, false});
  }
  void AddMound() {
    const double north_m = Place(), east_m = Place(), radius_m = random_.Uniform(0.25, 1.5);
    bumps_.push_back({north_m, east_m, radius_m, random_.Uniform(-0.25, 0.25), true});
  }
  void AddStep() {
    step_rad_ = random_.Uniform(0, 2 * M_PI);
    step_at_m_ = random_.Uniform(-side_m_ / 3, side_m_ / 3);
    step_m_ = random_.Uniform(0.02, 0.3);
  }

  RandomStream& random_;
  double side_m_;
  double north_gradient_ = 0, east_gradient_ = 0;
  std::vector<Wave> waves_;
  std::vector<Bump> bumps_;
  double step_rad_ = 0, step_at_m_ = 0, step_m_ = 0;
};

/// Unit noise that 2x2 neighbouring cells share, as the windows of stereo overlap.
GridF SharedNoise(int side, RandomStream& random) {
  GridF white(side + 1, side + 1, 0.0F), noise(side, side, 0.0F);
  for (float& value : white.cells()) {
    value = static_cast<float>(random.Normal());
  }
  for (int r = 0; r < side; ++r) {
    for (int c = 0; c < side; ++c) {
      noise.at(r, c) = 0.5F * (white.at(r, c) + white.at(r + 1, c) + white.at(r, c + 1) +
                               white.at(r + 1, c + 1));
    }
  }
  return noise;
}

/// The true points around a place, in metres from it.
class Points {
 public:
  Points(const TouchdownField& field, double cell_m, Cell cell)
      : height_m_(field.height_m),
        spacing_m_(cell_m / kPointsPerCell),
        middle_{cell.row * kPointsPerCell + kPointsPerCell / 2,
                cell.col * kPointsPerCell + kPointsPerCell / 2} {}

  double spacing_m() const { return spacing_m_; }
  /// South and east in points.
  bool Known(int south, int east) const {
    return middle_.row + south >= 0 && middle_.row + south < height_m_.rows() &&
           middle_.col + east >= 0 && middle_.col + east < height_m_.cols();
  }
  double At(int south, int east) const {
    return static_cast<double>(height_m_.at(middle_.row + south, middle_.col + east));
  }
  double Between(double north_m, double east_m) const {
    const double south = -north_m / spacing_m_, east = east_m / spacing_m_;
    const int r = static_cast<int>(std::floor(south)), c = static_cast<int>(std::floor(east));
    const double v = south - r, u = east - c;
    return (1 - v) * ((1 - u) * At(r, c) + u * At(r, c + 1)) +
           v * ((1 - u) * At(r + 1, c) + u * At(r + 1, c + 1));
  }
  /// Calls visit(south, east) for the points within the distance.
  template <typename Visit>
  void ForDisc(double radius_m, Visit visit) const {
    const int reach = static_cast<int>(radius_m / spacing_m_);
    for (int r = -reach; r <= reach; ++r) {
      for (int c = -reach; c <= reach; ++c) {
        if (std::hypot(r, c) * spacing_m_ <= radius_m && Known(r, c)) {
          visit(r, c);
        }
      }
    }
  }

 private:
  const GridF& height_m_;
  double spacing_m_;
  Cell middle_;
};

/// Robust plane of the footprint: height at the middle, gradients to north and east.
Eigen::Vector3d PlaneOf(const Points& points, double diameter_m) {
  const int half = static_cast<int>(diameter_m * std::sqrt(M_PI) / 4 / points.spacing_m());
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  double scatter_m = HUGE_VAL;
  for (int pass = 0; pass < 3; ++pass) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    double squares = 0, count = 0;
    for (int r = -half; r <= half; ++r) {
      for (int c = -half; c <= half; ++c) {
        if (!points.Known(r, c)) {
          continue;
        }
        const Eigen::Vector3d at(1, -r * points.spacing_m(), c * points.spacing_m());
        const double off = points.At(r, c) - at.dot(plane);
        if (off > 0.02 + 0.5 * scatter_m || off < -0.02 - 1.5 * scatter_m) {
          continue;
        }
        normal += at * at.transpose();
        right += points.At(r, c) * at;
        squares += points.At(r, c) * points.At(r, c);
        count += 1;
      }
    }
    if (count < 10) {
      break;
    }
    plane = normal.ldlt().solve(right);
    scatter_m = std::sqrt(std::max(0.0, squares - plane.dot(right)) / count);
  }
  return plane;
}

/// Least mean support height of two skids: convex in the pitch, so thirds close in on it.
struct SkidsRest {
  double pitch, left, right;
};
SkidsRest RestSkids(const std::vector<double>& left, const std::vector<double>& right,
                    double spacing_m) {
  const auto support = [&](const std::vector<double>& skid, double pitch) {
    double most = -HUGE_VAL;
    for (std::size_t k = 0; k < skid.size(); ++k) {
      const double x =
          spacing_m * (static_cast<double>(k) - 0.5 * static_cast<double>(skid.size() - 1));
      most = std::max(most, skid[k] - pitch * x);
    }
    return most;
  };
  double low = -3, high = 3;
  for (int i = 0; i < 40; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    const bool lower = support(left, a) + support(right, a) < support(left, b) + support(right, b);
    (lower ? high : low) = lower ? b : a;
  }
  const double pitch = (low + high) / 2;
  return {pitch, support(left, pitch), support(right, pitch)};
}

void PutGearDown(const Points& points, const SladSettings& settings, TrueTouchdown& truth) {
  const double length_m = settings.lander.gear_length_m, width_m = settings.lander.gear_width_m;
  const bool skids = settings.lander.gear == LandingGear::kSkids;
  const double corner_m = std::hypot(length_m, width_m) / 2;
  const int headings = static_cast<int>(std::ceil(M_PI * corner_m / points.spacing_m() / 1.5));
  const int gaps = skids ? static_cast<int>(std::ceil(length_m / points.spacing_m() - 1e-9)) : 1;
  truth.tilt_rad = 0;
  truth.rise_m = -HUGE_VAL;
  for (int h = 0; h < headings; ++h) {
    const double n = std::cos(h * M_PI / headings), e = std::sin(h * M_PI / headings);
    std::vector<double> side[2];
    for (int k = 0; k <= gaps; ++k) {
      const double x = length_m * (static_cast<double>(k) / gaps - 0.5);
      for (int s = 0; s < 2; ++s) {
        const double y = (s - 0.5) * width_m;
        side[s].push_back(points.Between(x * n - y * e, x * e + y * n));
      }
    }
    const auto compare = [&](double pitch, double roll, double middle_m) {
      const Eigen::Vector3d normal =
          Eigen::Vector3d(-(pitch * n - roll * e), -(pitch * e + roll * n), -1).normalized();
      truth.tilt_rad =
          std::max(truth.tilt_rad, std::atan2(normal.cross(settings.lander.up_W()).norm(),
                                              normal.dot(settings.lander.up_W())));
      points.ForDisc(corner_m, [&](int south, int east) {
        const double north_m = -south * points.spacing_m(), east_m = east * points.spacing_m();
        const double x = north_m * n + east_m * e, y = east_m * n - north_m * e;
        if (std::abs(x) <= length_m / 2 && std::abs(y) <= width_m / 2) {
          truth.rise_m =
              std::max(truth.rise_m, points.At(south, east) - middle_m - pitch * x - roll * y);
        }
      });
    };
    if (skids) {
      const SkidsRest rest = RestSkids(side[0], side[1], length_m / gaps);
      compare(rest.pitch, (rest.right - rest.left) / width_m, (rest.left + rest.right) / 2);
      continue;
    }
    // Each three pads; a plane the fourth pad would have to be below is none to rest on.
    for (int out = 0; out < 4; ++out) {
      const auto z = [&](int s, int k) { return side[s][static_cast<std::size_t>(k)]; };
      const int s = out / 2, k = out % 2;  // the pad in the air
      const double fourth = z(s, 1 - k) + z(1 - s, k) - z(1 - s, 1 - k);
      if (z(s, k) > fourth + 1e-9) {
        continue;
      }
      const double along = z(1 - s, 1) - z(1 - s, 0), across = z(1, 1 - k) - z(0, 1 - k);
      compare(along / length_m, across / width_m, (z(s, 1 - k) + z(1 - s, k)) / 2);
    }
  }
}

}  // namespace

TouchdownField MakeTouchdownField(GroundKind kind, const SladSettings& settings, int side,
                                  std::uint64_t seed) {
  RandomStream random(seed, "touchdown field");
  const double cell_m = settings.grid.cell_m;
  const GridGeometry geometry{side, side, cell_m, -side * cell_m / 2, -side * cell_m / 2};
  const Ground ground(kind, side * cell_m, random);
  TouchdownField field;
  const int points = side * kPointsPerCell;
  field.height_m = GridF(points, points, 0.0F);
  for (int r = 0; r < points; ++r) {
    for (int c = 0; c < points; ++c) {
      const double row = (r + 0.5) / kPointsPerCell - 0.5, col = (c + 0.5) / kPointsPerCell - 0.5;
      field.height_m.at(r, c) =
          static_cast<float>(ground.At(geometry.NorthOfRow(row), geometry.EastOfCol(col)));
    }
  }
  // From near ground to 100 ft. Stereo's own sigma is right within 15 %.
  field.sigma_m = 0.004 * std::pow(0.05 / 0.004, random.Uniform());
  const double declared = field.sigma_m * random.Uniform(0.87, 1.15);
  field.map = {{},
               geometry,
               GridF(side, side, 0.0F),
               GridF(side, side, static_cast<float>(declared * declared)),
               Grid<std::uint16_t>(side, side, 10),
               Grid<CellState>(side, side, CellState::kMeasured)};
  const GridF noise = SharedNoise(side, random);
  // Attitude is wrong by 0.1 degrees, the same for all frames of a map.
  const double north_tilt = Rad(0.1) * random.Normal(), east_tilt = Rad(0.1) * random.Normal();
  for (int r = 0; r < side; ++r) {
    for (int c = 0; c < side; ++c) {
      double sum = 0;
      for (int k = 0; k < kPointsPerCell * kPointsPerCell; ++k) {
        sum += static_cast<double>(field.height_m.at(r * kPointsPerCell + k / kPointsPerCell,
                                                     c * kPointsPerCell + k % kPointsPerCell));
      }
      field.map.height_m.at(r, c) = static_cast<float>(
          sum / (kPointsPerCell * kPointsPerCell) + north_tilt * geometry.NorthOfRow(r) +
          east_tilt * geometry.EastOfCol(c) + field.sigma_m * static_cast<double>(noise.at(r, c)));
    }
  }
  return field;
}

bool TrueTouchdown::Safe(const SladSettings& settings) const {
  const double most_rad = Rad(settings.limits.max_slope_deg);
  return slope_rad <= most_rad && tilt_rad <= most_rad &&
         deviation_m <= settings.limits.max_deviation_m && step_m <= settings.limits.max_step_m &&
         rise_m <= settings.lander.belly_clearance_m;
}

TrueTouchdown FindTrueTouchdown(const TouchdownField& field, const SladSettings& settings,
                                Cell cell) {
  const Points points(field, settings.grid.cell_m, cell);
  const Eigen::Vector3d plane = PlaneOf(points, settings.lander.base_size_m);
  TrueTouchdown truth;
  const Eigen::Vector3d normal = Eigen::Vector3d(-plane[1], -plane[2], -1).normalized();
  truth.slope_rad =
      std::atan2(normal.cross(settings.lander.up_W()).norm(), normal.dot(settings.lander.up_W()));
  const double spacing_m = points.spacing_m();
  points.ForDisc(settings.lander.radius_m(), [&](int south, int east) {
    const auto off = [&](int r, int c) {
      return points.At(r, c) - plane.dot(Eigen::Vector3d(1, -r * spacing_m, c * spacing_m));
    };
    const double here = off(south, east);
    truth.deviation_m = std::max(truth.deviation_m, std::abs(here));
    for (int k = 0; k < 9; ++k) {
      const int r = south + (k / 3 - 1) * kPointsPerCell, c = east + (k % 3 - 1) * kPointsPerCell;
      if (k != 4 && points.Known(r, c)) {
        truth.step_m = std::max(truth.step_m, std::abs(off(r, c) - here));
      }
    }
  });
  PutGearDown(points, settings, truth);
  return truth;
}

}  // namespace palace
