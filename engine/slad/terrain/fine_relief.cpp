#include "engine/slad/terrain/fine_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/frames.h"
#include "engine/slad/side_by_side.h"
#include "engine/slad/terrain/laid_over.h"

namespace palace {
namespace {

constexpr float kGradientNoise = 0.30F;  // of e's variance, in g^2
constexpr float kAstray2 = 0.04F;        // px^2: a place's pixels scatter so about its one height
constexpr float kSpeck2 = 0.12F;         // of the square of h
constexpr int kOther_rows = 8;           // to the pixels whose gradients are asked beside
constexpr int kStripes = 4;              // summed one after the other

/// Grey a pixel, along the row.
float Gradient(const float* grey) {
  return (grey[-2] - grey[2] + 8 * (grey[1] - grey[-1])) * (1 / 12.0F);
}

/// q: what sampling makes of the pictures there, of the gradient along the row, grey^2.
float Sampled2(const float* grey, float gradient) {
  const float bend = (grey[-1] + grey[1]) / 2 - grey[0];  // h
  return kAstray2 * gradient * gradient + kSpeck2 * bend * bend;
}

}  // namespace

GridGeometry FineRelief::PlacesOf(const GridGeometry& map) {
  constexpr int kPerCell = NarrowFigures::kPerCell;
  return {map.rows * kPerCell, map.cols * kPerCell, map.cell_m / kPerCell, map.north_min_m,
          map.east_min_m};
}

void FineRelief::MoveTo(const GridGeometry& map) {
  const GridGeometry to = PlacesOf(map);
  seen_ = MovedTo(to, places_, seen_);
  places_ = to;
}

void FineRelief::AddRows(const RangeMap& range, const ImageU8& left, const LaidOver& laid,
                         const PlaneCorrection& off, int first, int end, Stripe& stripe) const {
  const RigidTransform& X_WC = range.pose->X_WC;
  const PinholeCamera& camera = range.camera;
  const auto focal_times_baseline = static_cast<float>(range.FocalTimesBaseline());
  const int width = left.width();
  const auto per_cell = static_cast<float>(1 / places_.cell_m);
  // Of a point at depth z along the ray (n, e, d): row, column and height are a + z b.
  const auto row_0 = static_cast<float>((places_.north_max_m() - X_WC.p.x()) / places_.cell_m);
  const auto col_0 = static_cast<float>((X_WC.p.y() - places_.east_min_m) / places_.cell_m);
  const auto height_0 = static_cast<float>(HeightFromDown(X_WC.p.z()) - reference_m_ -
                                           off.At(X_WC.p.x(), X_WC.p.y()));
  const auto north_tilt = static_cast<float>(off.north_tilt),
             east_tilt = static_cast<float>(off.east_tilt);
  const Eigen::Vector3f step_W = (X_WC.R.col(0) / camera.fx_px).cast<float>();
  int first_row = places_.rows, last_row = -1;
  for (int y = first; y < end; ++y) {
    const Eigen::Vector3f row_W = (X_WC.R * Eigen::Vector3d(-camera.cx_px / camera.fx_px,
                                                            (y - camera.cy_px) / camera.fy_px, 1))
                                      .cast<float>();
    const float *grey = laid.left.row(y),
                *other = laid.left.row(y + kOther_rows < left.height() ? y + kOther_rows
                                                                       : y - kOther_rows);
    const float *disparity = laid.disparity_px.row(y), *residual = laid.residual.row(y),
                *known = laid.known.row(y);
    const float* noise2 =
        laid.noise2.row(std::min(y / LaidOver::kPatch_px, laid.noise2.height() - 1));
    for (int x = 2; x < width - 2; ++x) {
      if (known[x] == 0) {
        continue;
      }
      const float d = disparity[x], depth_m = focal_times_baseline / d;
      const auto u = static_cast<float>(x);
      const float north = row_W.x() + u * step_W.x(), east = row_W.y() + u * step_W.y(),
                  down = row_W.z() + u * step_W.z();
      const float row = row_0 - depth_m * north * per_cell, col = col_0 + depth_m * east * per_cell;
      if (!(down > 0 && row >= 0 && col >= 0 && row < static_cast<float>(places_.rows) &&
            col < static_cast<float>(places_.cols))) {
        continue;
      }
      const float height_m = height_0 - depth_m * (down + north_tilt * north + east_tilt * east);
      const float per_pixel_m = down * depth_m / d;  // k
      const float s2 = noise2[std::min(x / LaidOver::kPatch_px, laid.noise2.width() - 1)];
      const float g = Gradient(grey + x), c = Gradient(other + x), e = residual[x];
      const float weight = 1 / (per_pixel_m * per_pixel_m * s2);
      const float net = (g * g - kGradientNoise * s2) * weight;
      const float answer = -e * g * weight * per_pixel_m;
      using P = FinePlace;
      const Cell place{static_cast<int>(row), static_cast<int>(col)};
      first_row = std::min(first_row, place.row);
      last_row = std::max(last_row, place.row);
      auto& of = stripe.places.at(place).of;
      of[P::kNet] += net;
      of[P::kGross] += g * g * weight;
      of[P::kHeight] += height_m * net + answer;
      of[P::kOff] += answer;
      of[P::kOtherGross] += c * c * weight;
      of[P::kOther] -= e * c * weight * per_pixel_m;
      of[P::kShared] += g * c * weight;
      const float sampled2 = Sampled2(grey + x, g);
      of[P::kEnergy] += e * e / (s2 + sampled2);
      of[P::kSampled] += sampled2 / (s2 + sampled2);
      of[P::kPixels] += 1;
    }
  }
  stripe.first_row = first_row;
  stripe.end_row = last_row + 1;
}

void FineRelief::TakeRow(int row, float remember) {
  for (int col = 0; col < places_.cols; ++col) {
    FinePlace now;
    for (Stripe& stripe : stripes_) {
      if (row < stripe.first_row || row >= stripe.end_row) {
        continue;
      }
      FinePlace& told = stripe.places.at(row, col);
      for (std::size_t k = 0; k < now.of.size(); ++k) {
        now.of[k] += told.of[k];
      }
      told = {};
    }
    // What this frame does not see stays as it is.
    if (now.of[FinePlace::kGross] > 0) {
      auto& all = seen_.at(row, col).of;
      for (std::size_t k = 0; k < all.size(); ++k) {
        all[k] = remember * all[k] + now.of[k];
      }
    }
  }
}

void FineRelief::Add(const RangeMap& range, const ImageU8& left, const ImageU8& right,
                     const PlaneCorrection& off, int memory) {
  PALACE_CHECK(range.pose.has_value());
  if (left.width() < kLeastPicture_px || left.height() < kLeastPicture_px) {
    return;
  }
  const LaidOver laid = LayOver(left, right, range.disparity_px);
  if (frames_ == 0) {
    // About the ground's, so that floats keep their digits.
    reference_m_ = HeightFromDown(range.pose->X_WC.p.z());
  }
  if (stripes_.empty() || stripes_[0].places.rows() != places_.rows ||
      stripes_[0].places.cols() != places_.cols) {
    stripes_.assign(kStripes, {Grid<FinePlace>(places_.rows, places_.cols)});
  }
  ForEach(kStripes, [&](int k) {
    AddRows(range, left, laid, off, left.height() * k / kStripes,
            left.height() * (k + 1) / kStripes, stripes_[static_cast<std::size_t>(k)]);
  });
  const float remember = frames_ < memory ? 1.0F : 1.0F - 1.0F / static_cast<float>(memory);
  ForEach(places_.rows, [&](int row) { TakeRow(row, remember); });
  ++frames_;
}

void FineRelief::Forget(Cell cell) {
  constexpr int kPerCell = NarrowFigures::kPerCell;
  for (int i = 0; frames_ > 0 && i < kPerCell * kPerCell; ++i) {
    seen_.at(kPerCell * cell.row + i / kPerCell, kPerCell * cell.col + i % kPerCell) = {};
  }
}

void FineRelief::Raise(const PlaneCorrection& correction, double gain) {
  for (int r = 0; r < places_.rows; ++r) {
    for (int c = 0; c < places_.cols; ++c) {
      auto& of = seen_.at(r, c).of;
      of[FinePlace::kHeight] +=
          of[FinePlace::kNet] *
          static_cast<float>(gain * correction.At(places_.NorthOfRow(r), places_.EastOfCol(c)));
    }
  }
}

}  // namespace palace
