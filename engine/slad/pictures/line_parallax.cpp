#include "engine/slad/pictures/line_parallax.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <opencv2/core/utility.hpp>

#include "engine/slad/pictures/thin_piece.h"

namespace palace {
namespace {

// The ground beside the line, rows and columns apart.
constexpr int kBandFrom_px = 6, kBandTo_px = 26, kBandStep_px = 4;
constexpr int kSearch_px = 6;  // what the pose may leave over
constexpr int kSearchStride_px = 20;
constexpr int kIterations = 3;
constexpr double kLeastCorrelation = 0.3;
constexpr std::size_t kLeastSamples = 100;
// The line itself.
constexpr int kLineStep_px = 2;
constexpr int kAcross_px = 4;        // its profile reaches so far to both sides
constexpr int kMostAside_px = 40;    // it is looked for so far aside
constexpr double kMostUnlike = 0.3;  // of the profile's energy, what is left where it is found
constexpr double kTwice = 0.6;       // of that energy: found elsewhere with less left over
constexpr double kMatching_px = 0.1;
constexpr double kLeastRows = 1e-3;  // a pixel of disparity

/// A point of the new picture and where the pose alone lays it in the older one.
struct Laid {
  double grey = 0;
  Eigen::Vector2d q = Eigen::Vector2d::Zero();
  double along = 0;  ///< from the middle of the line, -1 to 1
};

/// Bilinear; `q` must lie inside by a pixel.
double GreyAt(const ImageF& picture, const Eigen::Vector2d& q) {
  const int x = static_cast<int>(q.x()), y = static_cast<int>(q.y());
  const double f = q.x() - x, g = q.y() - y;
  const float *a = picture.row(y) + x, *b = picture.row(y + 1) + x;
  return (1 - g) * ((1 - f) * double{a[0]} + f * double{a[1]}) +
         g * ((1 - f) * double{b[0]} + f * double{b[1]});
}

bool IsInside(const ImageF& picture, const Eigen::Vector2d& q, double rim_px) {
  return q.x() >= rim_px && q.y() >= rim_px && q.x() < picture.width() - 1 - rim_px &&
         q.y() < picture.height() - 1 - rim_px;
}

double Square(double x) { return x * x; }

/// Every second pixel of a chain.
struct Line {
  Line(const MarkStrips& strips, const std::vector<LinePiece>& chain) {
    for (const LinePiece& piece : chain) {
      for (int k = 0; k < kStrip_px; k += kLineStep_px) {
        pixels.push_back(strips.Pixel(piece, k / double(kStrip_px - 1)));
      }
    }
  }
  /// -1 at its left end to 1.
  double Along(int x) const {
    const double from = pixels.front().x(), to = pixels.back().x();
    return (2 * x - from - to) / std::max(1.0, to - from);
  }

  std::vector<Eigen::Vector2d> pixels;
};

}  // namespace

/// The new view and an older one.
class LineParallax::Pair {
 public:
  Pair(const SceneView& view, const SceneGround& ground, std::shared_ptr<const ImageF> smooth,
       const OlderView& old)
      : view_(view),
        ground_(ground),
        now_(std::move(smooth)),
        old_(old.smooth),
        X_OldW_(old.pose.X_WC.Inverse()),
        way_sigma_(std::hypot(view.range->pose->sigmas.position_m, old.pose.sigmas.position_m) /
                   view.range->baseline_m) {
    FindShift();
  }

  std::optional<Sight> Above(const MarkStrips& strips, const std::vector<LinePiece>& chain) const;

 private:
  /// What the ground beside a line leaves over: shift, and what it turns to its ends.
  struct Registered {
    Eigen::Vector3d left_px = Eigen::Vector3d::Zero();
    double sigma_px = 0;  ///< of the shift across

    Eigen::Vector2d operator()(const Laid& laid) const {
      return laid.q + Eigen::Vector2d(left_px.x(), left_px.y() + left_px.z() * laid.along);
    }
  };

  /// A line's pixels on the ground, and how many rows a pixel of disparity lays it across.
  struct LaidLine {
    struct Pixel {
      int x, y;
      Eigen::Vector2d q;
    };
    std::vector<Pixel> pixels;
    double rows_a_px = 0;
  };
  struct Aside {
    double rows = 0;
    double variance_px2 = 0;
  };

