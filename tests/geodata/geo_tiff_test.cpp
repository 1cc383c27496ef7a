// GeoTIFF: what is written is read back, place and gaps included. What other programs write, and
// what is refused, the scenarios show (survey_models_test.cpp).
#include "engine/geodata/geo_tiff.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/support/own_path.h"

namespace palace {
namespace {

class GeoTiff : public testing::Test {
 protected:
  ~GeoTiff() override {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  const std::filesystem::path path_ = OwnPath(".tif");
};

TEST_F(GeoTiff, ComesBackWithPlaceGapsAndCoordinateSystem) {
  for (const std::optional<int> epsg : {std::optional<int>(), std::optional<int>(32612)}) {
    MapLayer layer{{3, 4, 0.15, -7.5, 12.25}, GridF(3, 4, 0.0F), epsg};
    for (std::size_t i = 0; i < layer.cells.cells().size(); ++i) {
      layer.cells.cells()[i] = 0.1F * static_cast<float>(i) - 0.3F;
    }
    layer.cells.at(1, 2) = kUnknownValue;
    ASSERT_TRUE(WriteGeoTiff(path_, layer).ok());
    const auto read = ReadGeoTiff(path_);
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->geometry.rows, 3);
    EXPECT_EQ(read->geometry.cols, 4);
    EXPECT_NEAR(read->geometry.cell_m, 0.15, 1e-12);
    EXPECT_NEAR(read->geometry.north_min_m, -7.5, 1e-9);
    EXPECT_NEAR(read->geometry.east_min_m, 12.25, 1e-9);
    EXPECT_EQ(read->epsg, epsg);
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 4; ++c) {
        EXPECT_EQ(std::isnan(read->cells.at(r, c)), r == 1 && c == 2);
        if (!std::isnan(read->cells.at(r, c))) {
          EXPECT_EQ(read->cells.at(r, c), layer.cells.at(r, c));
        }
      }
    }
  }
}

TEST_F(GeoTiff, WhatCannotBeWrittenOrReadIsNamed) {
  const Status written = WriteGeoTiff("/no/such/folder/a.tif", {{1, 1, 1, 0, 0}, GridF(1, 1), {}});
  ASSERT_FALSE(written.ok());
  EXPECT_NE(written.error().message.find("/no/such/folder/a.tif"), std::string::npos);
  const auto read = ReadGeoTiff(path_);
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find(path_.string()), std::string::npos);
}

}  // namespace
}  // namespace palace
