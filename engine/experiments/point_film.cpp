#include "engine/experiments/point_film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/camera/pinhole.h"
#include "engine/core/check.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/tracking/template_selection.h"
#include "engine/world/ray_pictures.h"

namespace palace {
namespace {

constexpr double kTilt_rad = -45 * kRadPerDeg;
constexpr double kHoverHeight_m = 15.24;
constexpr double kSway_m = 0.05;
constexpr double kLeastMotion_px = 2, kMostMotion_px = 5;
constexpr double kLowest_hz = 0.5, kHighest_hz = 1.2;
constexpr double kPositionDrift_m = 0.5;
constexpr double kAttitudeError_rad = 0.1 * kRadPerDeg;
constexpr double kRangeSigma = 0.005;
constexpr int kSelectionReach_px = 20;

/// A sum of sines with an amplitude of about 1.
class Wave {
 public:
  Wave(RandomStream& random, double lowest_hz, double highest_hz) {
    for (Sine& sine : sines_) {
      sine.amplitude = random.Uniform(0.3, 0.7);
      sine.rate_rad_s = 2 * std::numbers::pi * random.Uniform(lowest_hz, highest_hz);
      sine.phase_rad = random.Uniform(0, 2 * std::numbers::pi);
    }
  }
  double At(double time_s) const {
    double sum = 0;
    for (const Sine& sine : sines_) {
      sum += sine.amplitude * std::sin(sine.rate_rad_s * time_s + sine.phase_rad);
    }
    return sum;
  }

 private:
  struct Sine {
    double amplitude = 0, rate_rad_s = 0, phase_rad = 0;
  };
  std::array<Sine, 2> sines_;
};

struct Waves {
  Wave x, y, z;
  Waves(RandomStream& random, double lowest_hz, double highest_hz)
      : x(random, lowest_hz, highest_hz),
        y(random, lowest_hz, highest_hz),
        z(random, lowest_hz, highest_hz) {}
  Eigen::Vector3d At(double time_s) const { return {x.At(time_s), y.At(time_s), z.At(time_s)}; }
};

double TimeOf(int picture) { return picture / kFilmRate_hz; }

Eigen::Matrix3d Turned(const Eigen::Vector3d& roll_pitch_yaw_rad) {
  return RotationFromEuler(
      {roll_pitch_yaw_rad.x(), roll_pitch_yaw_rad.y(), roll_pitch_yaw_rad.z()});
}

/// Camera on its way to the point p_WP.
std::vector<RigidTransform> FlyTo(const Eigen::Vector3d& p_WP, const FilmOptions& options,
                                  const Waves& attitude, const Waves& sway, double turn_rad) {
  const bool hover = options.flight == FilmFlight::kHover;
  const double start_m = hover ? kHoverHeight_m : options.start_m;
  const double end_m = hover ? kHoverHeight_m : options.end_m;
  // The slope begins over a place that does not depend on the point.
  const Eigen::Vector3d start_W(-start_m, 0, -start_m);
  std::vector<RigidTransform> poses;
  for (int i = 0; i < options.pictures; ++i) {
    const double share = static_cast<double>(i) / std::max(options.pictures - 1, 1);
    const double left = 1 - share * (1 - end_m / start_m);
    RigidTransform X_WC;
    X_WC.R = Turned(turn_rad * attitude.At(TimeOf(i))) * CameraRotationFromTilt(kTilt_rad);
    X_WC.p = p_WP + left * (start_W - p_WP) + kSway_m * sway.At(TimeOf(i));
    poses.push_back(X_WC);
  }
  return poses;
}

Eigen::Vector2d PixelOf(const PinholeCamera& camera, const RigidTransform& X_WC,
                        const Eigen::Vector3d& p_W) {
  const auto pixel = ProjectPinhole(camera, X_WC.Inverse() * p_W);
  PALACE_CHECK(pixel.has_value());
  return *pixel;
}

double MeanStep(const PinholeCamera& camera, const std::vector<RigidTransform>& poses,
                const Eigen::Vector3d& p_WP) {
  double sum_px = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    sum_px += (PixelOf(camera, poses[i], p_WP) - PixelOf(camera, poses[i - 1], p_WP)).norm();
  }
  return sum_px / static_cast<double>(std::max<std::size_t>(poses.size() - 1, 1));
}

/// The amplitude of attitude that moves the point by `motion_px` a picture in the mean.
double TurnFor(double motion_px, const PinholeCamera& camera, const FilmOptions& options,
               const Waves& attitude, const Waves& sway) {
  double low_rad = 0, high_rad = Rad(20);
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low_rad + high_rad);
    const Eigen::Vector3d target = Eigen::Vector3d::Zero();
    const double step_px = MeanStep(camera, FlyTo(target, options, attitude, sway, middle), target);
    (step_px < motion_px ? low_rad : high_rad) = middle;
  }
  return low_rad;
}

}  // namespace