  std::optional<double> GroundAt(int x, int y) const {
    const int i = x / kBlock_px, j = y / kBlock_px;
    if (x < 0 || y < 0 || i >= ground_.cols() || j >= ground_.rows() ||
        ground_.usable.at(i, j) == 0) {
      return std::nullopt;
    }
    return double{ground_.disparity_px.at(i, j)};
  }
  /// NaN behind the older camera.
  Eigen::Vector2d InOld(double x, double y, double disparity_px) const {
    const PinholeCamera& camera = view_.range->camera;
    const Eigen::Vector3d p = X_OldW_ * PointAt(view_, x, y, disparity_px);
    if (!(p.z() > 0)) {
      return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
    }
    return {camera.fx_px * p.x() / p.z() + camera.cx_px,
            camera.fy_px * p.y() / p.z() + camera.cy_px};
  }
  void FindShift();
  std::vector<Laid> Band(const Line& line) const;
  std::optional<Registered> Register(const std::vector<Laid>& band) const;
  std::optional<LaidLine> LayLine(const Line& line, const Registered& registered) const;
  std::optional<Aside> FindAgain(const LaidLine& line) const;

  const SceneView& view_;
  const SceneGround& ground_;
  std::shared_ptr<const ImageF> now_;
  const ImageF& old_;
  RigidTransform X_OldW_;
  double way_sigma_;  ///< of the way between the views, over the baseline
  Eigen::Vector2d shift_px_ = Eigen::Vector2d::Zero();  ///< of the whole picture, whole pixels
};

void LineParallax::Pair::FindShift() {
  std::vector<Laid> samples;
  for (int y = kSearchStride_px / 2; y < now_->height(); y += kSearchStride_px) {
    for (int x = kSearchStride_px / 2; x < now_->width(); x += kSearchStride_px) {
      const auto ground = GroundAt(x, y);
      if (!ground) {
        continue;
      }
      const Eigen::Vector2d q = InOld(x, y, *ground);
      if (IsInside(old_, q, kSearch_px + 2)) {
        samples.push_back({double{now_->at(x, y)}, q});
      }
    }
  }
  const auto left_over = [&](const Eigen::Vector2d& by) {
    double sum = 0, square = 0;
    for (const Laid& s : samples) {
      const double off = GreyAt(old_, s.q + by) - s.grey;
      sum += off;
      square += off * off;
    }
    return square - sum * sum / std::max(1.0, static_cast<double>(samples.size()));
  };
  // Every second pixel, then those around the best.
  for (const int step : {2, 1}) {
    const int reach = step > 1 ? kSearch_px : 1;
    const Eigen::Vector2d around = shift_px_;
    double least = std::numeric_limits<double>::infinity();
    for (int dy = -reach; dy <= reach; dy += step) {
      for (int dx = -reach; dx <= reach; dx += step) {
        const Eigen::Vector2d by = around + Eigen::Vector2d(dx, dy);
        const double left = left_over(by);
        if (left < least) {
          least = left;
          shift_px_ = by;
        }
      }
    }
  }
}

std::vector<Laid> LineParallax::Pair::Band(const Line& line) const {
  std::vector<Laid> band;
  for (std::size_t k = 0; k < line.pixels.size(); k += kBandStep_px / kLineStep_px) {
    const int x = static_cast<int>(std::lround(line.pixels[k].x()));
    for (int off = kBandFrom_px; off <= kBandTo_px; off += kBandStep_px) {
      for (const int side : {-off, off}) {
        const int y = static_cast<int>(std::lround(line.pixels[k].y())) + side;
        const auto ground = GroundAt(x, y);
        if (!ground) {
          continue;
        }
        const Eigen::Vector2d q = InOld(x, y, *ground) + shift_px_;
        if (IsInside(old_, q, kSearch_px + 2)) {
          band.push_back({double{now_->at(x, y)}, q, line.Along(x)});
        }
      }
    }
  }
  return band;
}

/// Least squares on the grey: shift along and across, turn.
std::optional<LineParallax::Pair::Registered> LineParallax::Pair::Register(
    const std::vector<Laid>& band) const {
  if (band.size() < kLeastSamples) {
    return std::nullopt;
  }
  Registered found;
  for (int iteration = 0;; ++iteration) {
    // The fourth unknown is what the light changed.
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    double sum = 0, square = 0, product = 0, sum_old = 0, square_old = 0;
    for (const Laid& laid : band) {
      const Eigen::Vector2d q = found(laid);
      if (!IsInside(old_, q, 1)) {
        return std::nullopt;
      }
      const double grey = GreyAt(old_, q);
      const double gx =
          (GreyAt(old_, q + Eigen::Vector2d(1, 0)) - GreyAt(old_, q - Eigen::Vector2d(1, 0))) / 2;
      const double gy =
          (GreyAt(old_, q + Eigen::Vector2d(0, 1)) - GreyAt(old_, q - Eigen::Vector2d(0, 1))) / 2;
      const Eigen::Vector4d by(gx, gy, gy * laid.along, 1);
      normal += by * by.transpose();
      right -= by * (grey - laid.grey);
      sum += laid.grey;
      square += laid.grey * laid.grey;
      product += laid.grey * grey;
      sum_old += grey;
      square_old += grey * grey;
    }
    const double n = static_cast<double>(band.size());
    const Eigen::LDLT<Eigen::Matrix4d> solver(normal);
    if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 0)) {
      return std::nullopt;
    }
    const Eigen::Vector4d step = solver.solve(right);
    if (!(step.head<3>().norm() < kSearch_px)) {
      return std::nullopt;
    }
    if (iteration == kIterations) {
      const double spread = square - sum * sum / n, old_spread = square_old - sum_old * sum_old / n;
      const double common = product - sum * sum_old / n;
      if (!(common > kLeastCorrelation * std::sqrt(spread * old_spread))) {
        return std::nullopt;
      }
      // Of pictures that are alike to the bit rounding leaves less than nothing.
      const double left_over = std::max(0.0, spread + old_spread - 2 * common) / n;
      found.sigma_px = std::sqrt(left_over * solver.solve(Eigen::Vector4d::Unit(1)).eval()(1));
      return found;
    }
    found.left_px += step.head<3>();
  }
}

