#include "engine/slad/pictures/scene_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "engine/model/elevation_map.h"

namespace palace {
namespace {

constexpr double kLeastAge_s = 0.3;  // nothing that matters moves its own width sooner
constexpr double kMostAge_s = 5;
constexpr double kBetweenViews_s = 0.5;
constexpr double kLeastDepthChange_m = 0.3;
constexpr double kDisparityNoise_px = 0.6;  // four sigmas of a block's mean, at least
constexpr double kNoise_sigmas = 4;         // of the difference of two faint blocks
constexpr float kLeastChange_grey = 12;
constexpr int kShift_blocks = 2;  // what the pose may leave over
constexpr int kShiftStride_blocks = 4;
constexpr int kLeastNeighbours = 5;  // of nine
constexpr double kNearestPoint_m = 0.1;

/// Where a block of the new view lies in the older one.
struct Place {
  int i = -1;
  int j = -1;
  float depth_m = 0;  ///< of the point, seen from there
};

ImageF BlockMeans(const ImageU8& picture, int cols, int rows) {
  ImageF means(cols, rows);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < cols; ++i) {
      int sum = 0;
      for (int y = kBlock_px * j; y < kBlock_px * (j + 1); ++y) {
        const std::uint8_t* p = picture.row(y) + kBlock_px * i;
        sum += p[0] + p[1] + p[2] + p[3];
      }
      means.at(i, j) = static_cast<float>(sum) / (kBlock_px * kBlock_px);
    }
  }
  return means;
}

std::vector<Place> Places(const SceneView& view, const SceneGround& ground,
                          const RigidTransform& X_OldW) {
  const PinholeCamera& camera = view.range->camera;
  constexpr double kMiddle_px = (kBlock_px - 1) / 2.0;
  std::vector<Place> places(ground.disparity_px.pixels().size());
  for (int j = 0; j < ground.rows(); ++j) {
    for (int i = 0; i < ground.cols(); ++i) {
      const float measured = ground.measured_px.at(i, j);
      const float disparity = std::isfinite(measured) ? measured : ground.disparity_px.at(i, j);
      const Eigen::Vector3d p =
          X_OldW * PointAt(view, kBlock_px * i + kMiddle_px, kBlock_px * j + kMiddle_px,
                           static_cast<double>(disparity));
      if (!(p.z() > kNearestPoint_m)) {
        continue;
      }
      const double x = (camera.fx_px * p.x() / p.z() + camera.cx_px - kMiddle_px) / kBlock_px;
      const double y = (camera.fy_px * p.y() / p.z() + camera.cy_px - kMiddle_px) / kBlock_px;
      // Room for the shift and a neighbour on each side.
      constexpr int kRim = kShift_blocks + 1;
      if (x >= kRim && y >= kRim && x < ground.cols() - kRim - 1 && y < ground.rows() - kRim - 1) {
        places[static_cast<std::size_t>(j * ground.cols() + i)] = {static_cast<int>(std::lround(x)),
                                                                   static_cast<int>(std::lround(y)),
                                                                   static_cast<float>(p.z())};
      }
    }
  }
  return places;
}

/// What brightness does between the views, and where the older picture fits best.
struct Fit {
  int di = 0;
  int dj = 0;
  float gain = 1;
};

Fit FitOldView(const ImageF& now, const ImageF& old, const std::vector<Place>& places) {
  struct Sample {
    float grey;
    int i, j;
  };
  std::vector<Sample> samples;
  double sum_now = 0, sum_old = 0;
  for (int j = 0; j < now.height(); j += kShiftStride_blocks) {
    for (int i = 0; i < now.width(); i += kShiftStride_blocks) {
      const Place& place = places[static_cast<std::size_t>(j * now.width() + i)];
      if (place.i >= 0) {
        samples.push_back({now.at(i, j), place.i, place.j});
        sum_now += static_cast<double>(now.at(i, j));
        sum_old += static_cast<double>(old.at(place.i, place.j));
      }
    }
  }
  Fit best;
  best.gain = sum_now > 0 ? static_cast<float>(sum_old / sum_now) : 1.0F;
  float least = std::numeric_limits<float>::infinity();
  for (int dj = -kShift_blocks; dj <= kShift_blocks; ++dj) {
    for (int di = -kShift_blocks; di <= kShift_blocks; ++di) {
      float sum = 0;
      for (const Sample& s : samples) {
        sum += std::abs(best.gain * s.grey - old.at(s.i + di, s.j + dj));
      }
      if (sum < least) {
        least = sum;
        best.di = di;
        best.dj = dj;
      }
    }
  }
  return best;
}

/// Of a block and its eight neighbours.
struct Neighbourhood {
  float darkest = std::numeric_limits<float>::infinity();
  float brightest = -std::numeric_limits<float>::infinity();
  float nearest_m = std::numeric_limits<float>::infinity();
  bool all_known = true;
};

