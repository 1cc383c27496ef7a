// The mesh of a ground covers its square once, and its chunks are whole, boxes and all.
#include "engine/world/ground_mesh.h"

#include <cmath>
#include <memory>

#include "engine/world/lattice_noise.h"

namespace palace {
namespace {

constexpr double kSize_m = 32, kTolerance_m = 0.01;

Ground Rolling() {
  Ground ground;
  ground.relief = std::make_shared<const HeightField>(
      HeightField::Place{-8, -16, kSize_m, 8}, [](double n, double e) {
        return e < 0 ? 0.0 : 0.1 * FractalNoise(n, e, 11, 6, 0.5, 0.8);  // the west is flat
      });
  return ground;
}

TEST(GroundMesh, CoversTheSquareOnceInChunks) {
  const GroundMesh mesh = MeshGround(Rolling(), kTolerance_m);
  double area_m2 = 0;
  std::uint32_t next = 0;
  for (const GroundMesh::Chunk& chunk : mesh.chunks) {
    EXPECT_EQ(chunk.first_index, next) << "no index is left out or in two chunks";
    next += chunk.indices;
    for (std::uint32_t k = chunk.first_index; k < next; k += 3) {
      const Eigen::Vector3f& a = mesh.corners[mesh.indices[k]];
      const Eigen::Vector3f ab = mesh.corners[mesh.indices[k + 1]] - a;
      const Eigen::Vector3f ac = mesh.corners[mesh.indices[k + 2]] - a;
      area_m2 += 0.5 * std::abs(ab.x() * ac.y() - ab.y() * ac.x());
      for (int corner = 0; corner < 3; ++corner) {
        EXPECT_TRUE(
            chunk.box.contains(mesh.corners[mesh.indices[k + static_cast<std::uint32_t>(corner)]]));
      }
    }
  }
  EXPECT_EQ(next, mesh.indices.size());
  EXPECT_NEAR(area_m2, kSize_m * kSize_m, 1e-3);
  EXPECT_GT(mesh.chunks.size(), 300U) << "the rough half in blocks of a metre";
  EXPECT_LT(mesh.corners.size(), mesh.indices.size() / 3) << "neighbours share corners";
}

TEST(GroundMesh, HasItsCornersOnTheRelief) {
  const Ground ground = Rolling();
  for (const Eigen::Vector3f& corner : MeshGround(ground, kTolerance_m).corners) {
    EXPECT_NEAR(corner.z(), ground.relief->Height(corner.x(), corner.y()), 1e-5);
  }
}

TEST(GroundMesh, OfAPlaneIsTwoTriangles) {
  const GroundMesh mesh = MeshGround(Ground{}, kTolerance_m);
  EXPECT_EQ(mesh.indices.size(), 6U);
  ASSERT_EQ(mesh.chunks.size(), 1U);
  EXPECT_EQ(mesh.chunks[0].indices, 6U);
}

}  // namespace
}  // namespace palace