std::optional<LineParallax::Pair::LaidLine> LineParallax::Pair::LayLine(
    const Line& line, const Registered& registered) const {
  LaidLine laid;
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : line.pixels) {
    const int x = static_cast<int>(std::lround(p.x())), y = static_cast<int>(std::lround(p.y()));
    const auto ground = GroundAt(x, y);
    if (!ground || y < kAcross_px || y + kAcross_px >= now_->height()) {
      continue;
    }
    const Eigen::Vector2d on_ground = InOld(x, y, *ground);
    const Eigen::Vector2d q = registered({0, on_ground + shift_px_, line.Along(x)});
    if (IsInside(old_, q, kMostAside_px + kAcross_px + 1)) {
      laid.pixels.push_back({x, y, q});
      moved += InOld(x, y, *ground + 1) - on_ground;
    }
  }
  if (laid.pixels.size() < kLeastSamples) {
    return std::nullopt;
  }
  moved /= static_cast<double>(laid.pixels.size());
  const Eigen::Vector2d run = laid.pixels.back().q - laid.pixels.front().q;
  if (std::abs(run.x()) < std::abs(run.y())) {
    return std::nullopt;
  }
  laid.rows_a_px = moved.y() - moved.x() * run.y() / run.x();
  return std::abs(laid.rows_a_px) > kLeastRows ? std::optional(std::move(laid)) : std::nullopt;
}

