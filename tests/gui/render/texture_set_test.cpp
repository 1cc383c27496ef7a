#include "gui/render/texture_set.h"

#include "tests/gui/render/gl_fixture.h"

namespace palace {
namespace {

class TextureSetTest : public GlTest {};

ImageRgba Content(GLuint name, int width, int height) {
  ImageRgba picture(width, height);
  glBindTexture(GL_TEXTURE_2D, name);
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, picture.pixels().data());
  return picture;
}

GLint MagFilter(GLuint name) {
  GLint filter = 0;
  glBindTexture(GL_TEXTURE_2D, name);
  glGetTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, &filter);
  return filter;
}

std::shared_ptr<TerrainDecision> Decision(float safe_distance_m, std::uint8_t reason) {
  auto elevation = std::make_shared<ElevationMap>();
  elevation->geometry = {3, 4, 0.5, 0, 0};
  elevation->height_m = GridF(3, 4, 0.2F);
  auto hazards = std::make_shared<HazardMaps>();
  hazards->geometry = elevation->geometry;
  for (GridF* layer : {&hazards->slope_rad, &hazards->roughness_m, &hazards->cost}) {
    *layer = GridF(3, 4, 0.1F);
  }
  hazards->safe_distance_m = GridF(3, 4, safe_distance_m);
  hazards->reasons = Grid<std::uint8_t>(3, 4, reason);
  hazards->ground = Grid<GroundClass>(
      3, 4, reason == kHazardNone ? GroundClass::kLandable : GroundClass::kHazard);
  auto decision = std::make_shared<TerrainDecision>();
  decision->elevation = elevation;
  decision->hazards = hazards;
  return decision;
}

TEST_F(TextureSetTest, NothingToShowIsZero) {
  TextureSet textures;
  textures.Update(EngineSnapshot{});
  EXPECT_EQ(textures.names().left_camera, 0U);
  EXPECT_EQ(textures.names().maps[4], 0U);
  EXPECT_EQ(textures.names().difference, 0U);
}

TEST_F(TextureSetTest, UploadsOncePerPicture) {
  TextureSet textures;
  EngineSnapshot snapshot;
  auto picture = std::make_shared<ImageU8>(5, 3, std::uint8_t{7});
  snapshot.sensors.Edit().left_rectified = picture;
  textures.Update(snapshot);
  const GLuint name = textures.names().left_camera;
  ASSERT_NE(name, 0U);
  EXPECT_EQ(Content(name, 5, 3).at(4, 2).r, 7);
  picture->at(4, 2) = 99;  // same pointer: the engine promises it does not change
  textures.Update(snapshot);
  EXPECT_EQ(Content(name, 5, 3).at(4, 2).r, 7);
  snapshot.sensors.Edit().left_rectified = std::make_shared<ImageU8>(5, 3, std::uint8_t{42});
  textures.Update(snapshot);
  EXPECT_EQ(Content(textures.names().left_camera, 5, 3).at(0, 0).r, 42);
  snapshot.sensors.Edit().left_rectified = std::make_shared<ImageU8>(8, 6, std::uint8_t{50});
  textures.Update(snapshot);
  EXPECT_EQ(Content(textures.names().left_camera, 8, 6).at(7, 5).r, 50);
}

TEST_F(TextureSetTest, RawPicturesStandInBeforeRectifiedOnes) {
  TextureSet textures;
  EngineSnapshot snapshot;
  snapshot.sensors.Edit().frame = std::make_shared<StereoFrame>(
      StereoFrame{{}, ImageU8(4, 4, std::uint8_t{11}), ImageU8(4, 4, std::uint8_t{22})});
  textures.Update(snapshot);
  EXPECT_EQ(Content(textures.names().left_camera, 4, 4).at(0, 0).r, 11);
  EXPECT_EQ(Content(textures.names().right_camera, 4, 4).at(0, 0).r, 22);
}

