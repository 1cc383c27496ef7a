#include "gui/render/solid_buffer.h"

#include <numeric>

#include "engine/world/world_mesh.h"
#include "gui/render/near_first.h"

namespace palace {

void SolidBuffer::Start(const World& world, const std::vector<Solid>& solids) {
  constexpr std::size_t kStride = sizeof(MeshVertex);
  World alone = world;
  std::vector<MeshVertex> corners;
  parts_.clear();
  for (const Solid& solid : solids) {
    alone.solids = {solid};
    const std::vector<MeshVertex> own = SolidTriangles(alone, kGroundAlbedo);
    Part part{static_cast<std::uint32_t>(corners.size()), static_cast<std::uint32_t>(own.size()),
              {}};
    for (const MeshVertex& vertex : own) {
      part.box_W.extend(vertex.position_W);
    }
    corners.insert(corners.end(), own.begin(), own.end());
    parts_.push_back(part);
  }
  mesh_.Start(corners.data(), corners.size() * kStride, corners.size());
  mesh_.Attribute(0, 3, kStride, 0);
  mesh_.Attribute(1, 3, kStride, 3 * sizeof(float));
  mesh_.Attribute(2, 2, kStride, 6 * sizeof(float));
  mesh_.Attribute(3, 1, kStride, 8 * sizeof(float));
  std::vector<std::uint32_t> index(corners.size());
  std::iota(index.begin(), index.end(), 0U);
  mesh_.Index(index);
}

void SolidBuffer::DrawNearFirst(const Eigen::Vector3d& moved_W, const Eigen::Vector3d& p_W,
                                const Eigen::Matrix4f* clip) const {
  std::vector<MeshRun> runs;
  for (const Part& part : parts_) {
    Eigen::AlignedBox3d box = part.box_W.cast<double>();
    runs.push_back({part.first_index, part.indices, box.translate(moved_W - p_W)});
  }
  palace::DrawNearFirst(mesh_, runs, clip);
}

}  // namespace palace
