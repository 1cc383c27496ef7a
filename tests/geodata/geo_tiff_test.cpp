// GeoTIFF: what is written is read back, place and gaps included. What other programs write, and
// what is refused, the scenarios show (survey_models_test.cpp).
#include "engine/geodata/geo_tiff.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/own_path.h"
#include "tests/support/survey_files.h"

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

TEST_F(GeoTiff, ACornerLiesOnEarthHoweverItsZonesAreCounted) {
  const struct {
    std::vector<double> tie;
    const char* said;  ///< null: it is read
  } rows[] = {
      {{0, 0, 0, 500000, -9.9e6, 0}, nullptr},
      {{0, 0, 0, 120.5e6, 4e6, 0}, nullptr},  // zone 120 of three degrees
      {{0, 0, 0, 1e15, 2000, 0},
       "its corner lies at east 1e+15 m, north 2000 m; places lie within"},
      {{0, 0, 0, 1000, -1e300, 0}, "its corner lies at east 1000 m, north -1e+300 m"},
      {{0, 0, 0, NAN, 2000, 0}, "its corner is not a finite place"},
  };
  for (const auto& row : rows) {
    TiffFile tiff;
    tiff.cols = tiff.rows = 2;
    tiff.cells = BytesOf<float>({1, 2, 3, 4});
    tiff.tie = row.tie;
    std::ofstream(path_, std::ios::binary) << TiffBytes(tiff, {{1024, 1}, {1025, 1}});
    const auto read = ReadGeoTiff(path_);
    ASSERT_EQ(read.ok(), row.said == nullptr) << row.tie[3] << " " << row.tie[4];
    if (read.ok()) {
      EXPECT_EQ(read->geometry.east_min_m, row.tie[3]);
    } else {
      EXPECT_NE(read.error().message.find(path_.string() + ": " + row.said), std::string::npos)
          << read.error().message;
    }
  }
}

TEST_F(GeoTiff, NoDataIsANumberOrNotGiven) {
  const struct {
    const char* no_data;
    int unknown;       ///< cells of 0 -9999 3 NaN
    const char* said;  ///< null: it is read
  } rows[] = {
      {"", 1, nullptr},
      {" ", 1, nullptr},
      {"-9999", 2, nullptr},
      {"-9.999e3 ", 2, nullptr},
      {"nan", 1, nullptr},
      {"-1.#IND", 1, nullptr},
      {"none", 0, ": its no-data value \"none\" is no number; correct it with gdal_edit.py"},
      {"-9999 m", 0, ": its no-data value \"-9999 m\" is no number"},
  };
  for (const auto& row : rows) {
    TiffFile tiff;
    tiff.cols = tiff.rows = 2;
    tiff.cells = BytesOf<float>({0, -9999, 3, NAN});
    tiff.no_data = row.no_data;
    std::ofstream(path_, std::ios::binary) << TiffBytes(tiff, {{1024, 1}, {1025, 1}});
    const auto read = ReadGeoTiff(path_);
    ASSERT_EQ(read.ok(), row.said == nullptr)
        << row.no_data << (read.ok() ? "" : ": " + read.error().message);
    if (read.ok()) {
      const auto& cells = read->cells.cells();
      EXPECT_EQ(std::count_if(cells.begin(), cells.end(), [](float z) { return std::isnan(z); }),
                row.unknown)
          << row.no_data;
    } else {
      EXPECT_NE(read.error().message.find(path_.string() + row.said), std::string::npos)
          << read.error().message;
    }
  }
}

TEST_F(GeoTiff, WhatCannotBeWrittenOrReadIsNamed) {
  const Status written = WriteGeoTiff("/no/such/folder/a.tif", {{1, 1, 1, 0, 0}, GridF(1, 1), {}});
  ASSERT_FALSE(written.ok());
  EXPECT_NE(written.error().message.find("/no/such/folder/a.tif"), std::string::npos);
  const auto read = ReadGeoTiff(path_);
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find(path_.string() + ": no such file"), std::string::npos)
      << read.error().message;
  const auto device = ReadGeoTiff("/dev/zero");
  ASSERT_FALSE(device.ok());
  EXPECT_NE(device.error().message.find("/dev/zero: is no file on disk"), std::string::npos);
}

}  // namespace
}  // namespace palace
