// Grain of every surface of the scene, shared by ground and objects.
//
// Three tiles carry the wavelengths 4 cm - 5 m, 1 cm - 8 cm and 2 mm - 16 mm. Their mip levels fade
// to the mean as a tile becomes finer than the pixel, so each height sees the same contrast. The two
// finer tiles are bent by a slow field of some centimetres, more than their own longest half wave:
// their repeats do not match one another.
uniform sampler2D coarse_tile;  // r grain, g cracks and patches
uniform sampler2D medium_tile;
uniform sampler2D fine_tile;
uniform sampler2D bend_tile;    // rg bend, b slow change of brightness
uniform float contrast;

const float kCoarsePeriod_m = 40.96;
const float kMediumPeriod_m = 5.12;
const float kFinePeriod_m = 1.024;
const float kBendPeriod_m = 53.0;
const float kBend_m = 0.30;
const float kBias = -0.35;  // sharper than the driver's choice: noise hides the aliasing

struct Grain {
  float detail;  // mean 0, in units of grey
  float marks;   // cracks and patches, -1 .. 1
  float slow;    // slow change, -1 .. 1
};

// footprint_m: side of the pixel on the surface. Where it is over 9 mm everywhere, the variant
// without the fine tile gives the same picture for less.
Grain GrainAt(vec2 p_m, float footprint_m) {
  vec3 bend = textureLod(bend_tile, p_m / kBendPeriod_m, 0.0).rgb;
  vec2 q = p_m + kBend_m * bend.rg;
  vec2 coarse = texture(coarse_tile, p_m / kCoarsePeriod_m, kBias).rg - 128.0 / 255.0;
  float medium =
      texture(medium_tile, mat2(0.8480, 0.5299, -0.5299, 0.8480) * q / kMediumPeriod_m, kBias).r -
      128.0 / 255.0;
#ifdef WITH_FINE_TILE
  float fine =
      texture(fine_tile, mat2(0.3420, 0.9397, -0.9397, 0.3420) * q / kFinePeriod_m, kBias).r -
      128.0 / 255.0;
  fine *= 1.0 - smoothstep(0.005, 0.009, footprint_m);
#else
  const float fine = 0.0;
#endif
  Grain grain;
  grain.detail = contrast * (0.95 * coarse.r + 0.85 * medium + 0.95 * fine);
  grain.marks = contrast * 2.0 * coarse.g;
  grain.slow = contrast * 2.0 * bend.b;
  return grain;
}
