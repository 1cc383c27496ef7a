#include "engine/survey/map_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/camera/picture_writer.h"
#include "engine/slad/sites/site_selection.h"

namespace palace {
namespace {

constexpr int kPictureSide_px = 720;
constexpr int kBarWidth_px = 130;
constexpr int kTitleHeight_px = 34;
const cv::Scalar kPaper(32, 28, 24), kInk(235, 235, 235), kUnknownInk(90, 90, 90);

/// Seven anchors, dark to light, evenly spaced, red-green-blue.
using Anchors = std::array<std::array<int, 3>, 7>;

const Anchors& AnchorsOf(ColourTable table) {
  static const Anchors viridis{{{68, 1, 84},
                                {69, 53, 129},
                                {53, 96, 141},
                                {33, 145, 140},
                                {53, 183, 121},
                                {144, 215, 67},
                                {253, 231, 37}}};
  static const Anchors cividis{{{0, 32, 77},
                                {45, 62, 108},
                                {87, 93, 109},
                                {124, 123, 120},
                                {162, 154, 117},
                                {206, 188, 98},
                                {255, 234, 70}}};
  static const Anchors magma{{{0, 0, 4},
                              {44, 17, 95},
                              {114, 31, 129},
                              {183, 55, 121},
                              {241, 96, 93},
                              {254, 175, 119},
                              {252, 253, 191}}};
  static const Anchors inferno{{{0, 0, 4},
                                {52, 10, 95},
                                {120, 28, 109},
                                {188, 55, 84},
                                {237, 105, 37},
                                {251, 180, 26},
                                {252, 255, 164}}};
  static const Anchors blues{{{8, 29, 70},
                              {8, 69, 140},
                              {33, 113, 181},
                              {74, 152, 201},
                              {130, 187, 219},
                              {186, 214, 235},
                              {247, 251, 255}}};
  switch (table) {
    case ColourTable::kViridis:
      return viridis;
    case ColourTable::kCividis:
      return cividis;
    case ColourTable::kMagma:
      return magma;
    case ColourTable::kInferno:
      return inferno;
    case ColourTable::kBlues:
      return blues;
  }
  return viridis;
}

cv::Vec3b ColourOf(ColourTable table, double share) {
  const Anchors& anchors = AnchorsOf(table);
  const double at = std::clamp(share, 0.0, 1.0) * 6;
  const int i = std::min(5, static_cast<int>(at));
  const double t = at - i;
  cv::Vec3b bgr;
  for (std::size_t k = 0; k < 3; ++k) {
    const double value = anchors[static_cast<std::size_t>(i)][k] * (1 - t) +
                         anchors[static_cast<std::size_t>(i) + 1][k] * t;
    bgr[static_cast<int>(2 - k)] = static_cast<unsigned char>(std::lround(value));
  }
  return bgr;
}

/// 2nd and 98th percentile of the known cells: one stray cell must not flatten the picture. Of a
/// large map every so many cells tell.
std::pair<double, double> UsualRange(const GridF& cells) {
  constexpr std::size_t kEnough = 250'000;
  const std::size_t step = cells.cells().size() / kEnough + 1;
  std::vector<float> known;
  for (std::size_t i = 0; i < cells.cells().size(); i += step) {
    if (std::isfinite(cells.cells()[i])) {
      known.push_back(cells.cells()[i]);
    }
  }
  if (known.empty()) {
    return {0, 1};
  }
  const auto at = [&](double share) {
    const auto nth = known.begin() + static_cast<std::ptrdiff_t>(share * double(known.size() - 1));
    std::nth_element(known.begin(), nth, known.end());
    return static_cast<double>(*nth);
  };
  const double low = at(0.02), high = at(0.98);
  return {low, std::max(high, low + 1e-6)};
}

/// How bright the ground is under a lamp in the north-west, 45 degrees high; Lambert's law. Level
/// ground, and cells without known neighbours, are of middle grey. Slopes count three times over,
/// because landing ground is nearly level.
Grid<std::uint8_t> Relief(const ElevationMap& map) {
  const GridGeometry& g = map.geometry;
  constexpr double kExaggeration = 3, kMiddle = 150;
  const auto gradient = [&](Cell behind, Cell here, Cell ahead) {
    const auto at = [&](Cell cell) {
      return g.Contains(cell) ? static_cast<double>(map.Measured().at(cell)) : std::nan("");
    };
    const double low = std::isnan(at(behind)) ? at(here) : at(behind);
    const double high = std::isnan(at(ahead)) ? at(here) : at(ahead);
    const int spans = int{!std::isnan(at(behind))} + int{!std::isnan(at(ahead))};
    return spans == 0 ? 0.0 : kExaggeration * (high - low) / (spans * g.cell_m);
  };
  Grid<std::uint8_t> relief(g.rows, g.cols, 0);
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      if (std::isnan(map.Measured().at(r, c))) {
        continue;
      }
      const double north = gradient({r + 1, c}, {r, c}, {r - 1, c});
      const double east = gradient({r, c - 1}, {r, c}, {r, c + 1});
      // Normal (-north, -east, 1) against the lamp (1, -1, sqrt 2) / 2; 1 on level ground.
      const double light = (M_SQRT2 - north + east) / std::sqrt(1 + north * north + east * east);
      relief.at(r, c) =
          static_cast<std::uint8_t>(std::clamp(kMiddle * light / M_SQRT2, 20.0, 255.0));
    }
  }
  return relief;
}