const char* NameOf(FilmFlight flight) {
  return flight == FilmFlight::kDescent ? "descent" : "hover";
}

PointFilm::PointFilm(const GroundPyramid& ground, const FilmOptions& options, std::uint64_t seed)
    : ground_(ground),
      camera_(PinholeFromFov(options.width_px, options.height_px, Rad(45))),
      seed_(seed) {
  PALACE_CHECK(options.pictures > 0 && options.start_m > 0 && options.end_m > 0, options.pictures);
  RandomStream random(seed, "point film");
  const Waves attitude(random, kLowest_hz, kHighest_hz), sway(random, 0.1, 0.3);
  const Waves drift(random, 0.03, 0.06), error(random, 0.05, 0.1);
  const double wanted_px = random.Uniform(kLeastMotion_px, kMostMotion_px);
  const double turn_rad = TurnFor(wanted_px, camera_, options, attitude, sway);

  X_WCs_ = FlyTo(p_WP_, options, attitude, sway, turn_rad);
  const Eigen::Vector2d end_px = PixelOf(camera_, X_WCs_.front(), p_WP_);
  const ImageU8 first = Exposed(Grey(0), Noise(0));
  ImageU8 mask(camera_.width, camera_.height);
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      mask.at(x, y) = (Eigen::Vector2d(x, y) - end_px).cwiseAbs().maxCoeff() <= kSelectionReach_px;
    }
  }
  const std::vector<TemplateFeature> best = SelectTemplates(first, {.max_count = 1}, mask);
  selection_refused_ = best.empty();
  if (!best.empty()) {
    const Eigen::Vector3d ray_W = X_WCs_.front().R * RayFromPixel(camera_, best.front().pixel);
    p_WP_ = X_WCs_.front().p - X_WCs_.front().p.z() / ray_W.z() * ray_W;
    X_WCs_ = FlyTo(p_WP_, options, attitude, sway, turn_rad);
  }
  motion_px_ = MeanStep(camera_, X_WCs_, p_WP_);

  for (int i = 0; i < options.pictures; ++i) {
    RigidTransform X_WC = X_WCs_[static_cast<std::size_t>(i)];
    X_WC.p += kPositionDrift_m * (drift.At(TimeOf(i)) - drift.At(0));
    X_WC.R = Turned(kAttitudeError_rad * error.At(TimeOf(i))) * X_WC.R;
    believed_X_WCs_.push_back(X_WC);
  }
  const Eigen::Vector3d p_CP = X_WCs_.front().Inverse() * p_WP_;
  believed_p_WP_ = believed_X_WCs_.front() * ((1 + kRangeSigma * random.Normal()) * p_CP);
}

ImageF PointFilm::Grey(int picture) const {
  return ground_.Picture(camera_, X_WCs_[static_cast<std::size_t>(picture)]);
}

ImageF PointFilm::Noise(int picture) const {
  constexpr float kMiddle = 128;
  RandomStream random(seed_, "sensor");
  const std::uint64_t stream = random.NextBits() + static_cast<std::uint64_t>(picture);
  const ImageU8 noisy =
      Expose(ImageF(camera_.width, camera_.height, kMiddle), Exposure{kFilmNoise_grey}, stream);
  ImageF noise(camera_.width, camera_.height);
  for (std::size_t k = 0; k < noise.pixels().size(); ++k) {
    noise.pixels()[k] = static_cast<float>(noisy.pixels()[k]) - kMiddle;
  }
  return noise;
}

Eigen::Vector2d PointFilm::Truth(int picture) const {
  return PixelOf(camera_, X_WCs_[static_cast<std::size_t>(picture)], p_WP_);
}

const RigidTransform& PointFilm::Believed(int picture) const {
  return believed_X_WCs_[static_cast<std::size_t>(picture)];
}

ImageU8 Exposed(const ImageF& grey, const ImageF& noise) {
  PALACE_CHECK(grey.width() == noise.width() && grey.height() == noise.height());
  ImageU8 picture(grey.width(), grey.height());
  for (std::size_t k = 0; k < picture.pixels().size(); ++k) {
    const float level = std::clamp(grey.pixels()[k] + noise.pixels()[k], 0.0F, 255.0F);
    picture.pixels()[k] = static_cast<std::uint8_t>(level + 0.5F);
  }
  return picture;
}

}  // namespace palace
