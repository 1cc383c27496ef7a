// Triples and quadruples of a 3x3 window, for the exact LMedS fit. Internal to the SLAD room.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace palace::lmeds {

// Points 0..8 run row by row; x is columns east of the middle, y is rows south of it.
inline constexpr int kPoints = 9;
inline constexpr int X(int i) { return i % 3 - 1; }
inline constexpr int Y(int i) { return i / 3 - 1; }

/// Twice the signed area of a triple; 0 when collinear.
inline constexpr int Area(int i, int j, int k) {
  return (X(j) - X(i)) * (Y(k) - Y(i)) - (X(k) - X(i)) * (Y(j) - Y(i));
}

/// Four points and the weights of their heights in D: the 4x4 determinant of rows (1, x, y, z).
struct Quadruple {
  std::array<int, 4> point{};
  std::array<float, 4> weight{};
};
/// Three points not in line, 1/|area|, and the quadruples they form with each of the other six.
struct Triple {
  std::array<int, 3> point{};
  float inverse_area = 0;
  std::array<int, 6> quadruple{};
};

inline constexpr int kQuadruples = 126;
inline constexpr int kTriples = 76;
struct Tables {
  std::array<Quadruple, kQuadruples> quadruples{};
  std::array<Triple, kTriples> triples{};
};

constexpr int QuadrupleIndex(int a, int b, int c, int d) {
  int index = 0;
  for (int i = 0; i < kPoints; ++i) {
    for (int j = i + 1; j < kPoints; ++j) {
      for (int k = j + 1; k < kPoints; ++k) {
        for (int m = k + 1; m < kPoints; ++m) {
          if (i == a && j == b && k == c && m == d) {
            return index;
          }
          ++index;
        }
      }
    }
  }
  return -1;
}

inline Tables MakeTables() {
  Tables tables;
  int count = 0;
  for (int i = 0; i < kPoints; ++i) {
    for (int j = i + 1; j < kPoints; ++j) {
      for (int k = j + 1; k < kPoints; ++k) {
        for (int m = k + 1; m < kPoints; ++m) {
          tables.quadruples[static_cast<std::size_t>(count++)] = {
              {i, j, k, m},
              {static_cast<float>(Area(j, k, m)), static_cast<float>(-Area(i, k, m)),
               static_cast<float>(Area(i, j, m)), static_cast<float>(-Area(i, j, k))}};
        }
      }
    }
  }
  count = 0;
  for (int i = 0; i < kPoints; ++i) {
    for (int j = i + 1; j < kPoints; ++j) {
      for (int k = j + 1; k < kPoints; ++k) {
        const int area = Area(i, j, k);
        if (area == 0) {
          continue;
        }
        Triple triple{{i, j, k}, 1.0F / static_cast<float>(area < 0 ? -area : area), {}};
        int others = 0;
        for (int m = 0; m < kPoints; ++m) {
          if (m == i || m == j || m == k) {
            continue;
          }
          std::array<int, 4> four{i, j, k, m};
          for (int s = 3;
               s > 0 && four[static_cast<std::size_t>(s)] < four[static_cast<std::size_t>(s) - 1];
               --s) {
            std::swap(four[static_cast<std::size_t>(s)], four[static_cast<std::size_t>(s) - 1]);
          }
          triple.quadruple[static_cast<std::size_t>(others++)] =
              QuadrupleIndex(four[0], four[1], four[2], four[3]);
        }
        tables.triples[static_cast<std::size_t>(count++)] = triple;
      }
    }
  }
  return tables;
}

}  // namespace palace::lmeds
