#include "engine/experiments/occluder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palace {
namespace {

using Eigen::Vector2d;

constexpr double kBirdGrey = 28, kBlackGrey = 8, kHandGrey = 150, kHandShade = 30;
constexpr double kShadow = 0.5, kShadowEdge_px = 30, kShadowHalf_px = 150;
constexpr double kEdge_px = 2;
constexpr int kHandComes = 4;

/// 0 outside to 1 inside, over so many pixels about the edge; `inside_px` negative outside.
double Cover(double inside_px, double edge_px) {
  const double t = std::clamp(0.5 + inside_px / edge_px, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// About how far the place lies inside an ellipse with these half axes.
double InsideEllipse(const Vector2d& p, const Vector2d& half) {
  const double r = p.cwiseQuotient(half).norm();
  return (1 - r) * half.minCoeff();
}

double InsideCapsule(const Vector2d& p, const Vector2d& from, const Vector2d& to, double radius) {
  const Vector2d along = to - from;
  const double t = std::clamp((p - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return radius - (p - from - t * along).norm();
}

/// paint(pixel, grey): the new grey.
template <typename Shade>
void ForEachPixel(ImageF& grey, Shade shade) {
  for (int y = 0; y < grey.height(); ++y) {
    for (int x = 0; x < grey.width(); ++x) {
      grey.at(x, y) = static_cast<float>(shade(Vector2d(x, y), double(grey.at(x, y))));
    }
  }
}

double Mixed(double under, double over, double cover) { return under + cover * (over - under); }

}  // namespace

const char* NameOf(OccluderKind kind) {
  switch (kind) {
    case OccluderKind::kNone:
      return "none";
    case OccluderKind::kBird:
      return "bird";
    case OccluderKind::kHand:
      return "hand";
    case OccluderKind::kShadow:
      return "shadow";
    case OccluderKind::kBlack:
      return "black";
  }
  return "";
}

int PicturesOf(OccluderKind kind) {
  return kind == OccluderKind::kBlack ? 15 : kind == OccluderKind::kShadow ? 45 : 30;
}

Occluder::Occluder(OccluderKind kind, std::uint64_t seed) : kind_(kind) {
  RandomStream random(seed, NameOf(kind));
  const double angle_rad = random.Uniform(0, 2 * std::numbers::pi);
  way_ = {std::cos(angle_rad), std::sin(angle_rad)};
  size_ = random.Uniform();
  phase_rad_ = random.Uniform(0, 2 * std::numbers::pi);
}

void Occluder::Paint(int picture, const Vector2d& pixel, ImageF& grey) const {
  switch (kind_) {
    case OccluderKind::kNone:
      return;
    case OccluderKind::kBird:
      return PaintBird(picture, pixel, grey);
    case OccluderKind::kHand:
      return PaintHand(picture, pixel, grey);
    case OccluderKind::kShadow:
      return PaintShadow(picture, pixel, grey);
    case OccluderKind::kBlack:
      return ForEachPixel(grey, [](const Vector2d&, double) { return kBlackGrey; });
  }
}

void Occluder::PaintBird(int picture, const Vector2d& pixel, ImageF& grey) const {
  constexpr double kWay_px = 900;  // from beyond one edge to beyond the other
  const double along_px = kWay_px * ((picture + 0.5) / pictures() - 0.5);
  const Vector2d middle = pixel + along_px * way_;
  const double length_px = 45 + 30 * size_;
  // Wings beat: it is narrow and wide in turn.
  const Vector2d half(length_px, length_px * (0.6 + 0.3 * std::sin(1.3 * picture + phase_rad_)));
  ForEachPixel(grey, [&](const Vector2d& p, double under) {
    const Vector2d off = p - middle;
    const Vector2d own(off.dot(way_), way_.x() * off.y() - way_.y() * off.x());
    const double body = kBirdGrey + 8 * std::sin(0.2 * own.x()) * std::cos(0.3 * own.y());
    return Mixed(under, body, Cover(InsideEllipse(own, half), kEdge_px));
  });
}

void Occluder::PaintHand(int picture, const Vector2d& pixel, ImageF& grey) const {
  const int from_end = std::min(picture, pictures() - 1 - picture);
  const double away_px = 500.0 * std::max(0, kHandComes - from_end) / (kHandComes + 1);
  const Vector2d tremble(6 * std::sin(0.7 * picture + phase_rad_), 5 * std::sin(0.9 * picture));
  const Vector2d middle = pixel + away_px * way_ + tremble;
  const Vector2d half(200 + 60 * size_, 150 + 50 * size_);
  ForEachPixel(grey, [&](const Vector2d& p, double under) {
    const Vector2d off = p - middle;
    const Vector2d own(off.dot(way_), way_.x() * off.y() - way_.y() * off.x());
    double inside_px = InsideEllipse(own, half);
    for (const double side : {-0.6, 0.0, 0.6}) {
      const Vector2d knuckle(-0.7 * half.x(), side * half.y());
      const Vector2d tip(-1.7 * half.x(), 1.2 * side * half.y());
      inside_px = std::max(inside_px, InsideCapsule(own, knuckle, tip, 0.18 * half.y()));
    }
    const double skin =
        kHandGrey + kHandShade * std::cos(own.x() / 150 + phase_rad_) * std::cos(own.y() / 110);
    return Mixed(under, skin, Cover(inside_px, kEdge_px));
  });
}

void Occluder::PaintShadow(int picture, const Vector2d& pixel, ImageF& grey) const {
  constexpr double kWay_px = 1300;
  const double along_px = kWay_px * ((picture + 0.5) / pictures() - 0.5);
  ForEachPixel(grey, [&](const Vector2d& p, double under) {
    const double inside_px = kShadowHalf_px - std::abs((p - pixel).dot(way_) - along_px);
    return under * (1 - (1 - kShadow) * Cover(inside_px, kShadowEdge_px));
  });
}

}  // namespace palace
