#include "engine/stereo/speckles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace palace {
namespace {

/// Neighbouring pixels of one row that belong together.
struct Run {
  int row;
  int first;
  int end;
  int parent;  ///< index of a run of the same patch; itself for the root
  int area;    ///< of the whole patch, at the root
};

int Root(std::vector<Run>& runs, int run) {
  auto parent = [&](int k) -> int& { return runs[static_cast<std::size_t>(k)].parent; };
  while (parent(run) != run) {
    parent(run) = parent(parent(run));
    run = parent(run);
  }
  return run;
}

void Join(std::vector<Run>& runs, int a, int b) {
  a = Root(runs, a);
  b = Root(runs, b);
  if (a != b) {
    Run& first = runs[static_cast<std::size_t>(std::min(a, b))];
    Run& second = runs[static_cast<std::size_t>(std::max(a, b))];
    second.parent = std::min(a, b);
    first.area += second.area;
  }
}

void FindRuns(const float* row, int width, int y, float step, std::vector<Run>& runs) {
  int x = 0;
  while (x < width) {
    if (std::isnan(row[x])) {
      ++x;
      continue;
    }
    const int first = x++;
    while (x < width && std::abs(row[x] - row[x - 1]) <= step) {  // false for NaN
      ++x;
    }
    const int index = static_cast<int>(runs.size());
    runs.push_back({y, first, x, index, x - first});
  }
}

/// Joins runs of two neighbouring rows that touch somewhere.
void JoinRows(const ImageF& image, std::vector<Run>& runs, std::size_t above, std::size_t here,
              float step) {
  const std::size_t end = runs.size();
  std::size_t a = above, b = here;
  while (a < here && b < end) {
    const Run upper = runs[a], lower = runs[b];
    const float* up = image.row(upper.row);
    const float* down = image.row(lower.row);
    const int stop = std::min(upper.end, lower.end);
    for (int x = std::max(upper.first, lower.first); x < stop; ++x) {
      if (std::abs(up[x] - down[x]) <= step) {
        Join(runs, static_cast<int>(a), static_cast<int>(b));
        break;
      }
    }
    ++(upper.end <= lower.end ? a : b);
  }
}

}  // namespace

void RemoveSpeckles(ImageF& disparity_px, int least_area_px, float largest_step_px) {
  std::vector<Run> runs;
  runs.reserve(static_cast<std::size_t>(disparity_px.height()) * 8);
  std::size_t above = 0;
  for (int y = 0; y < disparity_px.height(); ++y) {
    const std::size_t here = runs.size();
    FindRuns(disparity_px.row(y), disparity_px.width(), y, largest_step_px, runs);
    JoinRows(disparity_px, runs, above, here, largest_step_px);
    above = here;
  }
  for (int k = 0; k < static_cast<int>(runs.size()); ++k) {
    const Run& run = runs[static_cast<std::size_t>(k)];
    if (runs[static_cast<std::size_t>(Root(runs, k))].area < least_area_px) {
      std::fill(disparity_px.row(run.row) + run.first, disparity_px.row(run.row) + run.end,
                std::numeric_limits<float>::quiet_NaN());
    }
  }
}

}  // namespace palace
