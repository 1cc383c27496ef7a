#include "engine/experiments/heading_reference.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palace {
namespace {

constexpr int kSlices = 4000;

/// Very poor, poor, fair, good, very good: the greatest weight of a rule that says so.
using Weights = std::array<double, 5>;

double Centroid(const Weights& weights) {
  double area = 0, moment = 0;
  for (int slice = 0; slice < kSlices; ++slice) {
    const double y = (slice + 0.5) / kSlices;
    double highest = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const double off = std::abs(y - 0.25 * static_cast<double>(k));
      highest = std::max(highest, weights[k] * std::max(0.0, 1 - off / 0.25));
    }
    area += highest;
    moment += highest * y;
  }
  return moment / area;
}

/// 1 up to `full`, 0 from `none` on.
double UpTo(double x, double full, double none) {
  return std::clamp((none - x) / (none - full), 0.0, 1.0);
}
double From(double x, double none, double full) { return 1 - UpTo(x, none, full); }

double Between(double a_deg, double b_deg) { return std::abs(std::remainder(a_deg - b_deg, 360)); }

/// Between two directions, by the spherical law of cosines.
double Between(double azimuth1_deg, double up1_deg, double azimuth2_deg, double up2_deg) {
  const double cosine =
      std::sin(Rad(up1_deg)) * std::sin(Rad(up2_deg)) +
      std::cos(Rad(up1_deg)) * std::cos(Rad(up2_deg)) * std::cos(Rad(azimuth1_deg - azimuth2_deg));
  return Deg(std::acos(std::clamp(cosine, -1.0, 1.0)));
}

double Wind(double off_deg, double speed_mps) {
  const double head = UpTo(off_deg, 20, 50), tail = From(off_deg, 100, 130);
  const double cross = std::min(From(off_deg, 20, 50), UpTo(off_deg, 100, 130));
  const double calm = UpTo(speed_mps, 1.5, 3.5), strong = From(speed_mps, 6, 9);
  const double moderate = std::min(From(speed_mps, 1.5, 3.5), UpTo(speed_mps, 6, 9));
  const double very_good = std::max({calm, std::min(moderate, head), std::min(strong, head)});
  const double fair = std::min(moderate, cross);
  const double poor = std::max(std::min(moderate, tail), std::min(strong, cross));
  return Centroid({std::min(strong, tail), poor, fair, 0, very_good});
}

double Sun(double heading_deg, double depression_deg, double azimuth_deg, double up_deg) {
  const double flare_deg = Between(heading_deg, -depression_deg, azimuth_deg, up_deg);
  const double shadow_deg = Between(heading_deg, -depression_deg, azimuth_deg + 180, -up_deg);
  const double glint_deg = Between(heading_deg, -depression_deg, azimuth_deg, -up_deg);
  const double day = From(up_deg, -6, 2), night = 1 - day;
  const double near = UpTo(flare_deg, 30, 55), far = From(flare_deg, 75, 100);
  const double mid = std::min(From(flare_deg, 30, 55), UpTo(flare_deg, 75, 100));
  const double shadow = UpTo(shadow_deg, 12, 28), glint = UpTo(glint_deg, 12, 28);
  const double clear_day = std::min({day, 1 - shadow, 1 - glint});
  return Centroid({std::min(day, near), std::min(glint, 1 - near), std::min(shadow, 1 - near),
                   std::min(mid, clear_day), std::max(night, std::min(far, clear_day))});
}

double Orientation(double off_deg) {
  const double oblique = std::min(From(off_deg, 10, 40), UpTo(off_deg, 80, 110));
  return Centroid({0, From(off_deg, 80, 110), oblique, 0, UpTo(off_deg, 10, 40)});
}

double WindExponent(double speed_mps) {
  if (speed_mps < 3) {
    return 0.5;
  }
  return speed_mps > 8 ? 3 : 1.5;
}

}  // namespace

ReferenceScore ScoreByReference(const HeadingConditions& now, double heading_rad) {
  const double heading_deg = Deg(heading_rad);
  ReferenceScore score;
  double logarithm = 0, exponents = 0;
  const auto take = [&](double factor, double exponent) {
    logarithm += exponent * std::log(factor);
    exponents += exponent;
    return factor;
  };
  if (now.wind_mps >= 0 && std::isfinite(now.wind_from_rad)) {
    score.wind = take(Wind(Between(heading_deg, Deg(now.wind_from_rad)), now.wind_mps),
                      WindExponent(now.wind_mps));
  }
  if (std::isfinite(now.sun_azimuth_rad) && std::isfinite(now.sun_elevation_rad)) {
    score.sun = take(Sun(heading_deg, Deg(now.depression_rad), Deg(now.sun_azimuth_rad),
                         Deg(now.sun_elevation_rad)),
                     1);
  }
  if (std::isfinite(now.wanted_rad)) {
    score.orientation = take(Orientation(Between(heading_deg, Deg(now.wanted_rad))), 0.7);
  }
  score.combined = exponents > 0 ? std::exp(logarithm / exponents) : 1;
  return score;
}

}  // namespace palace
