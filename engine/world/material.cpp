#include "engine/world/material.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palace {

double MeanGrey(GroundTexture texture) {
  switch (texture) {
    case GroundTexture::kCloud:
      return 128;
    case GroundTexture::kGravel:
      return 114.5;
    case GroundTexture::kGrass:
      return 100;
    case GroundTexture::kAsphalt:
      return 106;
    case GroundTexture::kSoil:
      return 97;
    case GroundTexture::kSand:
      return 168;
    case GroundTexture::kSnow:
      return 226;
    case GroundTexture::kConcrete:
      return 156;
    case GroundTexture::kWater:
      return 78;
    case GroundTexture::kPaint:
      return 199;
  }
  return 128;
}

bool GroundPatch::Contains(double north_m, double east_m) const {
  bool inside = false;
  for (std::size_t i = 0, j = outline_m.size() - 1; i < outline_m.size(); j = i++) {
    const Eigen::Vector2d &a = outline_m[i], &b = outline_m[j];
    if ((a.y() > east_m) != (b.y() > east_m) &&
        north_m < a.x() + (b.x() - a.x()) * (east_m - a.y()) / (b.y() - a.y())) {
      inside = !inside;
    }
  }
  return inside;
}

GroundPatch DiscPatch(double north_m, double east_m, double radius_m, const Material& material) {
  constexpr int kCorners = 32;
  GroundPatch patch{{}, material};
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    patch.outline_m.emplace_back(north_m + radius_m * std::cos(angle),
                                 east_m + radius_m * std::sin(angle));
  }
  return patch;
}

GroundPatch StripPatch(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m, double width_m,
                       const Material& material) {
  const Eigen::Vector2d along = (to_m - from_m).normalized();
  const Eigen::Vector2d across = 0.5 * width_m * Eigen::Vector2d(-along.y(), along.x());
  return {{from_m - across, to_m - across, to_m + across, from_m + across}, material};
}

MaterialPainter::MaterialPainter(const Material& material)
    : material_(material),
      painter_(material.texture, material.seed),
      cos_(std::cos(material.turn_rad) / material.scale),
      sin_(std::sin(material.turn_rad) / material.scale) {}

double MaterialPainter::Albedo(double north_m, double east_m) {
  const double grey = painter_.Grey(cos_ * north_m + sin_ * east_m, cos_ * east_m - sin_ * north_m);
  const double own = MeanGrey(material_.texture);
  const double mean = std::isnan(material_.albedo) ? own : 255 * material_.albedo;
  return std::clamp((mean + material_.contrast * (grey - own)) / 255, 0.0, 1.0);
}

}  // namespace palace