Neighbourhood Around(const ImageF& grey, const ImageF& depth_m, int i, int j) {
  Neighbourhood near;
  for (int b = j - 1; b <= j + 1; ++b) {
    for (int a = i - 1; a <= i + 1; ++a) {
      near.darkest = std::min(near.darkest, grey.at(a, b));
      near.brightest = std::max(near.brightest, grey.at(a, b));
      const float depth = depth_m.at(a, b);
      near.all_known = near.all_known && std::isfinite(depth);
      near.nearest_m = std::isfinite(depth) ? std::min(near.nearest_m, depth) : near.nearest_m;
    }
  }
  return near;
}

/// Mean sigma of the block's disparities, 0 where none is known.
double SigmaOfBlock(const RangeMap& range, int i, int j) {
  double sum = 0;
  int known = 0;
  for (int y = kBlock_px * j; y < kBlock_px * (j + 1); ++y) {
    const float* sigma = range.disparity_sigma_px.row(y) + kBlock_px * i;
    for (int x = 0; x < kBlock_px; ++x) {
      sum += std::isfinite(sigma[x]) ? static_cast<double>(sigma[x]) : 0.0;
      known += std::isfinite(sigma[x]) ? 1 : 0;
    }
  }
  return known > 0 ? sum / known : 0.0;
}

/// Clusters with a block around them: what moves has more to it than its changed rim.
void FlagClusters(const ImageU8& moved, ImageU8& flags) {
  for (int j = 1; j + 1 < moved.height(); ++j) {
    for (int i = 1; i + 1 < moved.width(); ++i) {
      int count = 0;
      for (int b = j - 1; b <= j + 1; ++b) {
        count += moved.at(i - 1, b) + moved.at(i, b) + moved.at(i + 1, b);
      }
      if (count < kLeastNeighbours) {
        continue;
      }
      for (int b = std::max(0, j - 2); b <= std::min(moved.height() - 1, j + 2); ++b) {
        for (int a = std::max(0, i - 2); a <= std::min(moved.width() - 1, i + 2); ++a) {
          flags.at(a, b) |= kFlagMotion;
        }
      }
    }
  }
}

}  // namespace

void SceneMotion::Remember(OldView view) {
  if (!views_.empty() && (view.grey.width() != views_.front().grey.width() ||
                          view.grey.height() != views_.front().grey.height() ||
                          SecondsBetween(views_.back().time, view.time) < 0)) {
    views_.clear();
  }
  if (!views_.empty() && SecondsBetween(views_.back().time, view.time) < kBetweenViews_s) {
    return;
  }
  views_.push_back(std::move(view));
  if (views_.size() > 2) {
    views_.pop_front();
  }
}

bool SceneMotion::Flag(const SceneView& view, const SceneGround& ground, ImageU8& flags) {
  const int cols = ground.cols(), rows = ground.rows();
  const double focal_m = view.range->FocalTimesBaseline();
  OldView now{view.range->time, view.X_WC(), BlockMeans(*view.left, cols, rows),
              ImageF(cols, rows)};
  for (std::size_t k = 0; k < now.depth_m.pixels().size(); ++k) {
    now.depth_m.pixels()[k] = static_cast<float>(focal_m) / ground.measured_px.pixels()[k];
  }
  const double age_s = views_.empty() ? 0.0 : SecondsBetween(views_.front().time, view.range->time);
  const bool comparable = age_s >= kLeastAge_s && age_s <= kMostAge_s &&
                          views_.front().grey.width() == cols &&
                          views_.front().grey.height() == rows;
  if (comparable) {
    const OldView& old = views_.front();
    const std::vector<Place> places = Places(view, ground, old.X_WC.Inverse());
    const Fit fit = FitOldView(now.grey, old.grey, places);
    ImageU8 moved(cols, rows, 0);
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < cols; ++i) {
        const Place& place = places[static_cast<std::size_t>(j * cols + i)];
        if (place.i < 0 || ground.usable.at(i, j) == 0) {
          continue;
        }
        const int a = place.i + fit.di, b = place.j + fit.dj;
        const Neighbourhood then = Around(old.grey, old.depth_m, a, b);
        const double z = static_cast<double>(place.depth_m);
        // Pixels of a block share their window, so the mean of faint ones is no better than they.
        const double noise_px = std::max(kDisparityNoise_px, kNoise_sigmas * std::numbers::sqrt2 *
                                                                 SigmaOfBlock(*view.range, i, j));
        const float change_m =
            static_cast<float>(std::max(kLeastDepthChange_m, z * z * noise_px / focal_m));
        const bool measured = std::isfinite(ground.measured_px.at(i, j));
        const bool seen_through =
            measured && then.all_known && then.nearest_m > place.depth_m + change_m;
        const bool same_surface = std::abs(old.depth_m.at(a, b) - place.depth_m) < change_m;
        const float grey = fit.gain * now.grey.at(i, j);
        const bool changed = same_surface && (grey > then.brightest + kLeastChange_grey ||
                                              grey < then.darkest - kLeastChange_grey);
        moved.at(i, j) = seen_through || changed;
      }
    }
    FlagClusters(moved, flags);
  }
  Remember(std::move(now));
  return comparable;
}

}  // namespace palace
