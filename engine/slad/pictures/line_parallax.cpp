#include "engine/slad/pictures/line_parallax.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/core/utility.hpp>

#include "engine/slad/pictures/laid_view.h"
#include "engine/slad/pictures/thin_piece.h"

namespace palace {
namespace {

// The line itself.
constexpr int kAcross_px = 4;        // its profile reaches so far to both sides
constexpr double kMostUnlike = 0.3;  // of the profile's energy, what is left where it is found
constexpr double kTwice = 0.6;       // of that energy: found elsewhere with less left over
constexpr double kMatching_px = 0.1;
constexpr std::size_t kLeastPixels = 100;
constexpr double kLeastRows = 1e-3;  // a pixel of disparity

double Square(double x) { return x * x; }

/// Energy of a profile across a line: what the grey does over more than the line, a level and a
/// slope, is the ground's.
template <typename Grey>
double LeftOver(Grey&& grey_at) {
  double square = 0, sum = 0, slope = 0, arms = 0;
  for (int k = -kAcross_px; k <= kAcross_px; ++k) {
    const double grey = grey_at(static_cast<std::size_t>(k + kAcross_px));
    square += Square(grey);
    sum += grey;
    slope += k * grey;
    arms += k * k;
  }
  return square - Square(sum) / (2 * kAcross_px + 1) - Square(slope) / arms;
}

}  // namespace

/// The new view and an older one.
class LineParallax::Pair {
 public:
  Pair(const SceneView& view, const SceneGround& ground, std::shared_ptr<const ImageF> smooth,
       const OlderView& old)
      : laid_(view, ground, std::move(smooth), old),
        way_sigma_(std::hypot(view.range->pose->sigmas.position_m, old.pose.sigmas.position_m) /
                   view.range->baseline_m),
        turn_sigma_px_(
            std::hypot(view.range->pose->sigmas.attitude_rad, old.pose.sigmas.attitude_rad) *
            view.range->camera.fy_px) {}

  std::optional<Sight> Above(const MarkStrips& strips, const std::vector<LinePiece>& chain) const;

 private:
  /// A line's pixels on the ground, and how many rows a pixel of disparity lays it across.
  struct LaidLine {
    struct Pixel {
      int x, y;
      Eigen::Vector2d q;
    };
    std::vector<Pixel> pixels;
    double rows_a_px = 0;
    double rows_a_px_sigma = 0;
  };
  struct Aside {
    double rows = 0;
    double variance_px2 = 0;
  };

  std::optional<LaidLine> LayLine(const PictureLine& line,
                                  const LaidView::Registered& registered) const;
  std::optional<Aside> FindAgain(const LaidLine& line) const;

  LaidView laid_;
  double way_sigma_;      ///< of the way between the views, over the baseline
  double turn_sigma_px_;  ///< of the turn between them
};

std::optional<LineParallax::Pair::LaidLine> LineParallax::Pair::LayLine(
    const PictureLine& line, const LaidView::Registered& registered) const {
  LaidLine laid;
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();
  double ground_px = 0;
  for (const Eigen::Vector2d& p : line.pixels) {
    const int x = static_cast<int>(std::lround(p.x())), y = static_cast<int>(std::lround(p.y()));
    const auto ground = laid_.GroundAt(x, y);
    if (!ground || y < kAcross_px || y + kAcross_px >= laid_.now().height()) {
      continue;
    }
    const Eigen::Vector2d on_ground = laid_.InOld(x, y, *ground);
    const Eigen::Vector2d q = registered({0, on_ground + laid_.shift_px(), line.Along(x)});
    if (IsInside(laid_.old(), q, kMostAside_px + kAcross_px + 1)) {
      laid.pixels.push_back({x, y, q});
      moved += laid_.InOld(x, y, *ground + 1) - on_ground;
      ground_px += *ground;
    }
  }
  if (laid.pixels.size() < kLeastPixels) {
    return std::nullopt;
  }
  moved /= static_cast<double>(laid.pixels.size());
  ground_px /= static_cast<double>(laid.pixels.size());
  const Eigen::Vector2d run = laid.pixels.back().q - laid.pixels.front().q;
  if (std::abs(run.x()) < std::abs(run.y())) {
    return std::nullopt;
  }
  // By as many rows as the pose leaves over the ground itself was laid wrong: the turn, or the way,
  // whose part is that of its variance, and moves the line the more the nearer it is.
  const double by_way_px = way_sigma_ * ground_px;
  const double of_way =
      Square(by_way_px) / std::max(1e-12, Square(by_way_px) + Square(turn_sigma_px_));
  const double climb = run.y() / run.x();
  const Eigen::Vector2d left_px = laid_.shift_px() + registered.left_px.head<2>();
  laid.rows_a_px =
      moved.y() - moved.x() * climb + of_way * (left_px.y() - left_px.x() * climb) / ground_px;
  laid.rows_a_px_sigma = way_sigma_ * std::sqrt(1 - of_way);
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
      now[static_cast<std::size_t>(row + kAcross_px)] +=
          double{laid_.now().at(at.x, at.y + row)} / n;
    }
    for (int k = from - 1; k <= to + 1 + 2 * kAcross_px; ++k) {
      old[static_cast<std::size_t>(k)] +=
          GreyAt(laid_.old(), at.q + Eigen::Vector2d(0, k - kMostAside_px - kAcross_px)) / n;
    }
  }
  // What is left of the profile where it is laid over the older one, r rows aside.
  const double energy = LeftOver([&](std::size_t k) { return now[k]; });
  std::array<double, 2 * kMostAside_px + 1> left{};
  for (int r = from - 1; r <= to + 1; ++r) {
    const auto row = static_cast<std::size_t>(r);
    left[row] = LeftOver([&](std::size_t k) { return old[row + k] - now[k]; });
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
  const double noise2 = *best / static_cast<double>(now.size() - 3);
  return Aside{at - kMostAside_px + (before - after) / (2 * bend), 2 * noise2 / bend};
}

std::optional<LineParallax::Sight> LineParallax::Pair::Above(
    const MarkStrips& strips, const std::vector<LinePiece>& chain) const {
  const PictureLine line(strips, chain);
  const auto registered = laid_.Register(line);
  const auto laid = registered ? LayLine(line, *registered) : std::nullopt;
  const auto aside = laid ? FindAgain(*laid) : std::nullopt;
  if (!aside) {
    return std::nullopt;
  }
  const double found2 = aside->variance_px2 + Square(registered->sigma_px) + Square(kMatching_px);
  const double s2 = Square(laid->rows_a_px);
  return Sight{aside->rows / laid->rows_a_px, found2 / s2, Square(laid->rows_a_px_sigma) / s2};
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
