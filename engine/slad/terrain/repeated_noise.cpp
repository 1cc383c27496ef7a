#include "engine/slad/terrain/repeated_noise.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/core/median.h"
#include "engine/slad/side_by_side.h"

namespace palace {
namespace {

constexpr int kBlock = 16;                // places along a side
constexpr std::size_t kLeastPlaces = 64;  // of a block, or it says nothing
constexpr double kMedianOfSquare = 0.4549364;
constexpr double kMedianSigma = 2.33;  // of the median of squared normals, in it, of one
constexpr double kByChance = 3;        // sigmas that the median may have come out too small
/// Where the height itself answers to more of the other gradients, nothing is left to be asked.
constexpr double kLeastOwn = 0.25;

double Of(const FinePlace& place, int which) {
  return static_cast<double>(place.of[static_cast<std::size_t>(which)]);
}

/// The place's answer, squared, over its variance; NaN where there is none.
float SquaredAnswer(const FinePlace& place) {
  using P = FinePlace;
  const double net = Of(place, P::kNet), other = Of(place, P::kOtherGross);
  if (!(net > FineSum::kLeastNet)) {
    return kUnknownValue;
  }
  const double alike = Of(place, P::kShared) / net;
  const double variance =
      other - 2 * alike * Of(place, P::kShared) + alike * alike * Of(place, P::kGross);
  if (!(variance > kLeastOwn * other)) {
    return kUnknownValue;
  }
  const double answer = Of(place, P::kOther) - alike * Of(place, P::kOff);
  return static_cast<float>(answer * answer / variance);
}

/// Of each block; NaN where it says nothing.
GridF BlockTimes(const GridF& squared) {
  GridF times((squared.rows() + kBlock - 1) / kBlock, (squared.cols() + kBlock - 1) / kBlock,
              kUnknownValue);
  ForEach(times.rows(), [&](int i) {
    std::vector<float> answers;
    for (int j = 0; j < times.cols(); ++j) {
      answers.clear();
      for (int r = i * kBlock; r < std::min((i + 1) * kBlock, squared.rows()); ++r) {
        for (int c = j * kBlock; c < std::min((j + 1) * kBlock, squared.cols()); ++c) {
          const float answer = squared.at(r, c);
          if (!std::isnan(answer)) {
            answers.push_back(answer);
          }
        }
      }
      if (answers.size() >= kLeastPlaces) {
        const double by_chance =
            1 + kByChance * kMedianSigma / std::sqrt(static_cast<double>(answers.size()));
        const auto median = static_cast<double>(UpperMedian(answers));
        times.at(i, j) = static_cast<float>(std::max(1.0, by_chance * median / kMedianOfSquare));
      }
    }
  });
  return times;
}

void FillUnknown(GridF& times) {
  std::vector<float> known;
  for (const float t : times.cells()) {
    if (!std::isnan(t)) {
      known.push_back(t);
    }
  }
  const float middle = known.empty() ? 1.0F : UpperMedian(known);
  for (float& t : times.cells()) {
    t = std::isnan(t) ? middle : t;
  }
}

}  // namespace

GridF VarianceTimes(const Grid<FinePlace>& places) {
  GridF squared(places.rows(), places.cols());
  ForEach(squared.rows(), [&](int r) {
    for (int c = 0; c < squared.cols(); ++c) {
      squared.at(r, c) = SquaredAnswer(places.at(r, c));
    }
  });
  GridF blocks = BlockTimes(squared);
  FillUnknown(blocks);
  GridF times(places.rows(), places.cols());
  const auto between = [](int place, int blocks_count) {
    const float at = std::clamp((static_cast<float>(place) + 0.5F) / kBlock - 0.5F, 0.0F,
                                static_cast<float>(blocks_count - 1));
    const int low = std::min(static_cast<int>(at), std::max(0, blocks_count - 2));
    return std::pair{low, at - static_cast<float>(low)};
  };
  ForEach(places.rows(), [&](int r) {
    const auto [i, down] = between(r, blocks.rows());
    const int below = std::min(i + 1, blocks.rows() - 1);
    for (int c = 0; c < places.cols(); ++c) {
      const auto [j, right] = between(c, blocks.cols());
      const int beside = std::min(j + 1, blocks.cols() - 1);
      times.at(r, c) =
          (1 - down) * ((1 - right) * blocks.at(i, j) + right * blocks.at(i, beside)) +
          down * ((1 - right) * blocks.at(below, j) + right * blocks.at(below, beside));
    }
  });
  return times;
}

Grid<FineKnown> WithRepeatedNoise(const Grid<FinePlace>& places) {
  using P = FinePlace;
  const GridF times = VarianceTimes(places);
  Grid<FineKnown> known(places.rows(), places.cols());
  ForEach(known.rows(), [&](int r) {
    for (int c = 0; c < known.cols(); ++c) {
      const auto& of = places.at(r, c).of;
      known.at(r, c) = {of[P::kNet], times.at(r, c) * of[P::kGross], of[P::kHeight], of[P::kOff]};
    }
  });
  return known;
}

}  // namespace palace
