#include "gui/render/noise_texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/check.h"

namespace palace {
namespace {

/// Sum of four uniform numbers: near enough to a normal one, and quick.
float QuickNormal(RandomStream& random) {
  const std::uint64_t bits = random.NextBits();
  const std::uint64_t sum =
      (bits & 0xFFFF) + ((bits >> 16) & 0xFFFF) + ((bits >> 32) & 0xFFFF) + (bits >> 48);
  constexpr float kScale = 1.7320508F / 65536.0F;
  return (static_cast<float>(sum) - 131070.0F) * kScale;
}

/// One row or column of cubic B-spline subdivision with wrap-around: even samples (1 6 1)/8, odd
/// samples (1 1)/2.
void Subdivide(const float* in, int count, int in_stride, float* out, int out_stride) {
  for (int i = 0; i < count; ++i) {
    const float before = in[((i + count - 1) % count) * in_stride];
    const float here = in[i * in_stride];
    const float after = in[((i + 1) % count) * in_stride];
    out[2 * i * out_stride] = (before + 6 * here + after) / 8;
    out[(2 * i + 1) * out_stride] = (here + after) / 2;
  }
}

/// Rows and then columns; the column pass runs along rows, so that memory is read in order.
ImageF Doubled(const ImageF& in) {
  const int n = in.width();
  ImageF wide(2 * n, n);
  for (int y = 0; y < n; ++y) {
    Subdivide(in.row(y), n, 1, wide.row(y), 1);
  }
  ImageF out(2 * n, 2 * n);
  for (int y = 0; y < n; ++y) {
    const float* before = wide.row((y + n - 1) % n);
    const float* here = wide.row(y);
    const float* after = wide.row((y + 1) % n);
    float* even = out.row(2 * y);
    float* odd = out.row(2 * y + 1);
    for (int x = 0; x < 2 * n; ++x) {
      even[x] = (before[x] + 6 * here[x] + after[x]) / 8;
      odd[x] = (here[x] + after[x]) / 2;
    }
  }
  return out;
}

void Normalise(ImageF& field) {
  double sum = 0, squares = 0;
  for (const float v : field.pixels()) {
    sum += v;
    squares += static_cast<double>(v) * v;
  }
  const double count = static_cast<double>(field.pixels().size());
  const double mean = sum / count;
  const double scale = 1 / std::sqrt(std::max(squares / count - mean * mean, 1e-12));
  for (float& v : field.pixels()) {
    v = static_cast<float>((v - mean) * scale);
  }
}

/// Brightness steps of rectangles cut out and filled again.
void AddPatches(ImageF& field, double texel_m, RandomStream& random) {
  const int size = field.width();
  const int count = static_cast<int>(size * texel_m * size * texel_m / 70);
  for (int i = 0; i < count; ++i) {
    const int x0 = random.Index(size), y0 = random.Index(size);
    const int width = static_cast<int>(random.Uniform(0.8, 4.0) / texel_m);
    const int height = static_cast<int>(random.Uniform(0.8, 3.0) / texel_m);
    const float step = static_cast<float>(random.Uniform(0.10, 0.26)) * (i % 3 == 0 ? 1.0F : -1.0F);
    const int seam = std::max(1, static_cast<int>(std::lround(0.03 / texel_m)));
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const bool rim = x < seam || y < seam || x >= width - seam || y >= height - seam;
        field.at((x0 + x) % size, (y0 + y) % size) = rim ? -0.45F : step;
      }
    }
  }
}

/// A walk that bends a little at each step and darkens what it crosses.
void AddCrack(ImageF& field, double x, double y, double heading, int steps, RandomStream& random) {
  const int size = field.width();
  const float depth = static_cast<float>(random.Uniform(-0.9, -0.45));
  double drift = 0;
  for (int i = 0; i < steps; ++i) {
    drift = 0.9 * drift + 0.12 * random.Normal();
    heading += 0.25 * drift;
    x += 0.7 * std::cos(heading);
    y += 0.7 * std::sin(heading);
    const int xi = ((static_cast<int>(std::floor(x)) % size) + size) % size;
    const int yi = ((static_cast<int>(std::floor(y)) % size) + size) % size;
    field.at(xi, yi) = std::min(field.at(xi, yi), depth);
    if (random.Uniform() < 0.35) {
      float& beside = field.at((xi + 1) % size, yi);
      beside = std::min(beside, 0.7F * depth);
    }
    if (steps > 120 && random.Uniform() < 0.006) {
      AddCrack(field, x, y, heading + random.Uniform(0.5, 1.3), steps / 3, random);
    }
  }
}

}  // namespace

ImageF TileableNoise(int size, const std::vector<float>& octave_weights, RandomStream& random) {
  const int coarsest = size >> (octave_weights.size() - 1);
  PALACE_CHECK(coarsest >= 4 && (size & (size - 1)) == 0, size, octave_weights.size());
  ImageF field(coarsest, coarsest);
  for (std::size_t level = 0; level < octave_weights.size(); ++level) {
    if (level > 0) {
      field = Doubled(field);
    }
    for (float& v : field.pixels()) {
      v += octave_weights[level] * QuickNormal(random);
    }
  }
  Normalise(field);
  return field;
}

ImageF AsphaltMarks(int size, double texel_m, RandomStream& random) {
  ImageF field(size, size);
  AddPatches(field, texel_m, random);
  const int cracks = static_cast<int>(size * texel_m * size * texel_m / 18);
  for (int i = 0; i < cracks; ++i) {
    const double heading = random.Uniform(0, 2 * std::numbers::pi);
    const int steps = static_cast<int>(random.Uniform(1.5, 9.0) / (0.7 * texel_m));
    AddCrack(field, random.Uniform(0, size), random.Uniform(0, size), heading, steps, random);
  }
  return field;
}

}  // namespace palace