double PixelsPerCell(const GridGeometry& g) {
  return std::max(0.25, static_cast<double>(kPictureSide_px) / std::max({g.rows, g.cols, 1}));
}

cv::Mat Enlarged(const cv::Mat& cells, double scale) {
  cv::Mat large;
  // A map a thousand times longer than wide keeps a pixel of width.
  const cv::Size size(std::max(1, cvRound(cells.cols * scale)),
                      std::max(1, cvRound(cells.rows * scale)));
  cv::resize(cells, large, size, 0, 0, scale >= 1 ? cv::INTER_NEAREST : cv::INTER_AREA);
  return large;
}

void Write(cv::Mat& picture, const std::string& text, cv::Point at, double size = 0.5) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, kInk, 1, cv::LINE_AA);
}

/// Blue is safe, orange is over a limit, as on the screen (blue, green, red).
const cv::Vec3d kSafeInk(255, 178, 92), kUnsafeInk(60, 150, 240);

/// Orange tint and hatch on hazards and unknown ground, blue rim round what can be landed on.
void DrawVerdict(cv::Mat& picture, const ImageU8& verdict) {
  cv::Mat safe(verdict.height(), verdict.width(), CV_8U), hatched = safe.clone();
  for (int y = 0; y < verdict.height(); ++y) {
    for (int x = 0; x < verdict.width(); ++x) {
      const auto ground = static_cast<GroundClass>(verdict.at(x, y));
      safe.at<std::uint8_t>(y, x) = ground == GroundClass::kLandable ? 255 : 0;
      hatched.at<std::uint8_t>(y, x) =
          ground == GroundClass::kUnknown || ground == GroundClass::kHazard ? 255 : 0;
    }
  }
  cv::resize(safe, safe, picture.size(), 0, 0, cv::INTER_NEAREST);
  cv::resize(hatched, hatched, picture.size(), 0, 0, cv::INTER_NEAREST);
  constexpr int kHatchPeriod_px = 12, kHatchWidth_px = 2;
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      if (hatched.at<std::uint8_t>(y, x) == 0) {
        continue;
      }
      auto& pixel = picture.at<cv::Vec3b>(y, x);
      const double share = (x + y) % kHatchPeriod_px < kHatchWidth_px ? 0.55 : 0.10;
      pixel = cv::Vec3b((1 - share) * cv::Vec3d(pixel) + share * kUnsafeInk);
    }
  }
  std::vector<std::vector<cv::Point>> rims;
  cv::findContours(safe, rims, cv::RETR_LIST, cv::CHAIN_APPROX_SIMPLE);
  cv::drawContours(picture, rims, -1, cv::Scalar(kSafeInk[0], kSafeInk[1], kSafeInk[2]), 2,
                   cv::LINE_AA);
}

