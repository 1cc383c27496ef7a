#include "engine/slad/pictures/cell_texture.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

constexpr GridGeometry kMap{2, 3, 0.15, 0, 0};

/// Blocks of one row, all judged.
BlockTexture Blocks(std::vector<float> alike) {
  const int n = static_cast<int>(alike.size());
  BlockTexture texture{Image<TextureSeen>(n, 1), ImageU8(n, 1, 1), ImageU8(n, 1, 0)};
  for (int i = 0; i < n; ++i) {
    texture.seen.at(i, 0) = {alike[static_cast<std::size_t>(i)], 0.5F, 0.25F, 0.75F};
  }
  return texture;
}

TEST(CellTexture, BlocksOfACellTakeItsMean) {
  CellTexture memory;
  memory.MoveTo(kMap);
  BlockTexture texture = Blocks({0.1F, 0.3F, 0.8F, 0.6F});
  texture.judged.at(3, 0) = 0;
  memory.Add({2, 2, -1, 2}, texture);
  EXPECT_FLOAT_EQ(texture.seen.at(0, 0).alike, 0.2F);
  EXPECT_FLOAT_EQ(texture.seen.at(1, 0).alike, 0.2F);
  EXPECT_FLOAT_EQ(texture.seen.at(2, 0).alike, 0.8F);  // off the map: its own
  EXPECT_FLOAT_EQ(texture.seen.at(3, 0).alike, 0.6F);  // not judged: left alone, and not counted
  EXPECT_FLOAT_EQ(texture.seen.at(0, 0).alike_halved, 0.5F);
  EXPECT_FLOAT_EQ(texture.seen.at(0, 0).known_share, 0.25F);
  EXPECT_FLOAT_EQ(texture.seen.at(0, 0).contrast, 0.75F);
}

// Seed 5: of a cell whose pairs scatter by 0.08 about 0.30, every fourth is below 0.25; of the mean
// over ten maps hardly one is, and it follows what changes within two seconds.
TEST(CellTexture, ScattersLessThanOnePairAndFollows) {
  RandomStream random(5, "texture");
  CellTexture memory;
  memory.MoveTo(kMap);
  int alone = 0, together = 0;
  for (int map = 0; map < 500; ++map) {
    const auto seen = static_cast<float>(0.30 + 0.08 * random.Normal());
    BlockTexture texture = Blocks({seen});
    memory.Add({0}, texture);
    alone += seen < 0.25F ? 1 : 0;
    together += map >= 10 && texture.seen.at(0, 0).alike < 0.25F ? 1 : 0;
  }
  EXPECT_GT(alone, 100);
  EXPECT_LT(together, 10);
  BlockTexture texture;
  for (int map = 0; map < 20; ++map) {
    texture = Blocks({0.05F});
    memory.Add({0}, texture);
  }
  EXPECT_LT(texture.seen.at(0, 0).alike, 0.1F);
}

TEST(CellTexture, MovesWithTheMapAndForgetsWhatLeavesIt) {
  CellTexture memory;
  memory.MoveTo(kMap);
  BlockTexture texture = Blocks({0.1F});
  memory.Add({1}, texture);
  GridGeometry east = kMap;
  east.east_min_m += 0.15;
  memory.MoveTo(east);
  texture = Blocks({0.3F});
  memory.Add({0}, texture);
  EXPECT_FLOAT_EQ(texture.seen.at(0, 0).alike, 0.2F);  // of two maps
  east.east_min_m += 3;
  memory.MoveTo(east);
  texture = Blocks({0.3F});
  memory.Add({0}, texture);
  EXPECT_FLOAT_EQ(texture.seen.at(0, 0).alike, 0.3F);
  memory.Reset();
  memory.MoveTo(kMap);
  texture = Blocks({0.4F});
  memory.Add({1}, texture);
  EXPECT_FLOAT_EQ(texture.seen.at(0, 0).alike, 0.4F);
}

}  // namespace
}  // namespace palace
