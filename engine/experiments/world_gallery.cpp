#include "engine/experiments/world_gallery.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <opencv2/imgproc.hpp>

#include "engine/camera/grey_view.h"
#include "engine/camera/picture_writer.h"
#include "engine/core/files.h"
#include "engine/core/units.h"
#include "engine/report/html_page.h"
#include "engine/world/families/families.h"
#include "engine/world/families/view_plan.h"
#include "engine/world/ground_truth.h"
#include "engine/world/ray_scene.h"

namespace palace {
namespace {

std::string Text(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

TruthArea AreaOf(const World& world) {
  return world.name == "rmax" ? TruthArea{10, 130, -45, 45, 0.1} : TruthArea{};
}

/// Heights as a shaded relief; what breaks a limit in colour, places of safe discs with a green
/// tint.
cv::Mat DrawTruth(const GroundTruth& truth, const SafePlaces& places, const TruthLimits& limits) {
  const GridGeometry& geometry = truth.geometry;
  cv::Mat picture(geometry.rows, geometry.cols, CV_8UC3);
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      const int south = std::min(row + 1, geometry.rows - 1), west = std::max(col - 1, 0);
      const auto height = static_cast<double>(truth.height_m.at(row, col));
      const double falls = 2 * height - static_cast<double>(truth.height_m.at(south, col)) -
                           static_cast<double>(truth.height_m.at(row, west));
      cv::Vec3d colour = cv::Vec3d::all(150 + 90 * std::tanh(2 * falls / geometry.cell_m));
      const std::uint8_t flags = truth.flags.at(row, col);
      const auto mix = [&](double blue, double green, double red) {
        colour = 0.5 * colour + 0.5 * cv::Vec3d(blue, green, red);
      };
      const auto at =
          places.geometry.CellFromPoint(geometry.NorthOfRow(row), geometry.EastOfCol(col));
      if ((flags & kWaterThere) != 0) {
        mix(220, 120, 20);
      } else if ((flags & kMovingThere) != 0) {
        mix(220, 40, 220);
      } else if (static_cast<double>(truth.step_m.at(row, col)) > limits.step_m) {
        (flags & kSoftThere) != 0 ? mix(0, 140, 110) : mix(40, 40, 230);
      } else if (static_cast<double>(truth.slope_deg.at(row, col)) > limits.slope_deg) {
        mix(40, 150, 240);
      } else if (at && places.safe.at(*at) == 1) {
        mix(90, 200, 90);
      }
      picture.at<cv::Vec3b>(row, col) = cv::Vec3b(cv::saturate_cast<std::uint8_t>(colour[0]),
                                                  cv::saturate_cast<std::uint8_t>(colour[1]),
                                                  cv::saturate_cast<std::uint8_t>(colour[2]));
    }
  }
  return picture;
}

std::string ShareText(const SafePlaces& places) {
  const double cells = static_cast<double>(places.safe.cells().size());
  return Text("%.1f %% of the places", 100 * places.Count() / cells);
}

class GalleryWriter {
 public:
  explicit GalleryWriter(const WorldGallery& gallery)
      : gallery_(gallery), page_("Worlds, seed " + std::to_string(gallery.seed)) {
    page_.Paragraph(
        "Each world from the left camera, with lens, tilt, blur, noise and exposure drawn from the "
        "seed, and its truth from above, north up: red a step, orange a slope, olive a step of "
        "leaves, blue water, violet what moves, green the middle of a safe disc.");
  }

  Status Add(const std::string& family) {
    const Result<World> world = MakeFamily(family, gallery_.seed);
    if (!world) {
      return world.error();
    }
    page_.Heading(family + ": " + std::string(FamilySummary(family)));
    std::vector<double> heights_m = gallery_.heights_m;
    const ViewPlan plan = DrawViewPlan(family, gallery_.seed);
    if (plan.height_m > heights_m.back()) {
      heights_m.push_back(plan.height_m);
    }
    for (const double height_m : heights_m) {
      if (const Status added = AddPicture(*world, plan, height_m); !added) {
        return added;
      }
    }
    return AddTruth(*world);
  }

  Status Finish() const { return WriteTextFile(gallery_.folder / "gallery.html", page_.Text()); }

 private:
  std::string FileName(const World& world, const std::string& what) const {
    return world.name + "_" + std::to_string(gallery_.seed) + "_" + what + ".png";
  }

  Status AddPicture(const World& world, ViewPlan plan, double height_m) {
    plan.height_m = height_m;
    // The nearest ground is at the picture's lower edge.
    const double sample_m = height_m / plan.camera.fx_px;
    const RayScene scene(world, std::max(0.01, sample_m));
    const ImageF grey = scene.Grey(plan.camera, plan.X_WC(GroundSeen(world, plan)), 3);
    const ImageU8 picture = ExposeAs(plan, grey, false, gallery_.seed);
    const std::string file = FileName(world, Text("%02.0fm", height_m));
    page_.Picture(file, Text("%.1f m over the ground", height_m) +
                            Text(", %.0f degrees down", -Deg(plan.tilt_rad)));
    return WritePicture(gallery_.folder / file, GreyView(picture));
  }

  Status AddTruth(const World& world) {
    const TruthLimits limits;
    const GroundTruth truth = TruthOf(world, AreaOf(world));
    const SafePlaces places = FindSafePlaces(truth, gallery_.clear_radius_m, limits);
    const std::string file = FileName(world, "truth");
    page_.Picture(file, "truth: safe discs of " + Text("%.1f m at ", gallery_.clear_radius_m) +
                            ShareText(places) + ", in " + std::to_string(places.Regions()) +
                            " regions");
    return WritePicture(gallery_.folder / file, DrawTruth(truth, places, limits));
  }

  const WorldGallery& gallery_;
  HtmlPage page_;
};

}  // namespace

Status WriteWorldGallery(const WorldGallery& gallery,
                         const std::function<void(const std::string&)>& progress) {
  if (const Status made = MakeFolder(gallery.folder); !made) {
    return made;
  }
  GalleryWriter writer(gallery);
  for (const std::string& family : gallery.families) {
    progress(family);
    if (const Status added = writer.Add(family); !added) {
      return added;
    }
  }
  return writer.Finish();
}

}  // namespace palace
