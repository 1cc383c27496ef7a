#include "gui/app/layout.h"

#include <algorithm>
#include <cmath>

namespace palace {
namespace {

constexpr double kMargin = 8;
constexpr double kGap = 8;
constexpr double kHeader = 28;
constexpr double kBarBelowMap = 44;  ///< colour bar and its labels

/// Units to whole pixels, edge by edge, so that neighbours never overlap.
struct Grid2 {
  double scale;
  Rect Of(double x, double y, double w, double h) const {
    const double x0 = std::round(x * scale);
    const double y0 = std::round(y * scale);
    const double x1 = std::round((x + w) * scale);
    const double y1 = std::round((y + h) * scale);
    return {static_cast<float>(x0), static_cast<float>(y0), static_cast<float>(x1 - x0),
            static_cast<float>(y1 - y0)};
  }
};

double Floor4(double value) { return std::floor(value / 4) * 4; }

/// Sizes in units shared by the parts of Fly.
struct FlyUnits {
  double width, height;
  bool narrow;
  double left_x, left_w, right_x, right_w;
  double body_y, body_h;
  double channel_h, map_side, map_row_h, picture_h;
};

FlyUnits MeasureFly(double width, double height) {
  FlyUnits u{};
  u.width = width;
  u.height = height;
  u.narrow = IsNarrow(width, height);
  u.right_w = u.narrow ? 344 : (width >= 3000 ? 480 : 416);
  u.left_x = kMargin;
  u.left_w = width - kBesideBody - kGap - u.right_w;
  u.right_x = u.left_x + u.left_w + kGap;
  u.body_y = 88;
  u.body_h = height - kAroundBody;
  u.channel_h = u.narrow ? 0 : 72;
  const double channel_gap = u.narrow ? 0 : kGap;
  // The picture is the hero: maps grow only with what the picture row does not need.
  const double wanted_picture = u.narrow ? 340 : std::min(508.0, 508 * u.body_h / 956);
  const double room =
      u.body_h - u.channel_h - channel_gap - kGap - wanted_picture - kHeader - kBarBelowMap;
  u.map_side = std::min({480.0, Floor4((u.left_w - 4 * kGap) / 5), std::max(176.0, Floor4(room))});
  u.map_row_h = u.map_side + kHeader + kBarBelowMap;
  u.picture_h = u.body_h - u.map_row_h - kGap - u.channel_h - channel_gap;
  return u;
}

void PlacePictures(const FlyUnits& u, const Grid2& grid, FlyLayout& fly) {
  const double vehicle_h = u.narrow ? 148 : 166;
  const double right_min = u.narrow ? 208 : 240;
  const double view_min = u.narrow ? 272 : 360;
  double left = Floor4((u.picture_h - kHeader) * 4 / 3);
  double right = Floor4((u.picture_h - kGap - vehicle_h - kHeader) * 4 / 3);
  left = std::min(left, u.left_w - 2 * kGap - right_min - view_min);
  right = std::clamp(right, right_min, std::max(right_min, left));
  right = std::min(right, u.left_w - 2 * kGap - left - view_min);
  if (u.picture_h > 1100) {  // both pictures grow alike on very large windows
    left = right = Floor4(std::min(left, (u.left_w - 2 * kGap - view_min) / 2));
  }
  const double y = u.body_y;
  fly.left_camera = grid.Of(u.left_x, y, left, u.picture_h);
  const double right_x = u.left_x + left + kGap;
  // The vehicle panel takes the height that the right picture does not fill.
  const double right_h = std::min(u.picture_h - kGap - vehicle_h, kHeader + right * 3 / 4);
  fly.right_camera = grid.Of(right_x, y, right, right_h);
  fly.vehicle = grid.Of(right_x, y + right_h + kGap, right, u.picture_h - right_h - kGap);
  const double view_x = right_x + right + kGap;
  fly.view_3d = grid.Of(view_x, y, u.left_x + u.left_w - view_x, u.picture_h);
}

/// Five square maps from y; spare pixels go into the gaps, or into wide panels where many.
void PlaceMaps(const FlyUnits& u, const Grid2& grid, double y, double side,
               std::array<Rect, 5>& maps) {
  double panel_w = side;
  double gap = (u.left_w - 5 * side) / 4;
  if (gap > 16) {
    gap = kGap;
    panel_w = (u.left_w - 4 * gap) / 5;
  }
  for (std::size_t i = 0; i < maps.size(); ++i) {
    maps[i] = grid.Of(u.left_x + static_cast<double>(i) * (panel_w + gap), y, panel_w,
                      side + kHeader + kBarBelowMap);
  }
}

void PlaceDescentPlots(const FlyUnits& u, const Grid2& grid, double y, FlyLayout& fly) {
  const double bottom = u.body_y + u.body_h;
  fly.plot_tabs = grid.Of(u.left_x, y, u.left_w, 32);
  const double top = y + 36;
  const double h = (bottom - top - kGap) / 2;
  const double w = (u.left_w - 2 * kGap) / 3;
  for (std::size_t i = 0; i < fly.plots.size(); ++i) {
    fly.plots[i] = grid.Of(u.left_x + static_cast<double>(i % 3) * (w + kGap),
                           top + static_cast<double>(i / 3) * (h + kGap), w, h);
  }
  const double side = std::min(u.map_side, Floor4(bottom - top - kHeader - kBarBelowMap));
  fly.tabbed_map_side = static_cast<float>(std::round(side * grid.scale));
  PlaceMaps(u, grid, top, side, fly.tabbed_maps);
}

void PlaceDecision(const FlyUnits& u, const Grid2& grid, FlyLayout& fly) {
  const double row_wide = 72;
  const double row_narrow = 44;
  const double sites_wide = kHeader + 4 + 4 * row_wide + 4;
  const double sites_narrow = kHeader + (u.narrow ? 2 : 4) + 4 * row_narrow + 4;
  const double evidence_wide = 324;
  const double evidence_folded = u.narrow ? 196 : 240;
  double approve = u.narrow ? 174 : 292;
  const double free = u.body_h - 2 * kGap;
  double evidence = u.narrow ? evidence_folded : evidence_wide;
  double sites = free - evidence - approve;
  fly.folded_evidence = u.narrow;
  fly.site_row_units = u.narrow ? 44 : 72;
  if (!u.narrow && sites < sites_wide - 0.5) {
    fly.site_row_units = 44;
    if (sites < sites_narrow) {
      fly.folded_evidence = true;
      evidence = evidence_folded;
      sites = free - evidence - approve;
    }
  }
  const int max_rows = u.narrow ? 6 : 8;
  const double row = fly.site_row_units;
  fly.site_rows = std::clamp(static_cast<int>((sites - kHeader - 6) / row), 2, max_rows);
  // Approve takes the slack that no site row uses.
  const double used = kHeader + (u.narrow ? 2 : 4) + fly.site_rows * row + 4;
  approve += std::max(0.0, sites - used);
  sites = std::min(sites, used);
  double y = u.body_y;
  fly.sites = grid.Of(u.right_x, y, u.right_w, sites);
  y += sites + kGap;
  fly.evidence = grid.Of(u.right_x, y, u.right_w, evidence);
  y += evidence + kGap;
  fly.approve = grid.Of(u.right_x, y, u.right_w, u.body_y + u.body_h - y);
}

constexpr double kRecheck = 316, kRecheckLow = 268, kRecheckLeast = 196;
constexpr double kLimits = 268, kLimitsFolded = 196;
constexpr double kTracker = 160, kTrackerMost = 360;  // rows of the trackers; with their pictures
constexpr double kTrackerFolded = 300;
constexpr double kLanding = 188, kLandingFolded = 174;

/// Of the tracker: what is wanted, as long as what is left of the column leaves Landing its height.
double TrackerHeight(double left, double wanted, double landing) {
  const double most = left - kGap - landing;
  return most < kTracker - 0.5 ? 0 : std::min({std::max(wanted, kTracker), kTrackerMost, most});
}

void PlaceDescentColumn(const FlyUnits& u, const Grid2& grid, FlyLayout& fly) {
  const double bottom = u.body_y + u.body_h;
  const double approve_y = static_cast<double>(fly.approve.y) / grid.scale;
  const double above = approve_y - u.body_y - 2 * kGap;  // of re-check and limits, held
  const double limits = u.narrow ? kLimitsFolded : kLimits;
  // In a narrow window the last panel stands where Approve does: its buttons stay where they are.
  const double recheck = u.narrow ? above - limits
                                  : std::clamp(u.body_h - limits - kTracker - kLanding - 3 * kGap,
                                               kRecheckLow, kRecheck);
  double y = u.body_y;
  fly.recheck = grid.Of(u.right_x, y, u.right_w, recheck);
  y += recheck + kGap;
  fly.limits = grid.Of(u.right_x, y, u.right_w, limits);
  y += limits + kGap;
  // Down to Approve's place, if that is not too much: Landing then stands there.
  const double tracker = TrackerHeight(bottom - y, u.narrow ? kTrackerFolded : approve_y - kGap - y,
                                       u.narrow ? kLandingFolded : kLanding);
  if (tracker > 0) {
    fly.tracker = grid.Of(u.right_x, y, u.right_w, tracker);
    y += tracker + kGap;
  }
  fly.landing = grid.Of(u.right_x, y, u.right_w, bottom - y);
  // A vehicle that holds is sent elsewhere by buttons in the last panel's head, and then stopped by
  // one there: it stands where Approve comes up.
  const double held_recheck = std::clamp(above - limits, kRecheckLeast, recheck);
  fly.held_recheck = grid.Of(u.right_x, u.body_y, u.right_w, held_recheck);
  fly.held_limits =
      grid.Of(u.right_x, u.body_y + held_recheck + kGap, u.right_w, above - held_recheck);
}

}  // namespace

double FittingScale(double width_px, double height_px, double wanted) {
  constexpr double kSteps[] = {2.5, 2.25, 2.0, 1.75, 1.5, 1.25, 1.0, 0.75, 0.5};
  for (const double step : kSteps) {
    if (step <= wanted + 1e-9 && width_px / step >= 1280 && height_px / step >= 720) {
      return step;
    }
  }
  return kSteps[8];
}

FrameLayout ComputeFrameLayout(double width_px, double height_px, double scale) {
  const Grid2 grid{scale};
  const double width = width_px / scale;
  const double height = height_px / scale;
  FrameLayout frame;
  frame.scale = scale;
  frame.narrow = IsNarrow(width, height);
  frame.window = grid.Of(0, 0, width, height);
  const double wave_off_w = width < kWideWidth ? 200 : 216;
  frame.wave_off = grid.Of(width - wave_off_w, 0, wave_off_w, 80);
  frame.top_bar = grid.Of(0, 0, width - wave_off_w, 48);
  frame.mode_block = grid.Of(0, 0, 112, 48);
  frame.alarm_strip = grid.Of(0, 48, width - wave_off_w, 32);
  frame.body = grid.Of(kMargin, 88, width - kBesideBody, height - kAroundBody);
  frame.status_bar = grid.Of(0, height - 28, width, 28);
  return frame;
}

FlyLayout ComputeFlyLayout(double width_px, double height_px, double scale, bool descent) {
  const Grid2 grid{scale};
  FlyLayout fly;
  fly.frame = ComputeFrameLayout(width_px, height_px, scale);
  fly.descent = descent;
  const FlyUnits u = MeasureFly(width_px / scale, height_px / scale);
  fly.narrow = u.narrow;
  PlacePictures(u, grid, fly);
  const double map_y = u.body_y + u.picture_h + kGap;
  fly.map_side = static_cast<float>(std::round(u.map_side * scale));
  PlaceMaps(u, grid, map_y, u.map_side, fly.maps);
  if (!u.narrow) {
    fly.channels = grid.Of(u.left_x, u.body_y + u.body_h - u.channel_h, u.left_w, u.channel_h);
  }
  PlaceDescentPlots(u, grid, map_y, fly);
  PlaceDecision(u, grid, fly);
  PlaceDescentColumn(u, grid, fly);
  return fly;
}

}  // namespace palace
