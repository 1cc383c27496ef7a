// Triples and quadruples of a 3x3 window, for the exact LMedS fit; known to the compiler, so that
// the fit is straight-line code. Internal to the SLAD room.
#pragma once

namespace palace {
namespace {  // each instruction set has its own

constexpr int kWindowPoints = 9;
// Points 0..8 run row by row; x is columns east of the middle, y is rows south of it.
constexpr int WindowX(int i) { return i % 3 - 1; }
constexpr int WindowY(int i) { return i / 3 - 1; }

/// Twice the signed area of a triple; 0 when collinear.
constexpr int WindowArea(int i, int j, int k) {
  return (WindowX(j) - WindowX(i)) * (WindowY(k) - WindowY(i)) -
         (WindowX(k) - WindowX(i)) * (WindowY(j) - WindowY(i));
}

/// Four points and the weights of their heights in D: the 4x4 determinant of rows (1, x, y, z).
struct WindowQuadruple {
  int point[4] = {};
  int weight[4] = {};
};

/// Three points not in line, twice their area, and the quadruples they form with each other point.
struct WindowTriple {
  int point[3] = {};
  int area = 0;  ///< without sign
  int quadruple[6] = {};
};

/// The plane through a triple: height, east and south are sums of weight times the three heights.
struct TriplePlane {
  double height[3] = {};
  double east[3] = {};
  double south[3] = {};
};

constexpr int kQuadruples = 126;
constexpr int kTriples = 76;
struct LmedsTables {
  WindowQuadruple quadruples[kQuadruples];
  WindowTriple triples[kTriples];
  TriplePlane planes[kTriples];
};

constexpr TriplePlane PlaneThroughTriple(int i, int j, int k) {
  const double area = WindowArea(i, j, k);
  TriplePlane plane;
  const int point[3] = {i, j, k};
  for (int n = 0; n < 3; ++n) {
    const int a = point[(n + 1) % 3], b = point[(n + 2) % 3];
    plane.east[n] = (WindowY(a) - WindowY(b)) / area;
    plane.south[n] = (WindowX(b) - WindowX(a)) / area;
    plane.height[n] = (WindowX(a) * WindowY(b) - WindowX(b) * WindowY(a)) / area;
  }
  return plane;
}

constexpr LmedsTables MakeLmedsTables() {
  LmedsTables tables;
  int index_of_set[1 << kWindowPoints] = {};
  int count = 0;
  for (int i = 0; i < kWindowPoints; ++i) {
    for (int j = i + 1; j < kWindowPoints; ++j) {
      for (int k = j + 1; k < kWindowPoints; ++k) {
        for (int m = k + 1; m < kWindowPoints; ++m) {
          index_of_set[1 << i | 1 << j | 1 << k | 1 << m] = count;
          tables.quadruples[count++] = {{i, j, k, m},
                                        {WindowArea(j, k, m), -WindowArea(i, k, m),
                                         WindowArea(i, j, m), -WindowArea(i, j, k)}};
        }
      }
    }
  }
  count = 0;
  for (int i = 0; i < kWindowPoints; ++i) {
    for (int j = i + 1; j < kWindowPoints; ++j) {
      for (int k = j + 1; k < kWindowPoints; ++k) {
        const int area = WindowArea(i, j, k);
        if (area == 0) {
          continue;
        }
        WindowTriple triple{{i, j, k}, area < 0 ? -area : area, {}};
        int others = 0;
        for (int m = 0; m < kWindowPoints; ++m) {
          if (m != i && m != j && m != k) {
            triple.quadruple[others++] = index_of_set[1 << i | 1 << j | 1 << k | 1 << m];
          }
        }
        tables.planes[count] = PlaneThroughTriple(i, j, k);
        tables.triples[count++] = triple;
      }
    }
  }
  return tables;
}

constexpr LmedsTables kLmeds = MakeLmedsTables();

}  // namespace
}  // namespace palace
