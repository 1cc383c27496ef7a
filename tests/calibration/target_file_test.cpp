// TARGET.toml and the printed sheet.
#include "engine/calibration/target_file.h"

#include <gmock/gmock.h>

#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/calibration/target_sheet.h"

namespace palace {
namespace {

using testing::HasSubstr;

constexpr const char* kGood =
    "[target]\nkind = \"dots\"\ncolumns = 13\nrows = 10\npitch_m = 0.09\ndot_diameter_m = 0.045\n";

TEST(TargetFileTest, ReadsDotsAndChessboards) {
  const auto dots = ParseTargetText(kGood, "TARGET.toml");
  ASSERT_TRUE(dots.ok()) << dots.error().message;
  EXPECT_EQ(dots->kind, TargetKind::kDots);
  EXPECT_EQ(dots->point_count(), 130);
  EXPECT_EQ(dots->p_TQ(14), Eigen::Vector3d(0.09, 0.09, 0));
  EXPECT_EQ(dots->DotDiameter_m(3), 0.045);
  const auto board = ParseTargetText(
      "[target]\nkind = \"chessboard\"\ncolumns = 9\nrows = 6\npitch_m = 0.025\n", "T");
  ASSERT_TRUE(board.ok()) << board.error().message;
  EXPECT_EQ(board->DotDiameter_m(3), 0);
  const auto millimetres = ParseTargetText(
      "[target]\nkind = \"chessboard\"\ncolumns = 9\nrows = 6\npitch_m = 25\n", "T");
  ASSERT_FALSE(millimetres.ok());
  EXPECT_EQ(millimetres.error().message,
            "T:5: target.pitch_m = 25 is outside 0.001 .. 1; give metres from point to point");
}

TEST(TargetFileTest, WhatIsWrittenReadsTheSame) {
  CalibrationTarget target = DefaultTarget();
  const auto again = ParseTargetText(TargetToText(target), "T");
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ(again->columns, target.columns);
  EXPECT_EQ(again->rows, target.rows);
  EXPECT_EQ(again->pitch_m, target.pitch_m);
  EXPECT_EQ(again->dot_diameter_m, target.dot_diameter_m);
  EXPECT_EQ(again->mark_diameter_m, target.mark_diameter_m);
  EXPECT_EQ(again->marks, target.marks);
}

struct Damage {
  const char* name;
  const char* replace;
  const char* by;
  std::vector<const char*> says;
};

class DamagedTarget : public testing::TestWithParam<Damage> {};

TEST_P(DamagedTarget, IsRefusedWithPlaceAndRemedy) {
  const Damage& damage = GetParam();
  std::string text = kGood;
  const auto at = text.find(damage.replace);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string(damage.replace).size(), damage.by);
  const auto target = ParseTargetText(text, "TARGET.toml");
  ASSERT_FALSE(target.ok());
  for (const char* part : damage.says) {
    EXPECT_THAT(target.error().message, HasSubstr(part));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Rows, DamagedTarget,
    testing::Values(
        Damage{"NoTable", "[target]", "", {"TARGET.toml:3", "[target]"}},
        Damage{"BadHeader", "[target]", "[?]", {"TARGET.toml:1"}},
        Damage{"OtherTable", "[target]", "[board]", {"TARGET.toml:1", "board", "[target]"}},
        Damage{"Kind", "\"dots\"", "\"circles\"", {"TARGET.toml:2", "circles", "chessboard"}},
        Damage{"KindNumber", "\"dots\"", "3", {"TARGET.toml:2", "text in quotes"}},
        Damage{"NoColumns", "columns = 13\n", "", {"columns is missing"}},
        Damage{
            "Misspelled", "columns = 13", "colums = 13", {":3", "colums is not a key", "columns"}},
        Damage{"TooFew", "columns = 13", "columns = 2", {":3", "= 2", "3 .. 200"}},
        Damage{"TooMany", "rows = 10", "rows = 100000", {":4", "3 .. 200"}},
        Damage{"Fraction", "rows = 10", "rows = 9.5", {":4", "9.5", "whole"}},
        Damage{"NotANumber", "pitch_m = 0.09", "pitch_m = nan", {":5", "pitch_m"}},
        Damage{"Negative", "pitch_m = 0.09", "pitch_m = -1", {":5", "-1", "metres"}},
        Damage{
            "Millimetres", "pitch_m = 0.09", "pitch_m = 90", {":5", "pitch_m = 90", "0.001 .. 1;"}},
        Damage{"TooFine", "pitch_m = 0.09", "pitch_m = 0.0009", {":5", "0.001 .. 1;"}},
        Damage{"Text", "pitch_m = 0.09", "pitch_m = \"90 mm\"", {":5", "number"}},
        Damage{"DotsTouch", "0.045", "0.09", {":6", "0.0675", "0.75 of pitch_m"}},
        Damage{"DotsVanish", "0.045", "0.001", {":6", "0.009"}},
        Damage{"Unknown", "0.045", "0.045\nspacing = 3", {":7", "spacing", "known here"}},
        Damage{"DotsOnChessboard", "\"dots\"", "\"chessboard\"", {":6", "dot_diameter_m"}},
        Damage{"MarksAlone",
               "0.045",
               "0.045\nmarks = [[1,1],[3,1],[1,2]]",
               {"mark_diameter_m is missing"}},
        Damage{"MarksTurnAlike",
               "0.045",
               "0.045\nmarks = [[1,1],[3,1],[2,1]]\nmark_diameter_m = 0.06",
               {":7", "turned"}},
        Damage{"MarkOutside",
               "0.045",
               "0.045\nmarks = [[1,1],[3,1],[1,12]]\nmark_diameter_m = 0.06",
               {":7", "[1, 12]", "13 x 10"}},
        Damage{"MarkTwice",
               "0.045",
               "0.045\nmarks = [[1,1],[3,1],[1,1]]\nmark_diameter_m = 0.06",
               {":7", "twice"}},
        Damage{"MarkMalformed",
               "0.045",
               "0.045\nmarks = [[1,1],[3],[1,2]]\nmark_diameter_m = 0.06",
               {":7", "place 2"}},
        Damage{"MarkTooSmall",
               "0.045",
               "0.045\nmarks = [[1,1],[3,1],[1,2]]\nmark_diameter_m = 0.046",
               {":8", "1.2"}},
        Damage{"Truncated", "rows = 10", "rows =", {"TARGET.toml:4"}}),
    [](const auto& row) { return row.param.name; });

TEST(TargetFileTest, MissingFileIsNamed) {
  const auto target = LoadTargetFile("/nonexistent/TARGET.toml");
  ASSERT_FALSE(target.ok());
  EXPECT_THAT(target.error().message, HasSubstr("/nonexistent/TARGET.toml"));
}

int CountOf(const std::string& text, const std::string& part) {
  int count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(TargetSheetTest, IsInTrueMillimetresWithAScaleBar) {
  const auto sheet = TargetSheetSvg(DefaultTarget());
  ASSERT_TRUE(sheet.ok()) << sheet.error().message;
  EXPECT_THAT(*sheet, HasSubstr("width=\"297mm\" height=\"210mm\" viewBox=\"0 0 297 210\""));
  EXPECT_EQ(CountOf(*sheet, "<circle"), 77);
  EXPECT_EQ(CountOf(*sheet, "r=\"6\""), 74);
  EXPECT_EQ(CountOf(*sheet, "r=\"8.4\""), 3);
  EXPECT_THAT(*sheet, HasSubstr("100 mm: measure me"));
  EXPECT_THAT(*sheet, HasSubstr("width=\"100\""));
}

TEST(TargetSheetTest, ChessboardHasOneSquareMoreEachWay) {
  CalibrationTarget board;
  board.kind = TargetKind::kChessboard;
  board.columns = 9;
  board.rows = 6;
  board.pitch_m = 0.025;
  const auto sheet = TargetSheetSvg(board);
  ASSERT_TRUE(sheet.ok());
  EXPECT_EQ(CountOf(*sheet, "width=\"25\" height=\"25\""), 35);  // half of 10 x 7
}

TEST(TargetSheetTest, RefusesWhatNoPrinterTakes) {
  CalibrationTarget target = DefaultTarget();
  target.pitch_m = 1;
  const auto sheet = TargetSheetSvg(target);
  ASSERT_FALSE(sheet.ok());
  EXPECT_THAT(sheet.error().message, HasSubstr("5000 mm"));
}

}  // namespace
}  // namespace palace