TEST_F(TextureSetTest, NoSmoothingAboveTwoHundredPercentNorOnMaps) {
  TextureSet textures;
  EngineSnapshot snapshot;
  snapshot.sensors.Edit().left_rectified = std::make_shared<ImageU8>(4, 4);
  snapshot.terrain.Edit().applied = Decision(1, kHazardNone);
  textures.Update(snapshot, 1.5);
  EXPECT_EQ(MagFilter(textures.names().left_camera), GL_LINEAR);
  EXPECT_EQ(MagFilter(textures.names().maps[0]), GL_NEAREST);
  textures.Update(snapshot, 2.5);
  EXPECT_EQ(MagFilter(textures.names().left_camera), GL_NEAREST);
}

TEST_F(TextureSetTest, PreviewComesBeforeApplied) {
  TextureSet textures;
  EngineSnapshot snapshot;
  snapshot.terrain.Edit().applied = Decision(0, kHazardNone);
  snapshot.terrain.Edit().preview = Decision(99, kHazardNone);
  textures.Update(snapshot);
  EXPECT_EQ(Content(textures.names().maps[4], 4, 3).at(0, 0), RgbaFromHex(0x0A2250));
  snapshot.terrain.Edit().preview = nullptr;
  textures.Update(snapshot);
  EXPECT_EQ(Content(textures.names().maps[4], 4, 3).at(0, 0), RgbaFromHex(0xDCE9F7));
}

TEST_F(TextureSetTest, RecordedAgainstReDecided) {
  TextureSet textures;
  EngineSnapshot snapshot;
  snapshot.terrain.Edit().applied = Decision(1, kHazardSlope);
  snapshot.terrain.Edit().recorded = Decision(99, kHazardNone);
  textures.Update(snapshot);
  EXPECT_EQ(Content(textures.names().difference, 4, 3).at(3, 2), RgbaFromHex(0xF0963C));
  EXPECT_EQ(Content(textures.names().recorded_safe_distance, 4, 3).at(0, 0), RgbaFromHex(0x0A2250));
}

TEST_F(TextureSetTest, RangeIsTintedOnlyWhileAskedFor) {
  TextureSet textures;
  EngineSnapshot snapshot;
  auto range = std::make_shared<RangeMap>();
  range->depth_m = ImageF(4, 3);
  for (int i = 0; i < 12; ++i) {
    range->depth_m.pixels()[static_cast<std::size_t>(i)] = i == 11 ? NAN : 10.0F;
  }
  snapshot.terrain.Edit().range = range;
  textures.Update(snapshot);
  EXPECT_EQ(textures.names().range_tint, 0U);
  textures.ShowRange(true);
  textures.Update(snapshot);
  ASSERT_NE(textures.names().range_tint, 0U);
  EXPECT_LE(textures.names().range_tint_m.low, 10.0F);
  EXPECT_GT(textures.names().range_tint_m.high, textures.names().range_tint_m.low);
  const ImageRgba tint = Content(textures.names().range_tint, 4, 3);
  EXPECT_GT(tint.at(0, 0).a, 100);
  EXPECT_EQ(tint.at(3, 2).a, 0) << "unknown depth has no colour";
  textures.ShowRange(false);
  textures.Update(snapshot);
  EXPECT_EQ(textures.names().range_tint, 0U);
}

TEST_F(TextureSetTest, ElevationRangeIsSetOncePerMission) {
  TextureSet textures;
  EngineSnapshot snapshot;
  snapshot.terrain.Edit().applied = Decision(1, kHazardNone);
  textures.Update(snapshot);
  const float low = textures.ranges().elevation_m.low;
  auto higher = Decision(1, kHazardNone);
  auto raised = std::make_shared<ElevationMap>(*higher->elevation);
  raised->height_m = GridF(3, 4, 50.0F);
  higher->elevation = raised;
  snapshot.terrain.Edit().applied = higher;
  textures.Update(snapshot);
  EXPECT_EQ(textures.ranges().elevation_m.low, low);
  textures.Reset();
  textures.Update(snapshot);
  EXPECT_FLOAT_EQ(textures.ranges().elevation_m.low, 49.5F);
}

}  // namespace
}  // namespace palace
