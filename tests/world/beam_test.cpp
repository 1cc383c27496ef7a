// Beams: what is asked once of many rays changes nothing of what each of them meets.
#include "engine/world/beam.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "engine/world/height_field.h"
#include "engine/world/lattice_noise.h"
#include "engine/world/triangle_mesh.h"

namespace palace {
namespace {

using Eigen::Vector3d;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A beam about a direction, and rays of it.
struct Bundle {
  Bundle(const Vector3d& p, const Vector3d& middle, double half) : beam(p, Edges(middle, half)) {}
  static std::array<Vector3d, 4> Edges(const Vector3d& middle, double half) {
    const Vector3d u = half * middle.unitOrthogonal(), v = middle.normalized().cross(u);
    return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
  }
  Vector3d Ray(RandomStream& random) const {
    const auto& e = beam.edges();
    const double a = random.Uniform(0.01, 0.99), b = random.Uniform(0.01, 0.99);
    return (1 - b) * ((1 - a) * e[0] + a * e[1]) + b * ((1 - a) * e[3] + a * e[2]);
  }
  Beam beam;
};

Vector3d InCube(RandomStream& random, double half) {
  return {random.Uniform(-half, half), random.Uniform(-half, half), random.Uniform(-half, half)};
}

/// Leaves all over a cube.
TriangleMesh Heap(RandomStream& random, int leaves) {
  std::vector<Vector3d> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (int i = 0; i < leaves; ++i) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    const Vector3d middle = InCube(random, 4);
    for (int k = 0; k < 3; ++k) {
      vertices.push_back(middle + InCube(random, 0.5));
    }
    triangles.push_back({first, first + 1, first + 2});
  }
  return {std::move(vertices), std::move(triangles)};
}

/// Moeller and Trumbore's test of every triangle.
TriangleMesh::Meeting OfAll(const TriangleMesh& mesh, const Vector3d& p, const Vector3d& r) {
  TriangleMesh::Meeting first;
  for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) {
    const TriangleMesh::Corners& corners = mesh.triangles()[i];
    const Vector3d& a = mesh.vertices()[corners[0]];
    const Vector3d ab = mesh.vertices()[corners[1]] - a, ac = mesh.vertices()[corners[2]] - a;
    const Vector3d h = r.cross(ac), ap = p - a, q = ap.cross(ab);
    const double volume = ab.dot(h);
    const double u = ap.dot(h) / volume, v = r.dot(q) / volume, s = ac.dot(q) / volume;
    if (volume != 0 && u >= 0 && v >= 0 && u + v <= 1 && s >= 0 && s < first.s) {
      first = {s, i};
    }
  }
  return first;
}

