#include "engine/stereo/frozen_check.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace palace {
namespace {

constexpr int kBlock_px = 8;
constexpr int kShift_px = 4;
constexpr int kPointsAcross = 3;

/// Means of the blocks of the picture, whose grid begins at (dx, dy).
std::vector<float> BlockMeans(const ImageU8& picture, int dx, int dy) {
  const int across = (picture.width() - kShift_px) / kBlock_px;
  const int down = (picture.height() - kShift_px) / kBlock_px;
  std::vector<float> means;
  if (across <= 0 || down <= 0) {
    return means;
  }
  std::vector<int> sums(static_cast<std::size_t>(across));
  means.reserve(sums.size() * static_cast<std::size_t>(down));
  for (int j = 0; j < down; ++j) {
    std::fill(sums.begin(), sums.end(), 0);
    for (int y = 0; y < kBlock_px; ++y) {
      const std::uint8_t* row = picture.row(dy + j * kBlock_px + y) + dx;
      for (int i = 0; i < across; ++i) {
        for (int x = 0; x < kBlock_px; ++x) {
          sums[static_cast<std::size_t>(i)] += row[i * kBlock_px + x];
        }
      }
    }
    for (const int sum : sums) {
      means.push_back(static_cast<float>(sum) / (kBlock_px * kBlock_px));
    }
  }
  return means;
}

double RootMeanSquare(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = a[i] - b[i];
    sum += difference * difference;
  }
  return a.empty() ? 0 : std::sqrt(sum / static_cast<double>(a.size()));
}

bool IsRepeated(const ImageU8& before, const ImageU8& now) {
  if (before.width() != now.width() || before.height() != now.height() || now.empty()) {
    return false;
  }
  const auto most = static_cast<std::ptrdiff_t>(FrozenCheck::kRepeatedShare *
                                                static_cast<double>(now.pixels().size()));
  std::ptrdiff_t changed = 0;
  for (int y = 0; y < now.height() && changed <= most; ++y) {
    const std::uint8_t *a = before.row(y), *b = now.row(y);
    for (int x = 0; x < now.width(); ++x) {
      changed += a[x] != b[x] ? 1 : 0;
    }
  }
  return changed <= most;
}

}  // namespace

double MeanShift_px(const PinholeCamera& camera, double depth_m, const RigidTransform& X_WA,
                    const RigidTransform& X_WB) {
  const RigidTransform X_BA = X_WB.Inverse() * X_WA;
  double sum = 0;
  for (int j = 0; j < kPointsAcross; ++j) {
    for (int i = 0; i < kPointsAcross; ++i) {
      const Eigen::Vector2d pixel(camera.width * (i + 0.5) / kPointsAcross,
                                  camera.height * (j + 0.5) / kPointsAcross);
      const Eigen::Vector3d p_A(depth_m * (pixel.x() - camera.cx_px) / camera.fx_px,
                                depth_m * (pixel.y() - camera.cy_px) / camera.fy_px, depth_m);
      const Eigen::Vector3d p_B = X_BA * p_A;
      if (p_B.z() < 0.1 * depth_m) {
        return camera.width;  // turned away from it
      }
      const Eigen::Vector2d there(camera.cx_px + camera.fx_px * p_B.x() / p_B.z(),
                                  camera.cy_px + camera.fy_px * p_B.y() / p_B.z());
      sum += (there - pixel).norm();
    }
  }
  return sum / (kPointsAcross * kPointsAcross);
}

FrozenCheck::Reference FrozenCheck::Keep(const ImageU8& picture) {
  Reference reference{BlockMeans(picture, 0, 0), 0};
  reference.change = std::min(RootMeanSquare(reference.means, BlockMeans(picture, kShift_px, 0)),
                              RootMeanSquare(reference.means, BlockMeans(picture, 0, kShift_px)));
  return reference;
}

bool FrozenCheck::Judge(Eye& eye, const std::shared_ptr<const ImageU8>& picture,
                        const Reference* moved_from) {
  const bool repeated = eye.before && IsRepeated(*eye.before, *picture);
  eye.before = picture;
  const Reference* asked = eye.unmoved ? &*eye.unmoved : moved_from;
  if (asked != nullptr && asked->change >= kLeastTexture) {
    const std::vector<float> means = BlockMeans(*picture, 0, 0);
    if (means.size() == asked->means.size()) {
      const double share = RootMeanSquare(means, asked->means) / asked->change;
      if (share >= (eye.unmoved ? kChangedShare : kUnmovedShare)) {
        eye.unmoved.reset();
      } else if (!eye.unmoved) {
        eye.unmoved = *asked;
      }
    }
  }
  return repeated || eye.unmoved;
}

double FrozenCheck::SureShift_px(const SeenPair& pair, const RigidTransform& X_WBefore) {
  constexpr double kSigmas = 3;
  const Eigen::Vector3d way = pair.X_WC.p - X_WBefore.p;
  const double unsure_m = std::isfinite(pair.sigma_p_m) ? kSigmas * pair.sigma_p_m : HUGE_VAL;
  const double length_m = way.norm();
  const double sure = length_m > unsure_m ? 1 - unsure_m / length_m : 0;
  return MeanShift_px(pair.camera, pair.depth_m, {X_WBefore.R, pair.X_WC.p - sure * way},
                      pair.X_WC);
}

FrozenCameras FrozenCheck::Add(const SeenPair& pair) {
  while (!looks_.empty() && SecondsBetween(looks_.front().time, pair.time) > kOldest_s) {
    looks_.pop_front();
  }
  const bool known = std::isfinite(pair.depth_m) && pair.depth_m > 0;
  const auto moved_from = std::find_if(looks_.rbegin(), looks_.rend(), [&](const Look& look) {
    return known && SureShift_px(pair, look.X_WC) >= kMoved_px;
  });
  const Look* from = moved_from == looks_.rend() ? nullptr : &*moved_from;
  const FrozenCameras frozen{Judge(left_, pair.left, from ? &from->left : nullptr),
                             Judge(right_, pair.right, from ? &from->right : nullptr)};
  if (known && (looks_.empty() || SecondsBetween(looks_.back().time, pair.time) >= kEvery_s)) {
    looks_.push_back({pair.time, pair.X_WC, Keep(*pair.left), Keep(*pair.right)});
  }
  return frozen;
}

}  // namespace palace
