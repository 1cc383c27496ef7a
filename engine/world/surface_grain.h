// Grain of what stands on the ground: one tile that both renderers read the same way.
#pragma once

#include <cstdint>
#include <vector>

namespace palace {

/// Three octaves of value noise from 16 cm down, repeated every 2.56 m.
class SurfaceGrain {
 public:
  static constexpr int kTexels = 256;
  static constexpr double kTexel_m = 0.01;
  static constexpr double kContrast = 0.35;  ///< albedo is multiplied by 1 + kContrast * grain

  explicit SurfaceGrain(std::uint64_t seed);
  /// -1 .. 1, bilinear between texels, texel (0, 0) at the place (0.5, 0.5) texels.
  double At(double u_m, double v_m) const;
  /// 128 + 127 * grain, row by row along v.
  const std::vector<std::uint8_t>& texels() const { return texels_; }

 private:
  std::vector<std::uint8_t> texels_;
};

}  // namespace palace
