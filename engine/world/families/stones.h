// Stones: spheres of triangles cut by random planes, dented and flattened.
#pragma once

#include <array>

#include "engine/core/random.h"
#include "engine/world/families/drawing.h"

namespace palace {

struct StoneKind {
  Range flatness = {0.5, 0.9};  ///< height over the longest side
  Range slimness = {0.6, 1.0};  ///< width over length
  int facets = 10;              ///< planes that cut it: few angular, many round
  double dents = 0.05;          ///< share of the radius
  Range sunk = {0.1, 0.35};     ///< share of its height below the ground
};

class StoneMaker {
 public:
  StoneMaker();
  /// In a frame whose origin is the ground under its middle; 320 triangles from 30 cm, else 80.
  Solid Make(RandomStream& random, double longest_m, const StoneKind& kind) const;

 private:
  struct Sphere {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<TriangleMesh::Corners> triangles;
  };
  static Sphere Finer(const Sphere& sphere);
  std::array<Sphere, 3> spheres_;  ///< icosahedron, divided once, twice
};

}  // namespace palace