TEST(Beam, RaysOfItMeetTheTriangleThatATestOfAllFinds) {
  RandomStream random(31);
  int met = 0, left_out = 0;
  for (const int leaves : {1, 5, 60, 900}) {
    const TriangleMesh mesh = Heap(random, leaves);
    for (int i = 0; i < 150; ++i) {
      const Vector3d p = InCube(random, 12);
      const Bundle bundle(p, InCube(random, 3) - p, random.Uniform(0.01, 0.8));
      const BoxTree::Branches within = mesh.Within(bundle.beam);
      left_out += within.empty() ? 1 : 0;
      for (int k = 0; k < 20; ++k) {
        const Vector3d r = bundle.Ray(random);
        const TriangleMesh::Meeting expected = OfAll(mesh, p, r), fast = mesh.Cast(within, p, r);
        ASSERT_EQ(fast.s, expected.s) << leaves << " leaves, beam " << i;
        ASSERT_EQ(fast.triangle, expected.triangle);
        ASSERT_EQ(mesh.Cast(p, r).s, expected.s);
        ASSERT_EQ(mesh.Meets(p, r), std::isfinite(expected.s));
        met += std::isfinite(expected.s) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(met, 1000);
  EXPECT_GT(left_out, 100);
}

TEST(Beam, EntersEveryBoxThatARayOfItEnters) {
  RandomStream random(32);
  int beside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3d p = InCube(random, 5);
    const Bundle bundle(p, InCube(random, 1), random.Uniform(0.01, 0.5));
    const Vector3d corner = InCube(random, 5);
    const Eigen::AlignedBox3d box(corner, corner + Vector3d::Constant(random.Uniform(0.1, 3)));
    const bool may = bundle.beam.MayEnter(box);
    beside += may ? 0 : 1;
    for (int k = 0; k < 20; ++k) {
      const Vector3d inside = p + random.Uniform(0, 12) * bundle.Ray(random);
      ASSERT_TRUE(may || !box.contains(inside)) << i;
    }
  }
  EXPECT_GT(beside, 1000);
}

HeightField Rough(double size_m, double rms_m, std::uint64_t seed) {
  return HeightField({-10, -8, size_m, 7}, [=](double n, double e) {
    const double hole = std::hypot(n - 1, e + 2) < 0.6 ? -0.5 : 0.0;
    return rms_m * FractalNoise(n, e, seed, 4, 0.4, 0.8) + hole;
  });
}

TEST(Beam, RaysKnownToBeClearMeetReliefWhereTheyDoFromTheStart) {
  RandomStream random(33);
  int shortened = 0;
  for (const double rms_m : {0.0, 0.02, 0.3, 1.0}) {
    const HeightField field = Rough(16, rms_m, 5);
    for (int i = 0; i < 300; ++i) {
      // Every second one over a corner of cells, as a camera over the origin of W is.
      Vector3d p(random.Uniform(-20, 20), random.Uniform(-20, 20), -random.Uniform(1, 25));
      if (i % 2 == 0) {
        p.head<2>() = Eigen::Vector2d(std::floor(p.x()), std::floor(p.y()));
      }
      const Bundle bundle(p, {random.Normal(), random.Normal(), random.Uniform(0.1, 3)},
                          random.Uniform(0.01, 0.3));
      const double clear = field.ClearUpTo(bundle.beam);
      shortened += clear > 0 ? 1 : 0;
      for (int k = 0; k < 20; ++k) {
        const Vector3d r = bundle.Ray(random);
        const double s = field.Cast(p, r);
        ASSERT_GE(s, clear) << rms_m << " m, beam " << i;
        ASSERT_EQ(field.Cast(p, r, clear), s) << rms_m << " m, beam " << i;
      }
    }
  }
  EXPECT_GT(shortened, 600);
}

TEST(Beam, RaysThroughCornersOfCellsMeetReliefWhereTheyDoFromTheStart) {
  const HeightField field = Rough(16, 0.1, 6);
  const Vector3d p(2, 3, -9);
  const Beam beam(p, {Vector3d(-0.51, -0.51, 1), Vector3d(0.51, -0.51, 1), Vector3d(0.51, 0.51, 1),
                      Vector3d(-0.51, 0.51, 1)});
  const double clear = field.ClearUpTo(beam);
  ASSERT_GT(clear, 0);
  for (int x = -40; x <= 40; ++x) {
    for (int y = -40; y <= 40; ++y) {
      const Vector3d r(x / 80.0, y / 80.0, 1);
      ASSERT_EQ(field.Cast(p, r, clear), field.Cast(p, r)) << r.transpose();
    }
  }
}

TEST(Beam, OneThatPartlyGoesUpIsClearOfReliefNowhere) {
  const HeightField field = Rough(16, 0.1, 7);
  const Vector3d p(0, 0, -20);
  EXPECT_EQ(field.ClearUpTo(Bundle(p, {1, 0, 0.05}, 0.2).beam), 0);
  EXPECT_GT(field.ClearUpTo(Bundle(p, {1, 0, 0.5}, 0.2).beam), 0);
  EXPECT_LT(field.ClearUpTo(Bundle(p, {1, 0, 0.5}, 0.2).beam), kInfinity);
}

}  // namespace
}  // namespace palace
