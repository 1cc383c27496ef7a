#include "gui/render/ground_buffer.h"

#include "gui/render/near_first.h"

namespace palace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

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
  std::vector<MeshRun> runs;
  for (const GroundMesh::Chunk& chunk : chunks_) {
    runs.push_back({chunk.first_index, chunk.indices, placing.Around(chunk.box).translate(-p_W)});
  }
  palace::DrawNearFirst(mesh_, runs, clip);
}

}  // namespace palace
