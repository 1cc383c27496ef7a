#include "engine/world/ground_mesh.h"

#include <algorithm>
#include <cmath>

#include "engine/world/ground_picture.h"

namespace palace {
namespace {

using Eigen::Vector3f;

class Blocks {
 public:
  Blocks(const HeightField& field, double tolerance_m, std::vector<Vector3f>& out)
      : field_(field), tolerance_m_(tolerance_m), out_(out) {}

  void Add(int i, int j, int size) {
    if (size == 1 || Deviation(i, j, size) <= tolerance_m_) {
      const Vector3f sw = At(i, j), nw = At(i + size, j), se = At(i, j + size),
                     ne = At(i + size, j + size);
      for (const Vector3f& corner : {sw, nw, ne, sw, ne, se}) {
        out_.push_back(corner);
      }
      return;
    }
    const int half = size / 2;
    for (const int di : {0, half}) {
      for (const int dj : {0, half}) {
        Add(i + di, j + dj, half);
      }
    }
  }

 private:
  Vector3f At(int i, int j) const {
    return {static_cast<float>(field_.place().north_m + i * field_.cell_m()),
            static_cast<float>(field_.place().east_m + j * field_.cell_m()),
            static_cast<float>(field_.Corner(i, j))};
  }
  /// Of the grid's corners inside the block from its two triangles.
  double Deviation(int i, int j, int size) const {
    const double sw = field_.Corner(i, j), nw = field_.Corner(i + size, j),
                 se = field_.Corner(i, j + size), ne = field_.Corner(i + size, j + size);
    double most = 0;
    for (int k = 0; k <= size; ++k) {
      const double a = static_cast<double>(k) / size;
      for (int l = 0; l <= size; ++l) {
        const double b = static_cast<double>(l) / size;
        const double flat =
            a >= b ? sw + (nw - sw) * a + (ne - nw) * b : sw + (ne - se) * a + (se - sw) * b;
        most = std::max(most, std::abs(field_.Corner(i + k, j + l) - flat));
      }
      if (most > tolerance_m_) {
        break;
      }
    }
    return most;
  }

  const HeightField& field_;
  double tolerance_m_;
  std::vector<Vector3f>& out_;
};

}  // namespace

std::vector<Vector3f> GroundTriangles(const Ground& ground, double tolerance_m) {
  std::vector<Vector3f> triangles;
  if (ground.relief) {
    Blocks(*ground.relief, tolerance_m, triangles).Add(0, 0, ground.relief->cells());
    return triangles;
  }
  const GroundSquare square = SquareOf(ground);
  const auto n = static_cast<float>(square.north_m), e = static_cast<float>(square.east_m);
  const auto size = static_cast<float>(square.size_m);
  for (const auto& [dn, de] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}) {
    triangles.emplace_back(n + static_cast<float>(dn) * size, e + static_cast<float>(de) * size,
                           0.0F);
  }
  return triangles;
}

}  // namespace palace
