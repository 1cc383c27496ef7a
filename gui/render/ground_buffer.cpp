#include "gui/render/ground_buffer.h"

#include <algorithm>
#include <cstdint>
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

AlignedBox3d GroundPlacing::Around(const Eigen::AlignedBox3f& box) const {
  AlignedBox3d around;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d at =
        box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)).cast<double>();
    const double north = mirror(0) * at.x() + mirror(1), east = mirror(2) * at.y() + mirror(3);
    around.extend(Vector3d(north, east, lower_m - at.z() - rise.x() * north - rise.y() * east));
  }
  return around;
}

void GroundBuffer::Start(const GroundMesh& mesh) {
  mesh_.Start(mesh.corners.data(), mesh.corners.size() * sizeof(Eigen::Vector3f),
              mesh.corners.size());
  mesh_.Attribute(0, 3, sizeof(Eigen::Vector3f), 0);
  mesh_.Index(mesh.indices);
  chunks_ = mesh.chunks;
}

void GroundBuffer::DrawNearFirst(const GroundPlacing& placing, const Vector3d& p_W,
                                 const Eigen::Matrix4f* clip) const {
  std::optional<View> view;
  if (clip != nullptr) {
    view.emplace(*clip);
  }
  std::vector<std::pair<double, const GroundMesh::Chunk*>> seen;
  for (const GroundMesh::Chunk& chunk : chunks_) {
    AlignedBox3d box = placing.Around(chunk.box);
    box.translate(-p_W);
    if (!view || view->Reaches(box)) {
      seen.emplace_back(box.squaredExteriorDistance(Vector3d::Zero()), &chunk);
    }
  }
  std::sort(seen.begin(), seen.end());
  std::vector<GLsizei> counts;
  std::vector<std::size_t> firsts;
  for (const auto& [distance, chunk] : seen) {
    counts.push_back(static_cast<GLsizei>(chunk->indices));
    firsts.push_back(chunk->first_index);
  }
  mesh_.DrawRuns(counts, firsts);
}

}  // namespace palace