void DrawCross(cv::Mat& picture, cv::Point2d at, double arm, const cv::Scalar& colour) {
  const auto line = [&](double dx, double dy) {
    cv::line(picture, at - cv::Point2d(dx, dy), at + cv::Point2d(dx, dy), cv::Scalar(0, 0, 0), 4,
             cv::LINE_AA);
    cv::line(picture, at - cv::Point2d(dx, dy), at + cv::Point2d(dx, dy), colour, 2, cv::LINE_AA);
  };
  line(arm, 0);
  line(0, arm);
}

}  // namespace

Status WriteMapPicture(const std::filesystem::path& path, const GridF& cells,
                       const MapPicture& picture) {
  if (cells.empty()) {
    return InvalidError(path.string() + ": the map has no cells");
  }
  auto [low, high] = UsualRange(cells);
  low = picture.low.value_or(low * picture.shown_per_unit);
  high = std::max(picture.high.value_or(high * picture.shown_per_unit), low + 1e-9);
  cv::Mat colours(cells.rows(), cells.cols(), CV_8UC3, kUnknownInk);
  bool lower = false, higher = false;  // than the bar: told at its ends
  for (int r = 0; r < cells.rows(); ++r) {
    for (int c = 0; c < cells.cols(); ++c) {
      const double value = static_cast<double>(cells.at(r, c)) * picture.shown_per_unit;
      if (std::isfinite(value)) {
        lower = lower || value < low;
        higher = higher || value > high;
        colours.at<cv::Vec3b>(r, c) = ColourOf(picture.table, (value - low) / (high - low));
      }
    }
  }
  const cv::Mat large =
      Enlarged(colours, PixelsPerCell({cells.rows(), cells.cols(), 1.0, 0.0, 0.0}));
  cv::Mat sheet(std::max(large.rows, 160) + kTitleHeight_px, large.cols + kBarWidth_px, CV_8UC3,
                kPaper);
  large.copyTo(sheet(cv::Rect(0, kTitleHeight_px, large.cols, large.rows)));
  Write(sheet, picture.title, {8, 23}, 0.6);
  const int top = kTitleHeight_px + 14, bottom = sheet.rows - 14, left = large.cols + 16;
  for (int y = top; y < bottom; ++y) {
    const cv::Vec3b colour = ColourOf(picture.table, double(bottom - y) / (bottom - top));
    cv::line(sheet, {left, y}, {left + 22, y}, cv::Scalar(colour[0], colour[1], colour[2]));
  }
  for (int tick = 0; tick <= 4; ++tick) {
    const char* beyond = tick == 0 && lower ? "<= " : tick == 4 && higher ? ">= " : "";
    char text[32];
    std::snprintf(text, sizeof text, "%s%.3g", beyond, low + (high - low) * tick / 4);
    Write(sheet, text, {left + 30, bottom - (bottom - top) * tick / 4 + 5});
  }
  return WritePicture(path, sheet);
}

Status WriteSafeLandingPicture(const std::filesystem::path& path, const ElevationMap& map,
                               const HazardMaps& hazards, const SiteSelection& selection) {
  const GridGeometry& g = map.geometry;
  if (map.height_m.empty()) {
    return InvalidError(path.string() + ": the map has no cells");
  }
  const Grid<std::uint8_t> relief = Relief(map);
  cv::Mat colours(g.rows, g.cols, CV_8UC3, cv::Scalar(40, 36, 34));
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c) {
      const double height = static_cast<double>(map.Measured().at(r, c));
      const unsigned reasons = hazards.reasons.at(r, c);
      if (!std::isfinite(height) || reasons == kHazardUnknown) {
        continue;
      }
      const double grey = relief.at(r, c);
      const cv::Vec3d tint = reasons != 0                     ? kUnsafeInk
                             : CanBearLander(hazards, {r, c}) ? kSafeInk
                                                              : cv::Vec3d(150, 140, 130);
      colours.at<cv::Vec3b>(r, c) = cv::Vec3b(0.5 * tint + 0.5 * cv::Vec3d(grey, grey, grey));
    }
  }
  const double scale = PixelsPerCell(g);
  cv::Mat large = Enlarged(colours, scale);
  for (std::size_t i = selection.sites.size(); i-- > 0;) {
    const LandingSite& site = selection.sites[i];
    const cv::Point2d at((site.cell.col + 0.5) * scale, (site.cell.row + 0.5) * scale);
    const cv::Scalar ink = i == 0 ? cv::Scalar(255, 255, 255) : cv::Scalar(200, 200, 200);
    cv::circle(large, at, static_cast<int>(site.clear_radius_m / g.cell_m * scale), ink,
               i == 0 ? 2 : 1, cv::LINE_AA);
    Write(large, site.letter, cv::Point2d(at.x + 6, at.y - 6));
    if (i == 0) {
      DrawCross(large, at, 10, ink);
    }
  }
  return WritePicture(path, large);
}

