#include "engine/experiments/thesis_pictures.h"

#include <memory>
#include <numbers>

#include "engine/camera/pinhole.h"
#include "engine/capture/picture_file.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/experiments/field_trial.h"
#include "engine/experiments/ground_field.h"
#include "engine/survey/map_layers.h"
#include "engine/survey/map_pictures.h"
#include "engine/world/families/families.h"
#include "engine/world/families/view_plan.h"

namespace palace {
namespace {

namespace fs = std::filesystem;
using Pictures = std::vector<ThesisPicture>;

ViewPlan ViewOfThesis() {
  ViewPlan view;
  view.height_m = 50 * kMetresPerFoot;
  view.tilt_rad = -std::numbers::pi / 4;
  view.camera = PinholeFromFov(640, 480, std::numbers::pi / 4);
  view.exposure.noise_grey = 2;
  view.attitude_error_rad = Rad(0.1);
  view.position_error_m = 0.03;
  return view;
}

/// One world, looked at and judged.
struct Look {
  std::vector<FieldFrame> frames;
  std::shared_ptr<const TerrainDecision> thesis;  ///< of the newest pair, as the thesis has it
  std::shared_ptr<const TerrainDecision> modern;  ///< of all ten
  const SceneView& newest() const { return frames.back().input.view; }
};

Result<Look> LookAt(const char* family, std::uint64_t seed) {
  const Result<World> world = MakeFamily(family, seed);
  if (!world) {
    return world.error();
  }
  Settings settings;
  Result<std::vector<FieldFrame>> frames =
      LookAtGround(*world, ViewOfThesis(), 1, settings.stereo, seed);
  if (!frames) {
    return frames.error();
  }
  Look look{std::move(*frames), nullptr, nullptr};
  look.modern = DecideOnField(look.frames, settings);
  settings.slad.mode = SladMode::kThesis;
  look.thesis = DecideOnField(look.frames, settings);
  return look;
}

Status WriteOverlayOf(const Look& look, const TerrainDecision& decision, const fs::path& file) {
  return WriteOverlay(file, *look.newest().left, decision.selection, *look.newest().range,
                      *decision.verdict);
}

GridF RangesOf(const RangeMap& range) {
  GridF cells(range.depth_m.height(), range.depth_m.width());
  for (int row = 0; row < cells.rows(); ++row) {
    for (int col = 0; col < cells.cols(); ++col) {
      cells.at(row, col) = range.depth_m.at(col, row);
    }
  }
  return cells;
}

std::string SiteWords(const TerrainDecision& decision) {
  if (decision.selection.sites.empty()) {
    return "no site: " + decision.selection.none_reason;
  }
  const LandingSite& site = decision.selection.sites.front();
  return WithNumbers("site %.1f m north, %.1f m east, %.2f m to the nearest hazard", site.p_WS.x(),
                     site.p_WS.y(), site.safe_distance_m);
}

Status DrawObstacleField(const fs::path& folder, std::uint64_t seed, Pictures& pictures) {
  const Result<Look> look = LookAt("obstacles", seed);
  if (!look) {
    return look.error();
  }
  pictures.push_back({"4.3", "obstacle-field.png", "The obstacle field from 50 ft, left camera."});
  if (const Status done = WriteGreyPicture(folder / pictures.back().file, *look->newest().left);
      !done) {
    return done;
  }
  pictures.push_back(
      {"4.2", "range-map.png", "Its range map: depth along the optical axis; grey is unknown."});
  return WriteMapPicture(folder / pictures.back().file, RangesOf(*look->newest().range),
                         {"depth, m", ColourTable::kViridis, 1, {}, {}});
}

Status DrawClutteredRunway(const fs::path& folder, std::uint64_t seed, Pictures& pictures) {
  const Result<Look> look = LookAt("runway-2004", seed);
  if (!look) {
    return look.error();
  }
  pictures.push_back({"4.5", "cluttered.png", "Tables and cones on a runway, left camera."});
  if (const Status done = WriteGreyPicture(folder / pictures.back().file, *look->newest().left);
      !done) {
    return done;
  }
  struct Row {
    const char* figure;
    const char* layer;
    const char* caption;
  };
  static constexpr Row kRows[] = {
      {"4.6", "elevation", "Elevation map, thesis mode, north up."},
      {"4.7", "slope", "Slope of the least median of squares plane of 3 x 3 cells."},
      {"4.7", "roughness", "Roughness: distance of each cell from its plane."},
      {"4.8", "cost", "Cost: 0 is best, 1 forbidden."},
      {"4.8", "safe_distance", "Distance to the nearest hazard."}};
  for (const DecidedLayer& layer : LayersOf(*look->thesis)) {
    for (const Row& row : kRows) {
      if (layer.name == row.layer) {
        pictures.push_back({row.figure, layer.name + ".png", row.caption});
        const Status done = WriteMapPicture(folder / pictures.back().file, layer.cells,
                                            PictureOfLayer(layer.name, *look->thesis));
        if (!done) {
          return done;
        }
      }
    }
  }
  pictures.push_back({"4.8", "safe-landing.png", "The choice: " + SiteWords(*look->thesis) + "."});
  if (const Status done =
          WriteSafeLandingPicture(folder / pictures.back().file, *look->thesis->elevation,
                                  *look->thesis->hazards, look->thesis->selection);
      !done) {
    return done;
  }
  pictures.push_back(
      {"4.9", "overlay.png", "Thesis mode, one pair: " + SiteWords(*look->thesis) + "."});
  if (const Status done = WriteOverlayOf(*look, *look->thesis, folder / pictures.back().file);
      !done) {
    return done;
  }
  pictures.push_back(
      {"4.9", "overlay-modern.png", "Modern mode, ten pairs: " + SiteWords(*look->modern) + "."});
  return WriteOverlayOf(*look, *look->modern, folder / pictures.back().file);
}

}  // namespace

Result<std::vector<ThesisPicture>> WriteThesisPictures(const fs::path& folder, std::uint64_t seed) {
  Pictures pictures;
  if (const Status done = DrawObstacleField(folder, seed, pictures); !done) {
    return done.error();
  }
  if (const Status done = DrawClutteredRunway(folder, seed, pictures); !done) {
    return done.error();
  }
  return pictures;
}

}  // namespace palace