std::optional<LineParallax::Pair::Aside> LineParallax::Pair::FindAgain(const LaidLine& line) const {
  // It is looked for where a line may be: on the ground or above it.
  const double most =
      std::clamp(kMostAbove_px * line.rows_a_px, 1.0 - kMostAside_px, kMostAside_px - 1.0);
  const int from = kMostAside_px + std::min(-1, static_cast<int>(std::floor(most))),
            to = kMostAside_px + std::max(1, static_cast<int>(std::ceil(most)));
  const double n = static_cast<double>(line.pixels.size());
  std::array<double, 2 * kAcross_px + 1> now{};
  std::array<double, 2 * (kMostAside_px + kAcross_px) + 1> old{};
  for (const LaidLine::Pixel& at : line.pixels) {
    for (int row = -kAcross_px; row <= kAcross_px; ++row) {
      now[static_cast<std::size_t>(row + kAcross_px)] += double{now_->at(at.x, at.y + row)} / n;
    }
    for (int k = from - 1; k <= to + 1 + 2 * kAcross_px; ++k) {
      old[static_cast<std::size_t>(k)] +=
          GreyAt(old_, at.q + Eigen::Vector2d(0, k - kMostAside_px - kAcross_px)) / n;
    }
  }
  // What is left of the profile where it is laid over the older one, r rows aside.
  const double mean =
      std::accumulate(now.begin(), now.end(), 0.0) / static_cast<double>(now.size());
  double energy = 0;
  for (const double grey : now) {
    energy += Square(grey - mean);
  }
  std::array<double, 2 * kMostAside_px + 1> left{};
  for (int r = from - 1; r <= to + 1; ++r) {
    double sum = 0, square = 0;
    for (std::size_t k = 0; k < now.size(); ++k) {
      const double off = old[static_cast<std::size_t>(r) + k] - now[k];
      sum += off;
      square += off * off;
    }
    left[static_cast<std::size_t>(r)] = square - sum * sum / static_cast<double>(now.size());
  }
  const auto best = std::min_element(left.begin() + from, left.begin() + to + 1);
  const int at = static_cast<int>(best - left.begin());
  if (*best > kMostUnlike * energy) {
    return std::nullopt;
  }
  for (int r = from; r <= to; ++r) {
    if (std::abs(r - at) > kAcross_px && left[static_cast<std::size_t>(r)] < kTwice * energy) {
      return std::nullopt;
    }
  }
  const double before = *(best - 1), after = *(best + 1), bend = before - 2 * *best + after;
  if (!(bend > 0)) {
    return std::nullopt;
  }
  const double noise2 = *best / static_cast<double>(now.size() - 2);
  return Aside{at - kMostAside_px + (before - after) / (2 * bend), 2 * noise2 / bend};
}

std::optional<LineParallax::Sight> LineParallax::Pair::Above(
    const MarkStrips& strips, const std::vector<LinePiece>& chain) const {
  const Line line(strips, chain);
  const auto registered = Register(Band(line));
  const auto laid = registered ? LayLine(line, *registered) : std::nullopt;
  const auto aside = laid ? FindAgain(*laid) : std::nullopt;
  if (!aside) {
    return std::nullopt;
  }
  const double found2 = aside->variance_px2 + Square(registered->sigma_px) + Square(kMatching_px);
  const double s2 = Square(laid->rows_a_px);
  return Sight{aside->rows / laid->rows_a_px, found2 / s2, Square(way_sigma_) / s2};
}

LineParallax::LineParallax(const SceneView& view, const SceneGround& ground,
                           const OlderViews& older) {
  if (older.views().empty() || older.views().back().camera != view.range->camera) {
    return;
  }
  const auto smooth = std::make_shared<const ImageF>(SmoothedPicture(*view.left));
  pairs_.resize(older.views().size());
  cv::parallel_for_(cv::Range(0, static_cast<int>(pairs_.size())), [&](const cv::Range& range) {
    for (std::size_t k = std::size_t(range.start); k < std::size_t(range.end); ++k) {
      pairs_[k] = std::make_unique<Pair>(view, ground, smooth, older.views()[k]);
    }
  });
}

LineParallax::~LineParallax() = default;

std::optional<LineAbove> LineParallax::Above(const MarkStrips& strips,
                                             const std::vector<LinePiece>& chain) const {
  std::vector<std::optional<Sight>> each(pairs_.size());
  cv::parallel_for_(cv::Range(0, static_cast<int>(pairs_.size())), [&](const cv::Range& range) {
    for (std::size_t k = std::size_t(range.start); k < std::size_t(range.end); ++k) {
      each[k] = pairs_[k]->Above(strips, chain);
    }
  });
  std::vector<Sight> told;
  for (const auto& sight : each) {
    if (sight) {
      told.push_back(*sight);
    }
  }
  if (told.empty()) {
    return std::nullopt;
  }
  // What the way's error makes of each follows from what all say, or too low ones would weigh more.
  LineAbove above;
  double off = 0;
  for (int pass = 0; pass < 2; ++pass) {
    double weight = 0, mean = 0, square = 0;
    for (const Sight& sight : told) {
      const double px = pass == 0 ? sight.px : above.px;
      const double w = 1 / (sight.variance_px2 + Square(px) * sight.of_height2);
      weight += w;
      mean += w * sight.px;
      square += w * Square(sight.px);
    }
    above = {mean / weight, std::sqrt(1 / weight)};
    off = square - Square(mean) / weight;
  }
  // Views that contradict each other say less.
  if (told.size() > 1) {
    above.sigma_px *= std::sqrt(std::max(1.0, off / static_cast<double>(told.size() - 1)));
  }
  return above;
}

}  // namespace palace
