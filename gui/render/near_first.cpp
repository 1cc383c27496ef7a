#include "gui/render/near_first.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace palace {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

/// More than single precision moves a corner on its way to the picture.
constexpr double kSlack_m = 0.01;

/// The six half-spaces of a view, v . (p, 1) >= 0 of positions relative to the camera.
class View {
 public:
  explicit View(const Eigen::Matrix4f& clip) {
    const Eigen::Matrix4d rows = clip.cast<double>();
    for (int axis = 0; axis < 3; ++axis) {
      bounds_.row(2 * axis) = rows.row(3) + rows.row(axis);
      bounds_.row(2 * axis + 1) = rows.row(3) - rows.row(axis);
    }
  }
  /// False only where the box is outside of one of them as a whole.
  bool Reaches(const AlignedBox3d& box) const {
    for (int k = 0; k < 6; ++k) {
      const Vector3d inward = bounds_.block<1, 3>(k, 0).transpose();
      const double most =
          inward.cwiseProduct(box.min()).cwiseMax(inward.cwiseProduct(box.max())).sum() +
          bounds_(k, 3) + kSlack_m * inward.norm();
      if (most < 0) {
        return false;
      }
    }
    return true;
  }

 private:
  Eigen::Matrix<double, 6, 4> bounds_;
};

}  // namespace

void DrawNearFirst(const MeshBuffer& mesh, const std::vector<MeshRun>& runs,
                   const Eigen::Matrix4f* clip) {
  std::optional<View> view;
  if (clip != nullptr) {
    view.emplace(*clip);
  }
  std::vector<std::pair<double, std::size_t>> seen;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!view || view->Reaches(runs[i].box)) {
      seen.emplace_back(runs[i].box.squaredExteriorDistance(Vector3d::Zero()), i);
    }
  }
  std::sort(seen.begin(), seen.end());
  std::vector<GLsizei> counts;
  std::vector<std::size_t> firsts;
  for (const auto& [distance, i] : seen) {
    counts.push_back(static_cast<GLsizei>(runs[i].indices));
    firsts.push_back(runs[i].first_index);
  }
  mesh.DrawRuns(counts, firsts);
}

}  // namespace palace
