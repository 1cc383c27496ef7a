#include "engine/simulation/target_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/camera/cahvor.h"
#include "engine/core/check.h"

namespace palace {
namespace {

constexpr int kParts = 4;  // a pixel at an edge is integrated in kParts x kParts
using Point = Eigen::Vector2d;

/// Share of a small parallelogram centred at signed distance d inside an edge; w is its width along
/// the edge's normal. Exact where an edge is parallel to a side, within 0.06 of a part elsewhere.
double Coverage(double distance, double width) {
  return std::clamp(0.5 + distance / width, 0.0, 1.0);
}

/// The part of the plane that a piece of a pixel sees: its middle and its two sides.
struct Piece {
  Point middle;
  Point side_x;
  Point side_y;
  double WidthAlong(const Point& unit) const {
    return std::abs(unit.dot(side_x)) + std::abs(unit.dot(side_y)) + 1e-12;
  }
};

class Pattern {
 public:
  Pattern(const CalibrationTarget& target, const TargetLook& look)
      : target_(target),
        look_(look),
        board_low_(Point::Constant(-Rim())),
        board_high_(pitch() * Point(target.columns - 1, target.rows - 1) + Point::Constant(Rim())) {
  }

  /// Mean grey level over the piece.
  double Grey(const Piece& piece) const {
    const double board = BoxCoverage(piece, board_low_, board_high_);
    const double ink =
        target_.kind == TargetKind::kDots ? DotCoverage(piece) : SquareCoverage(piece);
    const double on_board = look_.paper + ink * (look_.ink - look_.paper);
    return look_.surroundings + board * (on_board - look_.surroundings);
  }

  /// True when no edge can lie within `reach_m` of the point.
  bool IsEven(const Point& p, double reach_m) const {
    const double to_board =
        std::min((p - board_low_).cwiseAbs().minCoeff(), (board_high_ - p).cwiseAbs().minCoeff());
    const bool outside = (p.array() < board_low_.array() - reach_m).any() ||
                         (p.array() > board_high_.array() + reach_m).any();
    if (outside) {
      return true;
    }
    if (to_board < reach_m) {
      return false;
    }
    if (target_.kind == TargetKind::kDots) {
      return std::abs(InsideNearestDot(p)) > reach_m;
    }
    const Point in_squares = p / pitch();
    const Point off = (in_squares - in_squares.array().round().matrix()).cwiseAbs() * pitch();
    return off.minCoeff() > reach_m;
  }

 private:
  double pitch() const { return target_.pitch_m; }
  double Rim() const {
    return (look_.rim + (target_.kind == TargetKind::kChessboard ? 1 : 0)) * target_.pitch_m;
  }

  static double BoxCoverage(const Piece& piece, const Point& low, const Point& high) {
    double coverage = 1;
    for (int axis = 0; axis < 2; ++axis) {
      const double width = piece.WidthAlong(Point::Unit(axis));
      coverage *= Coverage(piece.middle[axis] - low[axis], width) *
                  Coverage(high[axis] - piece.middle[axis], width);
    }
    return coverage;
  }

  int NearestDot(const Point& p) const {
    const int column =
        std::clamp(static_cast<int>(std::lround(p.x() / pitch())), 0, target_.columns - 1);
    const int row = std::clamp(static_cast<int>(std::lround(p.y() / pitch())), 0, target_.rows - 1);
    return row * target_.columns + column;
  }

  double InsideNearestDot(const Point& p) const {
    const int dot = NearestDot(p);
    return target_.DotDiameter_m(dot) / 2 - (p - target_.p_TQ(dot).head<2>()).norm();
  }

  double DotCoverage(const Piece& piece) const {
    const Point from = piece.middle - target_.p_TQ(NearestDot(piece.middle)).head<2>();
    const double length = from.norm();
    const Point outward = length > 0 ? Point(from / length) : Point(Point::UnitX());
    return Coverage(InsideNearestDot(piece.middle), piece.WidthAlong(outward));
  }

  /// Ink on every second square of (columns + 1) x (rows + 1).
  double SquareCoverage(const Piece& piece) const {
    double wave = 1;
    for (int axis = 0; axis < 2; ++axis) {
      const double at = piece.middle[axis] / pitch();
      const double line = std::round(at);
      const double distance = (at - line) * pitch();
      const double parity = std::fmod(std::abs(line), 2) == 0 ? 1 : -1;
      wave *= parity * (2 * Coverage(distance, piece.WidthAlong(Point::Unit(axis))) - 1);
    }
    const double inside = BoxCoverage(piece, Point::Constant(-pitch()),
                                      pitch() * Point(target_.columns, target_.rows));
    return inside * (1 + wave) / 2;
  }

