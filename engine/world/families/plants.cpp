#include "engine/world/families/plants.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace palace {
namespace {

using Eigen::Vector3d;
constexpr double kTwigAlbedo = 0.16;

/// Triangles that share no corner.
class LeafHeap {
 public:
  void Add(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    vertices_.insert(vertices_.end(), {a, b, c});
    triangles_.push_back({first, first + 1, first + 2});
  }
  Solid Take(double albedo) {
    Solid solid{
        Mesh{std::make_shared<const TriangleMesh>(std::move(vertices_), std::move(triangles_))}};
    solid.albedo = albedo;
    solid.soft = true;
    return solid;
  }

 private:
  std::vector<Vector3d> vertices_;
  std::vector<TriangleMesh::Corners> triangles_;
};

Vector3d DrawDirection(RandomStream& random) {
  const double z = random.Uniform(-1, 1), angle = DrawAngle(random);
  const double flat = std::sqrt(1 - z * z);
  return {flat * std::cos(angle), flat * std::sin(angle), z};
}

/// A leaf somewhere, mostly facing up.
void AddLeaf(RandomStream& random, const Vector3d& middle, double leaf_m, LeafHeap& heap) {
  const double size_m = leaf_m * random.Uniform(0.6, 1.0), angle = DrawAngle(random);
  const double dip = random.Uniform(-0.8, 0.8), roll = random.Uniform(-0.8, 0.8);
  const Vector3d along(std::cos(angle), std::sin(angle), dip);
  const Vector3d across(-std::sin(angle), std::cos(angle), roll);
  heap.Add(middle + 0.5 * size_m * along, middle - 0.5 * size_m * along + 0.35 * size_m * across,
           middle - 0.5 * size_m * along - 0.35 * size_m * across);
}

}  // namespace

Solid MakeFoliage(RandomStream& random, const Foliage& foliage) {
  const double phase = DrawAngle(random), twist = DrawAngle(random);
  LeafHeap heap;
  for (int i = 0; i < foliage.leaves; ++i) {
    const Vector3d direction = DrawDirection(random);
    const double around = std::atan2(direction.y(), direction.x());
    const double lobes = 1 + foliage.irregular * (0.5 * std::sin(2 * around + phase) +
                                                  0.3 * std::sin(5 * around + twist) +
                                                  0.2 * std::sin(4 * direction.z() + phase));
    const double out = lobes * std::pow(random.Uniform(), 0.4);
    const Vector3d middle(out * foliage.radius_m * direction.x(),
                          out * foliage.radius_m * direction.y(),
                          -foliage.foot_m - 0.5 * foliage.height_m * (1 + out * direction.z()));
    AddLeaf(random, {middle.x(), middle.y(), std::min(middle.z(), -0.3 * foliage.leaf_m)},
            foliage.leaf_m, heap);
  }
  return heap.Take(random.Uniform(0.14, 0.34));
}

Solid MakeTuft(RandomStream& random, double radius_m, double height_m, int blades) {
  LeafHeap heap;
  for (int i = 0; i < blades; ++i) {
    const double angle = DrawAngle(random), away = radius_m * std::sqrt(random.Uniform());
    const Vector3d foot(away * std::cos(angle), away * std::sin(angle), 0.02);
    const double lean = random.Uniform(0.1, 0.7), tall = height_m * random.Uniform(0.5, 1.0);
    const double to = angle + random.Uniform(-0.8, 0.8);
    const Vector3d tip =
        foot + Vector3d(lean * tall * std::cos(to), lean * tall * std::sin(to), -tall);
    const Vector3d side(-0.012 * std::sin(to), 0.012 * std::cos(to), 0);
    heap.Add(foot - side, foot + side, tip);
  }
  return heap.Take(random.Uniform(0.25, 0.5));
}

std::vector<Solid> MakeTree(RandomStream& random, const Tree& tree) {
  const double bare_m = 0.3 * tree.height_m;
  std::vector<Solid> parts = {Painted({Cylinder{tree.trunk_m, 0.6 * tree.height_m}}, kTwigAlbedo)};
  for (int i = 0; i < 3; ++i) {
    const double angle = DrawAngle(random), out = tree.crown_m * random.Uniform(0.5, 0.8);
    const double up = tree.height_m * random.Uniform(0.6, 0.8);
    parts.push_back(
        Painted(MakeRod({0, 0, -1.2 * bare_m}, {out * std::cos(angle), out * std::sin(angle), -up},
                        tree.trunk_m / 3),
                kTwigAlbedo));
  }
  parts.push_back(MakeFoliage(random, {.radius_m = tree.crown_m,
                                       .height_m = tree.height_m - bare_m,
                                       .foot_m = bare_m,
                                       .leaf_m = tree.leaf_m,
                                       .leaves = tree.leaves}));
  return parts;
}

std::vector<Solid> MakeConifer(RandomStream& random, const Tree& tree) {
  std::vector<Solid> parts = {Painted({Cylinder{tree.trunk_m, 0.95 * tree.height_m}}, kTwigAlbedo)};
  LeafHeap heap;
  for (int i = 0; i < tree.leaves; ++i) {
    // Even over the cone's area: the share of the height from the top is a square root.
    const double down = std::sqrt(random.Uniform());
    const double angle = DrawAngle(random);
    const double out = tree.crown_m * down * std::pow(random.Uniform(), 0.3);
    AddLeaf(random,
            {out * std::cos(angle), out * std::sin(angle), -tree.height_m * (1 - 0.85 * down)},
            tree.leaf_m, heap);
  }
  parts.push_back(heap.Take(random.Uniform(0.1, 0.2)));
  return parts;
}

}  // namespace palace
