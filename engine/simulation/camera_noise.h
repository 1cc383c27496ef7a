// What a sensor makes of the light on it:
//
//   grey = round(S + sqrt(255 S / full well) n1 + offset + sigma n2), held at 0 and 255
//
// with S = gain * light, and n1, n2 standard normal per pixel: shot noise is that of a count of
// electrons of which `full_well` make grey 255. The normals come from tables of 65536 drawn once
// per camera, picked by 16 random bits a pixel: a picture costs microseconds per row instead of a
// logarithm per pixel. Each noise has a stream of its own.
#pragma once

#include <string>
#include <vector>

#include "engine/core/random.h"
#include "engine/model/image.h"

namespace palace {

struct PixelResponse {
  double gain = 1;
  double offset_grey = 0;
  double read_noise_grey = 0;      ///< standard deviation
  double full_well_electrons = 0;  ///< 0: no shot noise
};

class CameraNoise {
 public:
  /// `name` of its streams: "camera left".
  CameraNoise(const PixelResponse& response, std::uint64_t seed, const std::string& name);
  ImageU8 Apply(const ImageF& light);

 private:
  PixelResponse response_;
  RandomStream random_;
  RandomStream shot_random_;
  std::vector<float> table_;       ///< sigma * n
  std::vector<float> shot_table_;  ///< n; empty without shot noise
};

}  // namespace palace