  const CalibrationTarget& target_;
  const TargetLook& look_;
  const Point board_low_;
  const Point board_high_;
};

/// Where the pixels' corners see the target's plane; NaN where they do not.
class PlaneMap {
 public:
  PlaneMap(const CahvorModel& camera, const RigidTransform& X_FT)
      : columns_(camera.width + 1), points_(Count(camera), Point::Constant(std::nan(""))) {
    const RigidTransform X_TF = X_FT.Inverse();
    for (int y = 0; y <= camera.height; ++y) {
      for (int x = 0; x <= camera.width; ++x) {
        const auto ray = RayFromPixelCahvor(camera, {x - 0.5, y - 0.5});
        if (!ray) {
          continue;
        }
        const Eigen::Vector3d origin = X_TF * ray->origin;
        const Eigen::Vector3d direction = X_TF.R * ray->direction;
        if (direction.z() > 1e-9 && origin.z() < 0) {
          points_[At(x, y)] = (origin - direction * (origin.z() / direction.z())).head<2>();
        }
      }
    }
  }

  const Point& Corner(int x, int y) const { return points_[At(x, y)]; }

 private:
  static std::size_t Count(const CahvorModel& camera) {
    return static_cast<std::size_t>(camera.width + 1) * static_cast<std::size_t>(camera.height + 1);
  }
  std::size_t At(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(x);
  }

  const int columns_;
  std::vector<Point> points_;
};

/// Mean over the pixel: its corners' images on the plane, bilinear between them.
double PixelGrey(const Pattern& pattern, const PlaneMap& plane, int x, int y) {
  const Point& a = plane.Corner(x, y);
  const Point& b = plane.Corner(x + 1, y);
  const Point& c = plane.Corner(x, y + 1);
  const Point& d = plane.Corner(x + 1, y + 1);
  const Piece whole{(a + b + c + d) / 4, (b + d - a - c) / 2, (c + d - a - b) / 2};
  const double reach = whole.side_x.norm() + whole.side_y.norm();
  if (pattern.IsEven(whole.middle, reach)) {
    return pattern.Grey(whole);
  }
  double sum = 0;
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; j < kParts; ++j) {
      const double s = (i + 0.5) / kParts, t = (j + 0.5) / kParts;
      sum += pattern.Grey({(1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d),
                           whole.side_x / kParts, whole.side_y / kParts});
    }
  }
  return sum / (kParts * kParts);
}

/// One pass of a Gaussian along rows, the result transposed; two passes blur both ways.
std::vector<double> BlurTransposed(const std::vector<double>& grey, int width, int height,
                                   const std::vector<double>& kernel) {
  const int half = static_cast<int>(kernel.size() / 2);
  std::vector<double> out(grey.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      for (int k = -half; k <= half; ++k) {
        const int at = std::clamp(x + k, 0, width - 1);
        sum += kernel[static_cast<std::size_t>(k + half)] *
               grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(at)];
      }
      out[static_cast<std::size_t>(x) * static_cast<std::size_t>(height) +
          static_cast<std::size_t>(y)] = sum;
    }
  }
  return out;
}

void Blur(std::vector<double>& grey, int width, int height, double sigma_px) {
  if (!(sigma_px > 0)) {
    return;
  }
  const int half = static_cast<int>(std::ceil(4 * sigma_px));
  std::vector<double> kernel;
  double sum = 0;
  for (int k = -half; k <= half; ++k) {
    kernel.push_back(std::exp(-0.5 * k * k / (sigma_px * sigma_px)));
    sum += kernel.back();
  }
  for (double& weight : kernel) {
    weight /= sum;
  }
  grey = BlurTransposed(BlurTransposed(grey, width, height, kernel), height, width, kernel);
}

}  // namespace

ImageU8 RenderTarget(const CalibrationTarget& target, const CahvorModel& camera,
                     const RigidTransform& X_FT, const TargetLook& look, RandomStream& random) {
  PALACE_CHECK(camera.width > 1 && camera.height > 1, camera.width, camera.height);
  const Pattern pattern(target, look);
  const PlaneMap plane(camera, X_FT);
  const int width = camera.width, height = camera.height;
  std::vector<double> grey;
  grey.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool hit = plane.Corner(x, y).allFinite() && plane.Corner(x + 1, y).allFinite() &&
                       plane.Corner(x, y + 1).allFinite() && plane.Corner(x + 1, y + 1).allFinite();
      grey.push_back(hit ? PixelGrey(pattern, plane, x, y) : look.surroundings);
    }
  }
  Blur(grey, width, height, look.blur_sigma_px);
  ImageU8 picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double across = 2 * (x + 0.5) / width - 1, down = 2 * (y + 0.5) / height - 1;
      const double light = (1 + look.light_right * across + look.light_down * down) *
                           (1 - look.vignetting * (across * across + down * down) / 2);
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x);
      const double noise = look.noise_sigma > 0 ? look.noise_sigma * random.Normal() : 0;
      picture.at(x, y) =
          static_cast<std::uint8_t>(std::clamp(std::lround(grey[at] * light + noise), 0L, 255L));
    }
  }
  return picture;
}

}  // namespace palace
