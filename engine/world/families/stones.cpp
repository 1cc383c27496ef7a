#include "engine/world/families/stones.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace palace {
namespace {

using Eigen::Vector3d;

Vector3d DrawDirection(RandomStream& random) {
  const double z = random.Uniform(-1, 1), angle = DrawAngle(random);
  const double flat = std::sqrt(1 - z * z);
  return {flat * std::cos(angle), flat * std::sin(angle), z};
}

}  // namespace

StoneMaker::StoneMaker() {
  // Corners of an icosahedron: a pole on each side and two rings of five.
  Sphere& coarse = spheres_[0];
  const double z = 1 / std::sqrt(5.0), flat = 2 * z;
  coarse.vertices = {{0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 10; ++i) {
    const double angle = i * std::numbers::pi / 5;
    coarse.vertices.emplace_back(flat * std::cos(angle), flat * std::sin(angle),
                                 i % 2 == 0 ? z : -z);
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto& at = coarse.vertices;
    const bool outward = (at[b] - at[a]).cross(at[c] - at[a]).dot(at[a]) > 0;
    coarse.triangles.push_back(outward ? TriangleMesh::Corners{a, b, c}
                                       : TriangleMesh::Corners{a, c, b});
  };
  for (std::uint32_t i = 0; i < 10; ++i) {
    const std::uint32_t next = 2 + (i + 1) % 10, after = 2 + (i + 2) % 10;
    add(i % 2, 2 + i, after);
    add(2 + i, next, after);
  }
  spheres_[1] = Finer(spheres_[0]);
  spheres_[2] = Finer(spheres_[1]);
}

/// Every triangle becomes four.
StoneMaker::Sphere StoneMaker::Finer(const Sphere& sphere) {
  Sphere fine{sphere.vertices, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), fine.vertices.size());
    if (fresh) {
      fine.vertices.push_back((fine.vertices[a] + fine.vertices[b]).normalized());
    }
    return at->second;
  };
  for (const auto& [a, b, c] : sphere.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const TriangleMesh::Corners& corners :
         {TriangleMesh::Corners{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) {
      fine.triangles.push_back(corners);
    }
  }
  return fine;
}

Solid StoneMaker::Make(RandomStream& random, double longest_m, const StoneKind& kind) const {
  const Sphere& sphere = spheres_[longest_m >= 0.3 ? 2 : 1];
  std::vector<std::pair<Vector3d, double>> cuts;
  for (int i = 0; i < kind.facets; ++i) {
    const Vector3d normal = DrawDirection(random);
    cuts.emplace_back(normal, random.Uniform(0.62, 0.95));
  }
  const double slim = Draw(random, kind.slimness), flat = Draw(random, kind.flatness);
  std::vector<Vector3d> vertices;
  Eigen::AlignedBox3d box;
  for (const Vector3d& direction : sphere.vertices) {
    double radius = 1;
    for (const auto& [normal, offset] : cuts) {
      const double facing = normal.dot(direction);
      radius = facing > 0 ? std::min(radius, offset / facing) : radius;
    }
    radius *= 1 + random.Uniform(-kind.dents, kind.dents);
    vertices.push_back(radius * direction.cwiseProduct(Vector3d(1, slim, flat)));
    box.extend(vertices.back());
  }
  // To its size, with the sunk share under the origin.
  const double scale = longest_m / box.sizes().x();
  const double sunk = Draw(random, kind.sunk);
  const double down = -box.max().z() + sunk * box.sizes().z();
  for (Vector3d& vertex : vertices) {
    vertex = scale * (vertex - Vector3d(box.center().x(), box.center().y(), -down));
  }
  return {Mesh{std::make_shared<const TriangleMesh>(std::move(vertices), sphere.triangles)}};
}

}  // namespace palace
