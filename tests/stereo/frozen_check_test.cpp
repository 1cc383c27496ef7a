// Frozen cameras: which one, through what noise, after how much motion; and live ones never.
#include "engine/stereo/frozen_check.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "engine/camera/pinhole.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "engine/world/ray_pictures.h"

namespace palace {
namespace {

constexpr double kHeight_m = 12;
constexpr double kBaseline_m = 0.5;
constexpr double kRate_hz = 10;
const PinholeCamera kCamera = PinholeFromFov(320, 240, Rad(45));

/// Where the camera is after t seconds.
using Motion = std::function<RigidTransform(double)>;

RigidTransform Nadir(double north_m, double height_m, double roll_rad) {
  return {RotationFromEuler({roll_rad, 0, 0}) * CameraRotationFromTilt(-std::numbers::pi / 2),
          {north_m, 0, -height_m}};
}

const Motion kStill = [](double) { return Nadir(0, kHeight_m, 0); };
const Motion kDescends = [](double t) { return Nadir(0.6 * t, kHeight_m - 0.6 * t, 0); };
const Motion kSways = [](double t) {
  return Nadir(0.15 * std::sin(0.7 * t), kHeight_m, Rad(1.5) * std::sin(2 * t));
};

void AddNoise(RandomStream& random, int most, ImageU8& picture) {
  for (std::uint8_t& grey : picture.pixels()) {
    grey = static_cast<std::uint8_t>(std::clamp(grey + random.Index(2 * most + 1) - most, 0, 255));
  }
}

World Over(GroundTexture texture) {
  World world;
  world.ground.texture = texture;
  world.solids = MakeTrafficCone(0.8, 0.6, 0.711);
  return world;
}

struct Film {
  explicit Film(GroundTexture texture)
      : world(Over(texture)),
        ground(BakeFor(world, kCamera,
                       {Nadir(-1, kHeight_m, 0.05), Nadir(3, kHeight_m, -0.05), Nadir(1, 8, 0)})) {}
  World world;
  BakedGround ground;
  /// Each place is drawn once; noise is new in every look.
  ImageU8 Look(const RigidTransform& X_WC, double noise_grey, std::uint64_t seed) const {
    Place place{};
    std::copy_n(X_WC.p.data(), 3, place.begin());
    std::copy_n(X_WC.R.data(), 9, place.begin() + 3);
    auto found = drawn.find(place);
    if (found == drawn.end()) {
      found = drawn.emplace(place, DrawGrey(world, kCamera, X_WC, ground)).first;
    }
    return Expose(found->second, {noise_grey}, seed);
  }
  using Place = std::array<double, 12>;
  mutable std::map<Place, ImageF> drawn{};
};

struct Fault {
  bool left = false, right = false;
  int noise_grey = 0;  ///< on every pixel of a frozen picture
  bool one_pixel = false;
};

/// Seconds of 3 after which three pairs in a row called each camera frozen; NaN: never.
struct Named {
  double left_s = NAN, right_s = NAN;
};

/// `told`: where the vehicle says the camera is; it differs from where it is by less than 3 sigma.
Named Watch(const Film& film, const Motion& motion, const Fault& fault, double noise_grey,
            const Motion& told = nullptr, double sigma_p_m = 0) {
  FrozenCheck check;
  RandomStream random(5);
  Named named;
  int left_run = 0, right_run = 0;
  std::optional<ImageU8> left_kept, right_kept;
  for (int i = 0; i < 40; ++i) {
    const double t = i / kRate_hz - 1;  // the fault begins at 0
    const RigidTransform X_WC = motion(t);
    RigidTransform X_WRight = X_WC;
    X_WRight.p += X_WC.R.col(0) * kBaseline_m;
    const auto seed = static_cast<std::uint64_t>(i);
    ImageU8 left = film.Look(X_WC, noise_grey, 2 * seed);
    ImageU8 right = film.Look(X_WRight, noise_grey, 2 * seed + 1);
    const auto freeze = [&](bool frozen, ImageU8& picture, std::optional<ImageU8>& kept) {
      if (!frozen || t < 0) {
        return;
      }
      kept = kept ? *kept : picture;
      picture = *kept;
      AddNoise(random, fault.noise_grey, picture);
      if (fault.one_pixel) {
        picture.at(9, 9) = static_cast<std::uint8_t>(random.Index(256));
      }
    };
    freeze(fault.left, left, left_kept);
    freeze(fault.right, right, right_kept);
    const FrozenCameras frozen = check.Add({.time = AddSeconds({}, t + 10),
                                            .left = std::make_shared<ImageU8>(left),
                                            .right = std::make_shared<ImageU8>(right),
                                            .X_WC = told ? told(t) : X_WC,
                                            .camera = kCamera,
                                            .depth_m = -X_WC.p.z(),
                                            .sigma_p_m = sigma_p_m});
    left_run = frozen.left ? left_run + 1 : 0;
    right_run = frozen.right ? right_run + 1 : 0;
    named.left_s = left_run == 3 && std::isnan(named.left_s) ? t : named.left_s;
    named.right_s = right_run == 3 && std::isnan(named.right_s) ? t : named.right_s;
  }
  return named;
}

TEST(FrozenCheck, ALiveCameraIsNeverFrozen) {
  for (const GroundTexture texture : {GroundTexture::kGrass, GroundTexture::kAsphalt}) {
    const Film film(texture);
    for (const double noise_grey : {0.5, 2.0}) {
      for (const Motion& motion : {kStill, kDescends, kSways}) {
        const Named named = Watch(film, motion, {}, noise_grey);
        EXPECT_TRUE(std::isnan(named.left_s)) << NameOf(texture) << " noise " << noise_grey;
        EXPECT_TRUE(std::isnan(named.right_s)) << NameOf(texture) << " noise " << noise_grey;
      }
    }
  }
}

// A hover without wind under GPS: the estimate wanders by two feet, the picture stands.
TEST(FrozenCheck, AnEstimateThatWandersMakesNoPictureFrozen) {
  const Motion wanders = [](double t) { return Nadir(0.6 * std::sin(2 * t), kHeight_m, 0); };
  const Named named = Watch(Film(GroundTexture::kGrass), kStill, {}, 1, wanders, /*sigma_p_m=*/0.5);
  EXPECT_TRUE(std::isnan(named.left_s) && std::isnan(named.right_s));
}

TEST(FrozenCheck, NamesTheFrozenCameraThroughNoise) {
  struct Row {
    const char* name;
    Motion motion;
    Fault fault;
    double within_s;
  };
  const std::pair<GroundTexture, Film> films[] = {
      {GroundTexture::kGravel, Film(GroundTexture::kGravel)},
      {GroundTexture::kAsphalt, Film(GroundTexture::kAsphalt)}};
  for (const Row& row :
       {Row{"left, still", kStill, {.left = true}, 0.5},
        Row{"right, still", kStill, {.right = true}, 0.5},
        Row{"both, one pixel, still",
            kStill,
            {.left = true, .right = true, .one_pixel = true},
            0.5},
        Row{"left, one pixel, descent", kDescends, {.left = true, .one_pixel = true}, 0.5},
        Row{"both, noise, descent", kDescends, {.left = true, .right = true, .noise_grey = 1}, 1.5},
        Row{"right, noise, descent", kDescends, {.right = true, .noise_grey = 1}, 1.5},
        Row{"right, noise of 2, descent", kDescends, {.right = true, .noise_grey = 2}, 1.5},
        Row{"left, noise, swaying", kSways, {.left = true, .noise_grey = 1}, 2.9}}) {
    for (const auto& [texture, film] : films) {
      SCOPED_TRACE(std::string(row.name) + " over " + NameOf(texture));
      const Named named = Watch(film, row.motion, row.fault, 1);
      for (const auto& [struck, at_s] :
           {std::pair{row.fault.left, named.left_s}, {row.fault.right, named.right_s}}) {
        EXPECT_EQ(struck, std::isfinite(at_s));
        EXPECT_TRUE(!struck || at_s <= row.within_s) << at_s;
      }
    }
  }
}

TEST(FrozenCheck, ShiftOfTheGroundIsThatOfThePlane) {
  const double f = kCamera.fx_px;
  EXPECT_NEAR(MeanShift_px(kCamera, 10, Nadir(0, 10, 0), Nadir(0.5, 10, 0)), f * 0.05, 1e-6);
  EXPECT_NEAR(MeanShift_px(kCamera, 10, Nadir(0, 10, 0), Nadir(0, 10, 0)), 0, 1e-9);
  EXPECT_NEAR(MeanShift_px(kCamera, 10, Nadir(0, 10, 0), Nadir(0, 10, Rad(1))), f * Rad(1), 0.6);
}

}  // namespace
}  // namespace palace
