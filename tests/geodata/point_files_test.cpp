// Point clouds as text and PLY. The many ways to be wrong are rows of survey_clouds_test.cpp,
// through the program; here that points come out as they stand in the file.
#include "engine/geodata/point_files.h"

#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/own_path.h"
#include "tests/support/survey_files.h"

namespace palace {
namespace {

class PointFiles : public testing::Test {
 protected:
  ~PointFiles() override {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  void Write(const std::string& bytes) { std::ofstream(path_, std::ios::binary) << bytes; }
  const std::filesystem::path path_ = OwnPath(".xyz");
};

TEST_F(PointFiles, EastNorthUpInEverySpelling) {
  const std::vector<Eigen::Vector3d> expected = {{1.5, -2, 3}, {4, 5, 6.25}, {7, 8, 9}};
  for (const std::string text :
       {"1.5 -2 3\n4 5 6.25\n7 8 9\n", "x,y,z\n1.5,-2,3\n4,5,6.25\n7,8,9\n",
        "# comment\n\n1.5;-2;3;17\n4;5;6.25;18\n7;8;9;19\n",
        "1.5\t-2\t3\r\n4\t5\t6.25\r\n7\t8\t9\r\n"}) {
    Write(text);
    const auto points = ReadPointFile(path_);
    ASSERT_TRUE(points.ok()) << text << points.error().message;
    EXPECT_EQ(*points, expected) << text;
  }
  Write(PlyBytes({1.5F, -2, 3, 4, 5, 6.25F, 7, 8, 9}, "binary_little_endian", 3));
  const auto points = ReadPointFile(path_);
  ASSERT_TRUE(points.ok()) << points.error().message;
  EXPECT_EQ(*points, expected);
}

// The same three points under every heading; no axis is taken for another, and no foot for a metre.
TEST_F(PointFiles, ColumnsAreTakenByTheirNames) {
  const std::vector<Eigen::Vector3d> expected = {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}};
  for (const std::string text :
       {"Northing,Easting,Height\n2,1,3\n5,4,6\n8,7,10\n", "y x z\n2 1 3\n5 4 6\n8 7 10\n",
        "id,x,y,z\n11,1,2,3\n12,4,5,6\n13,7,8,10\n",
        "z [m];y [m];x [m];intensity\n3;2;1;9\n6;5;4;9\n10;8;7;9\n",
        "Elevation (m) East North\n3 1 2\n6 4 5\n10 7 8\n",
        "Northing,Easting,Height\n# taken in May\n2,1,3\n5,4,6\n8,7,10\n",
        "Northing,Easting,Height\n(m),(m),(m)\n2,1,3\n5,4,6\n8,7,10\n",
        "//id x y z\n11 1 2 3\n12 4 5 6\n13 7 8 10\n", "\"x\",\"y\",\"z\"\n1,2,3\n4,5,6\n7,8,10\n",
        // Prose, and names that say nothing of three columns.
        "Survey of the north field\n1 2 3\n4 5 6\n7 8 10\n", "a b c\n1 2 3\n4 5 6\n7 8 10\n",
        "# north of the road\n1 2 3 4\n4 5 6 4\n7 8 10 4\n",
        "x y z class\n1 2 3 grass\n4 5 6 road\n7 8 10 road\n"}) {
    Write(text);
    const auto points = ReadPointFile(path_);
    ASSERT_TRUE(points.ok()) << text << points.error().message;
    EXPECT_EQ(*points, expected) << text;
  }
}

TEST_F(PointFiles, WhatHeadingsMakeDoubtfulIsRefused) {
  std::string many;
  for (int i = 0; i < 21; ++i) {
    many += "P" + std::to_string(i) + " 1 2 3\n";
  }
  const struct {
    std::string text;
    const char* said;
  } rows[] = {
      {"north,east,down\n1,2,3\n4,5,6\n7,8,9\n",
       ":1: column 3 is named \"down\"; heights must count upwards: write z = -down"},
      {"north,east,down\n# taken in May\n1,2,3\n4,5,6\n7,8,9\n", ":1: column 3 is named \"down\""},
      {"x,y,depth\n1,2,3\n4,5,6\n7,8,9\n", ":1: column 3 is named \"depth\"; heights must"},
      {"# note\nx,y,Height (ft)\n1,2,3\n4,5,6\n7,8,9\n",
       ":2: column 3 is named \"height\" in ft; metres are expected"},
      {"x,y,x\n1,2,3\n4,5,6\n7,8,9\n", ":1: no column is named z or height"},
      {"x,east,y,z\n1,2,3,4\n4,5,6,4\n7,8,9,4\n",
       ":1: column 2 is named \"east\", column 1 alike; which is x or east?"},
      {"Rechtswert Hochwert Hoehe Farbe\n1 2 3 4\n4 5 6 4\n7 8 9 4\n",
       ":1: no column is named x or east; name the columns x, y and z, or leave the heading out"},
      {"a b c x y z\n1 2 3 4\n4 5 6 4\n7 8 9 4\n", ":1: column 5, \"y\", has no number in the"},
      {many + "1 2 3\n4 5 6\n7 8 9\n", ":21: expected x y z, found \"P20 1 2 3\""},
      {"P1 1 2 3\nP2 4 5 6\n", ":1: expected x y z, found \"P1 1 2 3\""},
      {"1 2 3\r4 5 6\r7 8 9\r", ":1: lines end with a carriage return alone"},
      {std::string("II*\0 and more", 13),
       " is a TIFF; an elevation model is given with --elevation"},
      {"\x1F\x8B and more", " is packed by gzip; unpack it first"},
      {"\xFF\xFEx\0", " is UTF-16 text; save it as UTF-8"},
  };
  for (const auto& row : rows) {
    Write(row.text);
    const auto points = ReadPointFile(path_);
    ASSERT_FALSE(points.ok()) << row.text;
    EXPECT_EQ(points.error().message.find(path_.string() + row.said), 0u)
        << points.error().message << "\n instead of " << row.said;
  }
}

TEST_F(PointFiles, LabelsTellGroundFromObjects) {
  Write("1 2 3 1\n4 5 6 0\n");
  const auto points = ReadLabelledPoints(path_);
  ASSERT_TRUE(points.ok()) << points.error().message;
  ASSERT_EQ(points->size(), 2u);
  EXPECT_TRUE((*points)[0].ground);
  EXPECT_FALSE((*points)[1].ground);
  EXPECT_EQ((*points)[1].point, Eigen::Vector3d(4, 5, 6));
}

/// Devices never end, and nobody may ever write to a pipe.
TEST_F(PointFiles, OnlyFilesOnDiskAreRead) {
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  const struct {
    std::filesystem::path path;
    const char* said;
  } rows[] = {
      {path_, ": is no file on disk; save what it gives as a file and name that"},
      {"/dev/zero", ": is no file on disk"},
      {path_.parent_path(), ": is a folder; name a file in it"},
      {"/nowhere.xyz", ": no such file; check the name"},
  };
  for (const auto& row : rows) {
    const auto points = ReadPointFile(row.path);
    ASSERT_FALSE(points.ok()) << row.path;
    EXPECT_EQ(points.error().message.find(row.path.string() + row.said), 0u)
        << points.error().message;
    const auto labelled = ReadLabelledPoints(row.path);
    ASSERT_FALSE(labelled.ok()) << row.path;
    EXPECT_EQ(labelled.error().message.find(row.path.string() + row.said), 0u)
        << labelled.error().message;
  }
}

TEST_F(PointFiles, ErrorsNameFileAndLine) {
  Write("1 2 3 1\n4 5 6\n");
  const auto labelled = ReadLabelledPoints(path_);
  ASSERT_FALSE(labelled.ok());
  EXPECT_NE(labelled.error().message.find(path_.string() + ":2: "), std::string::npos)
      << labelled.error().message;
  Write("1 2 3\n1 2\n4 5 6\n");
  const auto plain = ReadPointFile(path_);
  ASSERT_FALSE(plain.ok());
  EXPECT_NE(plain.error().message.find(path_.string() + ":2: "), std::string::npos);
}

TEST_F(PointFiles, DataBeforeTheVerticesAreRefusedWhereverTheyStand) {
  for (const char* first : {"element b 1\nproperty int k\n",
                            "element a 0\nproperty int k\nelement b 1\nproperty int k\n"}) {
    Write("ply\nformat ascii 1.0\n" + std::string(first) +
          "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
          "7\n0 0 0\n1 0 0\n0 1 0\n");
    const auto points = ReadPointFile(path_);
    ASSERT_FALSE(points.ok()) << first;
    EXPECT_NE(points.error().message.find("the vertices must come first"), std::string::npos)
        << points.error().message;
  }
}

TEST_F(PointFiles, APlyHeaderThatSaysTwoThingsIsRefusedWithItsLine) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string rows = "0 0 0\n1 0 0\n0 1 0\n";
  const struct {
    std::string text;
    const char* said;
  } cases[] = {
      {"ply\nformat ascii 1.0\nformat binary_little_endian 1.0\nelement vertex 3\n" + xyz +
           "end_header\n" + rows,
       ":3: a second format, after that of line 2"},
      {"ply\nformat ascii 1.0\nelement vertex 3\n" + xyz + "element vertex 1\n" + xyz +
           "end_header\n" + rows + "9 9 9\n",
       ":7: a second element \"vertex\""},
      {"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n" + xyz + "end_header\n" + rows,
       ":5: a second property \"x\""},
      {"ply\nformat ascii 1.0\nelement vertex 3\n" + xyz + "end_header\n" + rows + "\n9 9 9\n",
       ":12: more data than the header counts (3 of \"vertex\")"},
      {PlyBytes({0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 9}, "binary_little_endian", 3),
       ": more data than the header counts (3 of \"vertex\")"},
  };
  for (const auto& wrong : cases) {
    Write(wrong.text);
    const auto points = ReadPointFile(path_);
    ASSERT_FALSE(points.ok()) << wrong.said;
    EXPECT_EQ(points.error().message.find(path_.string() + wrong.said), 0u)
        << points.error().message;
  }
  // Faces after the vertices, and blank lines at the end, are no mistake.
  Write("ply\nformat ascii 1.0\nelement vertex 3\n" + xyz +
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n" + rows +
        "3 0 1 2\n\n");
  EXPECT_TRUE(ReadPointFile(path_).ok());
}

TEST_F(PointFiles, HexadecimalNumbersAreRefusedWithTheirLine) {
  for (const auto& [text, line] : {std::pair{"1 2 3\n0x10 2 3\n4 5 6\n7 8 9\n", ":2: "},
                                   std::pair{"0x10 2 3\n1 2 3\n4 5 6\n7 8 9\n", ":1: "},
                                   std::pair{"1 2 3\n4 5 6\n7 8 -0X1p3\n1 1 1\n", ":3: "}}) {
    Write(text);
    const auto points = ReadPointFile(path_);
    ASSERT_FALSE(points.ok()) << text;
    EXPECT_EQ(points.error().message.find(path_.string() + line + "expected x y z, found"), 0u)
        << points.error().message;
  }
}

}  // namespace
}  // namespace palace
