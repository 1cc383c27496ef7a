// Noise and exposure of a simulated camera: out = clamp(round(gain * ideal + sigma * n)), n
// standard normal per pixel. The normals come from a table of 65536 drawn once per camera, picked
// by 16 random bits a pixel: a picture costs microseconds per row instead of a logarithm per pixel.
#pragma once

#include <string_view>
#include <vector>

#include "engine/core/random.h"
#include "engine/model/image.h"

namespace palace {

class CameraNoise {
 public:
  CameraNoise(double sigma_grey, double gain, std::uint64_t seed, std::string_view name);
  void Apply(ImageU8& image);

 private:
  float gain_;
  RandomStream random_;
  std::vector<float> table_;  ///< sigma * n
};

}  // namespace palace
