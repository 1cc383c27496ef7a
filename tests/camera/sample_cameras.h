// Cameras of every family, constructed at random within what real lenses do.
#pragma once

#include <string>

#include "engine/camera/cahvor.h"
#include "engine/camera/camera_model.h"
#include "engine/camera/tsai.h"
#include "engine/core/frames.h"
#include "engine/core/random.h"

namespace palace {

inline Eigen::Vector3d RandomVector(RandomStream& random, double size) {
  return {random.Uniform(-size, size), random.Uniform(-size, size), random.Uniform(-size, size)};
}

inline Eigen::Matrix3d RandomRotation(RandomStream& random) {
  return RotationFromEuler(
      {random.Uniform(-3, 3), random.Uniform(-1.5, 1.5), random.Uniform(-3, 3)});
}

/// 640 x 480 within a few per cent, rows and columns up to 2 degrees off the perpendicular.
inline CahvorModel RandomCahv(RandomStream& random, double focal_px) {
  PinholeCamera camera{640, 480, focal_px, focal_px * random.Uniform(0.95, 1.05), 0, 0};
  camera.cx_px = 320 + random.Uniform(-20, 20);
  camera.cy_px = 240 + random.Uniform(-20, 20);
  CahvorModel model = CahvFromPinhole(camera, RandomRotation(random), RandomVector(random, 5));
  model.V += random.Uniform(-0.035, 0.035) * (model.H - model.A.dot(model.H) * model.A);
  return model;
}

inline CahvorModel RandomCahvor(RandomStream& random, double focal_px = 700) {
  CahvorModel model = RandomCahv(random, focal_px);
  model.O = (model.A + RandomVector(random, 0.01)).normalized();
  model.R = {random.Uniform(-0.002, 0.002), random.Uniform(-0.3, 0.3), random.Uniform(0, 0.15)};
  return model;
}

inline CahvoreModel RandomCahvore(RandomStream& random, double linearity) {
  CahvoreModel model;
  model.base = RandomCahvor(random, linearity > 0.5 ? 500 : 300);
  model.base.R = {random.Uniform(-0.01, 0.01), random.Uniform(-0.02, 0.02),
                  random.Uniform(-0.01, 0.01)};
  model.E = RandomVector(random, 0.003);
  model.linearity = linearity;
  return model;
}

inline TsaiModel RandomTsai(RandomStream& random) {
  TsaiModel model;
  model.width = 640;
  model.height = 480;
  model.sensor_columns = model.frame_columns = 640;
  model.dx = model.dy = model.dpx = model.dpy = 0.0098;
  model.Cx_px = 320 + random.Uniform(-10, 10);
  model.Cy_px = 240 + random.Uniform(-10, 10);
  model.sx = random.Uniform(0.98, 1.02);
  model.f = random.Uniform(5, 12);
  model.kappa1 = random.Uniform(-0.004, 0.004);
  model.T = RandomVector(random, 1000);
  SetRotationOfTsai(model, RandomRotation(random));
  return model;
}

/// `coefficients`: 0 4 5 8 12 14; -4 for the fisheye.
inline OpenCvModel RandomOpenCv(RandomStream& random, int coefficients) {
  OpenCvModel model;
  model.pinhole = {640, 480, 600, 605, 320 + random.Uniform(-9, 9), 240 + random.Uniform(-9, 9)};
  model.R_CF = RandomRotation(random);
  model.t_CF = RandomVector(random, 2);
  const double size[] = {0.2,  0.1,  0.002, 0.002, 0.05,  0.1,  0.05,
                         0.02, 0.01, 0.005, 0.01,  0.005, 0.02, 0.02};
  if (coefficients < 0) {
    model.lens = OpenCvLens::kFisheye;
    model.coefficients = 4;
    model.pinhole.fx_px = model.pinhole.fy_px = 220;
    for (std::size_t i = 0; i < 4; ++i) {
      model.k[i] = random.Uniform(-0.02, 0.02);
    }
    return model;
  }
  model.coefficients = coefficients;
  for (std::size_t i = 0; i < static_cast<std::size_t>(coefficients); ++i) {
    model.k[i] = random.Uniform(-size[i], size[i]);
  }
  return model;
}

constexpr int kFamilies = 14;

/// One of `kFamilies` families.
inline CameraModel RandomCamera(RandomStream& random, int family) {
  switch (family) {
    case 0:
      return {RandomCahv(random, 700)};
    case 1:
      return {RandomCahvor(random)};
    case 2:
      return {RandomCahvore(random, 1)};
    case 3:
      return {RandomCahvore(random, 0)};
    case 4:
      return {RandomCahvore(random, 0.37)};
    case 5:
      return {RandomCahvore(random, -0.5)};
    case 6:
      return {RandomTsai(random), 0.001};
    case 13:
      return {RandomOpenCv(random, -4)};
    default: {
      const int coefficients[] = {0, 4, 5, 8, 12, 14};
      return {RandomOpenCv(random, coefficients[family - 7])};
    }
  }
}

}  // namespace palace