Status WriteOverlay(const std::filesystem::path& path, const ImageU8& left,
                    const SiteSelection& selection, const RangeMap& range, const ImageU8& verdict) {
  PALACE_CHECK(range.pose.has_value());
  const RigidTransform X_CW = range.pose->X_WC.Inverse();
  const PinholeCamera& camera = range.camera;
  cv::Mat picture(left.height(), left.width(), CV_8UC3);
  for (int y = 0; y < left.height(); ++y) {
    for (int x = 0; x < left.width(); ++x) {
      picture.at<cv::Vec3b>(y, x) = cv::Vec3b::all(left.at(x, y));
    }
  }
  DrawVerdict(picture, verdict);
  for (std::size_t i = selection.sites.size(); i-- > 0;) {
    const LandingSite& site = selection.sites[i];
    const cv::Scalar ink(255, 255, 255);
    const Eigen::Vector3d along = site.normal_W.cross(Eigen::Vector3d::UnitY()).normalized();
    const Eigen::Vector3d aside = site.normal_W.cross(along);
    std::vector<cv::Point> ring;
    for (int k = 0; k < 64; ++k) {
      const double angle = 2 * M_PI * k / 64;
      const Eigen::Vector3d p_W =
          site.p_WS + site.clear_radius_m * (std::cos(angle) * along + std::sin(angle) * aside);
      const Eigen::Vector3d p_C = X_CW * p_W;
      if (p_C.z() > 0) {
        ring.emplace_back(static_cast<int>(camera.fx_px * p_C.x() / p_C.z() + camera.cx_px),
                          static_cast<int>(camera.fy_px * p_C.y() / p_C.z() + camera.cy_px));
      }
    }
    cv::polylines(picture, ring, true, cv::Scalar(0, 0, 0), i == 0 ? 6 : 4, cv::LINE_AA);
    cv::polylines(picture, ring, true, ink, i == 0 ? 3 : 1, cv::LINE_AA);
    if (site.pixel.allFinite()) {
      const cv::Point2d at(site.pixel.x(), site.pixel.y());
      DrawCross(picture, at, i == 0 ? 16 : 6, ink);
      cv::putText(picture, site.letter, at + cv::Point2d(10, -10), cv::FONT_HERSHEY_SIMPLEX, 0.8,
                  cv::Scalar(0, 0, 0), 5, cv::LINE_AA);
      cv::putText(picture, site.letter, at + cv::Point2d(10, -10), cv::FONT_HERSHEY_SIMPLEX, 0.8,
                  ink, 2, cv::LINE_AA);
    }
  }
  return WritePicture(path, picture);
}

std::string PictureAsDataUri(const std::filesystem::path& path) {
  constexpr int kMostSide_px = 1400;
  std::error_code error;
  cv::Mat picture = std::filesystem::exists(path, error) ? cv::imread(path.string()) : cv::Mat();
  if (picture.empty()) {
    return "";
  }
  const double scale = double(kMostSide_px) / std::max(picture.rows, picture.cols);
  if (scale < 1) {
    picture = Enlarged(picture, scale);
  }
  std::vector<unsigned char> jpeg;
  cv::imencode(".jpg", picture, jpeg, {cv::IMWRITE_JPEG_QUALITY, 85});
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text = "data:image/jpeg;base64,";
  for (std::size_t i = 0; i < jpeg.size(); i += 3) {
    const std::size_t bytes = std::min<std::size_t>(3, jpeg.size() - i);
    unsigned three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      three = three << 8 | (k < bytes ? jpeg[i + k] : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= bytes ? kDigits[three >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

}  // namespace palace
