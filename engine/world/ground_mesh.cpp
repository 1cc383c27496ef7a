#include "engine/world/ground_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/world/ground_picture.h"

namespace palace {
namespace {

using Eigen::Vector3f;

/// Chunks a side of the square, where the relief asks for that many.
constexpr int kChunks = 32;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

class Blocks {
 public:
  Blocks(const HeightField& field, double tolerance_m, GroundMesh& out)
      : field_(field),
        tolerance_m_(tolerance_m),
        chunk_(std::max(1, field.cells() / kChunks)),
        out_(out) {
    const auto side = static_cast<std::size_t>(field.cells() + 1);
    corner_at_.assign(side * side, kNone);
  }

  void Add(int i, int j, int size) {
    const bool flat = size == 1 || Deviation(i, j, size) <= tolerance_m_;
    const bool starts = !in_chunk_ && (flat || size <= chunk_);
    if (starts) {
      StartChunk();
    }
    if (flat) {
      AddSquare(i, j, size);
    } else {
      const int half = size / 2;
      for (const int di : {0, half}) {
        for (const int dj : {0, half}) {
          Add(i + di, j + dj, half);
        }
      }
    }
    if (starts) {
      EndChunk();
    }
  }

 private:
  void StartChunk() {
    in_chunk_ = true;
    first_corner_ = out_.corners.size();
    out_.chunks.push_back({static_cast<std::uint32_t>(out_.indices.size()), 0, {}});
  }
  void EndChunk() {
    in_chunk_ = false;
    GroundMesh::Chunk& chunk = out_.chunks.back();
    chunk.indices = static_cast<std::uint32_t>(out_.indices.size()) - chunk.first_index;
    for (std::size_t k = first_corner_; k < out_.corners.size(); ++k) {
      chunk.box.extend(out_.corners[k]);
    }
  }
  void AddSquare(int i, int j, int size) {
    const std::uint32_t sw = Index(i, j), nw = Index(i + size, j), se = Index(i, j + size),
                        ne = Index(i + size, j + size);
    out_.indices.insert(out_.indices.end(), {sw, nw, ne, sw, ne, se});
  }
  /// Of that corner in the chunk, added when it is new there.
  std::uint32_t Index(int i, int j) {
    std::uint32_t& known =
        corner_at_[static_cast<std::size_t>(i) * static_cast<std::size_t>(field_.cells() + 1) +
                   static_cast<std::size_t>(j)];
    if (known == kNone || known < first_corner_) {
      known = static_cast<std::uint32_t>(out_.corners.size());
      out_.corners.push_back(At(i, j));
    }
    return known;
  }
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
  int chunk_;  ///< cells a side
  GroundMesh& out_;
  bool in_chunk_ = false;
  std::size_t first_corner_ = 0;          ///< of the chunk
  std::vector<std::uint32_t> corner_at_;  ///< of the grid, where it was added last
};

}  // namespace

GroundMesh MeshGround(const Ground& ground, double tolerance_m) {
  GroundMesh mesh;
  if (ground.relief) {
    Blocks(*ground.relief, tolerance_m, mesh).Add(0, 0, ground.relief->cells());
    return mesh;
  }
  const GroundSquare square = SquareOf(ground);
  const auto n = static_cast<float>(square.north_m), e = static_cast<float>(square.east_m);
  const auto size = static_cast<float>(square.size_m);
  mesh.corners = {{n, e, 0}, {n + size, e, 0}, {n, e + size, 0}, {n + size, e + size, 0}};
  mesh.indices = {0, 1, 3, 0, 3, 2};
  mesh.chunks = {{0, 6, Eigen::AlignedBox3f(mesh.corners.front(), mesh.corners.back())}};
  return mesh;
}

}  // namespace palace
