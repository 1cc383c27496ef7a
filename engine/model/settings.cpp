#include "engine/model/settings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "engine/core/hash.h"
#include "engine/core/units.h"

namespace palace {
namespace {

/// A row and how to reach the field it speaks of.
struct Binding {
  SettingInfo info;
  std::function<double(const Settings&)> get;
  std::function<void(Settings&, double)> set;
};

template <typename Group, typename Field>
Binding Bind(SettingInfo info, Group Settings::*group, Field Group::*field) {
  info.default_value = static_cast<double>(Settings{}.*group.*field);
  info.integer = !std::is_floating_point_v<Field>;
  if (!info.words.empty()) {
    info.min = 0;
    info.max = static_cast<double>(info.words.size()) - 1;
  }
  if (info.soft_min == 0 && info.soft_max == 0) {
    info.soft_min = info.min;
    info.soft_max = info.max;
  }
  return {std::move(info), [=](const Settings& s) { return static_cast<double>(s.*group.*field); },
          [=](Settings& s, double v) { s.*group.*field = static_cast<Field>(v); }};
}

std::vector<Binding> MakeBindings() {
  const auto slad = &Settings::slad;
  const auto stereo = &Settings::stereo;
  const auto tracking = &Settings::tracking;
  const auto mission = &Settings::mission;
  const std::string hazard = "Hazard limits", lander = "Lander", grid = "Grid",
                    fusion = "Fusion and ranking", match = "Stereo", track = "Tracker",
                    flight = "Mission";
  return {
      Bind({"slad.max_slope_deg", "Max slope", hazard,
            "Largest angle of the ground under the lander to the up vector.", "°", 1, 1, 0.5, 45, 2,
            15},
           slad, &SladSettings::max_slope_deg),
      Bind({"slad.max_deviation_m", "Max roughness", hazard,
            "Highest point off the fitted plane inside the lander base.", "cm", 100, 1, 0.005, 1.0,
            0.02, 0.3},
           slad, &SladSettings::max_deviation_m),
      Bind({"slad.max_step_m", "Max step", hazard,
            "Largest height difference between neighbours inside the lander base. Modern mode.",
            "cm", 100, 1, 0.01, 2.0, 0.05, 0.4},
           slad, &SladSettings::max_step_m),
      Bind({"slad.nav_error_m", "Navigation error", hazard,
            "Touchdown dispersion, added to the lander radius to give the clear radius.", "m", 1, 2,
            0, 5, 0.1, 2},
           slad, &SladSettings::nav_error_m),
      Bind({"slad.min_safe_probability", "Min safe probability", hazard,
            "A place whose probability of a safe touchdown is lower is refused; where noise allows "
            "no more, it is provisional. Modern mode.",
            "", 1, 3, 0, 0.9999, 0.5, 0.9999},
           slad, &SladSettings::min_safe_probability),
      Bind({"slad.lander_base_size_m", "Base size", lander,
            "Diameter of the circle that holds the skids.", "m", 1, 2, 0.2, 20, 0.5, 6},
           slad, &SladSettings::lander_base_size_m),
      Bind({"slad.gear",
            "Gear",
            lander,
            "What the lander stands on: skids, or four pads at the corners.",
            "",
            1,
            0,
            0,
            1,
            0,
            0,
            0,
            true,
            {"skids", "pads"}},
           slad, &SladSettings::gear),
      Bind({"slad.gear_length_m", "Gear length", lander,
            "Length of the skids, or distance between fore and aft pads.", "m", 1, 2, 0.1, 20, 0.5,
            4},
           slad, &SladSettings::gear_length_m),
      Bind({"slad.gear_width_m", "Gear width", lander,
            "Distance between the middles of the skids or pads.", "m", 1, 2, 0.1, 20, 0.3, 3},
           slad, &SladSettings::gear_width_m),
      Bind(
          {"slad.belly_clearance_m", "Belly clearance", lander,
           "Height of the airframe above the plane the gear rests on.", "m", 1, 2, 0.02, 5, 0.1, 1},
          slad, &SladSettings::belly_clearance_m),
      Bind({"slad.elevated",
            "Raised tops",
            lander,
            "Flat tops raised above their surroundings, such as roofs: avoid or allow. Modern "
            "mode.",
            "",
            1,
            0,
            0,
            1,
            0,
            0,
            0,
            true,
            {"avoid", "allow"}},
           slad, &SladSettings::elevated),
      Bind({"slad.rotor_diameter_m", "Rotor diameter", lander, "Width of the approach corridor.",
            "m", 1, 2, 0.2, 20, 1, 8},
           slad, &SladSettings::rotor_diameter_m),
      Bind({"slad.max_rock_size_m", "Max rock size", lander,
            "Spacing of the samples in the plane fit.", "m", 1, 2, 0.05, 5, 0.1, 1},
           slad, &SladSettings::max_rock_size_m),
      Bind({"slad.up_tilt_deg", "Up vector tilt", lander,
            "Tilt of the landing direction off the vertical.", "°", 1, 1, 0, 30, 0, 10},
           slad, &SladSettings::up_tilt_deg),
      Bind({"slad.up_azimuth_deg", "Up vector azimuth", lander, "Compass direction of that tilt.",
            "°", 1, 0, 0, 360},
           slad, &SladSettings::up_azimuth_deg),
      Bind(
          {"slad.commit_height_m", "Commit height", lander,
           "Below this height above the site its last verdict stands.", "m", 1, 1, 0.5, 10, 1.5, 5},
          slad, &SladSettings::commit_height_m),
      Bind({"slad.mode",
            "Mode",
            grid,
            "thesis: Table 4.4 exactly, errata corrected. modern: fused, probabilistic.",
            "",
            1,
            0,
            0,
            1,
            0,
            0,
            0,
            true,
            {"thesis", "modern"}},
           slad, &SladSettings::mode),
      Bind({"slad.grid_rows", "Rows", grid, "Rows of the maps, north to south.", "", 1, 0, 1, 4096,
            20, 400},
           slad, &SladSettings::grid_rows),
      Bind({"slad.grid_cols", "Columns", grid, "Columns of the maps, west to east.", "", 1, 0, 1,
            4096, 20, 400},
           slad, &SladSettings::grid_cols),
      Bind({"slad.cell_m", "Cell", grid, "Side of a cell in modern mode.", "m", 1, 2, 0.02, 5, 0.05,
            0.5},
           slad, &SladSettings::cell_m),
      Bind({"slad.bounds",
            "Bounds",
            grid,
            "Where the map lies: around the data, as given, or from the field of view (4.4, 4.5).",
            "",
            1,
            0,
            0,
            2,
            0,
            0,
            0,
            true,
            {"data", "given", "field_of_view"}},
           slad, &SladSettings::bounds),
      Bind({"slad.x_min_m", "X min", grid,
            "Southern bound under given bounds, relative to the map centre.", "m", 1, 1, -1000,
            1000, -20, 20},
           slad, &SladSettings::x_min_m),
      Bind({"slad.x_max_m", "X max", grid,
            "Northern bound under given bounds, relative to the map centre.", "m", 1, 1, -1000,
            1000, -20, 20},
           slad, &SladSettings::x_max_m),
      Bind({"slad.y_min_m", "Y min", grid,
            "Western bound under given bounds, relative to the map centre.", "m", 1, 1, -1000, 1000,
            -20, 20},
           slad, &SladSettings::y_min_m),
      Bind({"slad.y_max_m", "Y max", grid,
            "Eastern bound under given bounds, relative to the map centre.", "m", 1, 1, -1000, 1000,
            -20, 20},
           slad, &SladSettings::y_max_m),
      Bind({"slad.border_size_cells", "Border size", grid,
            "How far the rim is interpolated. Modern mode draws it apart and never lands there.",
            "cells", 1, 0, 0, 50, 0, 10},
           slad, &SladSettings::border_size_cells),
      Bind({"slad.data_size_cells", "Data size", grid,
            "Holes up to this size are filled. Modern mode never lands on filled cells.", "cells",
            1, 0, 0, 20, 0, 4},
           slad, &SladSettings::data_size_cells),
      Bind({"slad.frames_fused", "Frames fused", fusion,
            "A cell forgets frames older than this many maps.", "", 1, 0, 1, 200, 5, 50},
           slad, &SladSettings::frames_fused),
      Bind({"slad.site_spacing_m", "Site spacing", fusion,
            "Least distance between two proposed sites.", "m", 1, 1, 0.5, 50, 2, 10},
           slad, &SladSettings::site_spacing_m),
      Bind({"slad.sites_kept", "Sites kept", fusion, "Most sites proposed at once.", "", 1, 0, 1,
            12, 1, 8},
           slad, &SladSettings::sites_kept),
      Bind({"slad.choice",
            "Choice",
            fusion,
            "farthest: farthest from any hazard. cost: least cost.",
            "",
            1,
            0,
            0,
            1,
            0,
            0,
            0,
            true,
            {"farthest", "cost"}},
           slad, &SladSettings::choice),
      Bind({"stereo.method",
            "Matcher",
            match,
            "Whole pixels: census (our semi-global matcher) or sgbm (OpenCV's three-way SGBM).",
            "",
            1,
            0,
            0,
            1,
            0,
            0,
            0,
            true,
            {"sgbm", "census"}},
           stereo, &StereoSettings::method),
      Bind({"stereo.pyramid_levels", "Pyramid levels", match,
            "Times the pictures are halved for the whole-pixel search. Faster, but small objects "
            "go first.",
            "", 1, 0, 0, 3, 0, 1},
           stereo, &StereoSettings::pyramid_levels),
      Bind({"stereo.prefilter",
            "Prefilter",
            match,
            "Filter before the whole-pixel search; the fraction is measured in unfiltered "
            "pictures.",
            "",
            1,
            0,
            0,
            2,
            0,
            0,
            0,
            true,
            {"none", "laplacian", "bilateral"}},
           stereo, &StereoSettings::prefilter),
      Bind({"stereo.filter_order",
            "Filter order",
            match,
            "Whether the prefilter sees rectified pictures, or raw ones as in the thesis.",
            "",
            1,
            0,
            0,
            1,
            0,
            0,
            0,
            true,
            {"rectify_filter", "filter_rectify"}},
           stereo, &StereoSettings::filter_order),
      Bind({"stereo.num_disparities", "Disparities", match,
            "Width of the disparity window, a multiple of 16.", "px", 1, 0, 16, 256, 32, 160},
           stereo, &StereoSettings::num_disparities),
      Bind({"stereo.block_size_px", "Block size", match,
            "Side of the block of OpenCV's matcher, odd.", "px", 1, 0, 3, 15, 3, 9},
           stereo, &StereoSettings::block_size_px),
      Bind({"stereo.refine_window_px", "Refine window", match,
            "Side of the window that refines the fraction of a pixel, odd.", "px", 1, 0, 5, 21, 7,
            13},
           stereo, &StereoSettings::refine_window_px),
      Bind({"stereo.max_sigma_px", "Max sigma", match,
            "Points with a larger disparity sigma are unknown.", "px", 1, 2, 0.05, 3, 0.2, 1},
           stereo, &StereoSettings::max_sigma_px),
      Bind({"stereo.uniqueness_percent", "Uniqueness", match,
            "Margin of the best match over the second.", "%", 1, 0, 0, 50, 0, 20},
           stereo, &StereoSettings::uniqueness_percent),
      Bind({"stereo.max_left_right_px", "Left-right limit", match,
            "Largest disagreement of the two matching directions.", "px", 1, 1, 0.5, 4},
           stereo, &StereoSettings::max_left_right_px),
      Bind({"stereo.max_refined_left_right_px", "Refined left-right limit", match,
            "The same with the fraction: a pixel further behind the nearest surface that the right "
            "camera sees there is hidden from it.",
            "px", 1, 2, 0.1, 4, 0.25, 1},
           stereo, &StereoSettings::max_refined_left_right_px),
      Bind({"stereo.map_every_frames", "Map every", match, "A new range map every so many frames.",
            "frames", 1, 0, 1, 30, 1, 5},
           stereo, &StereoSettings::map_every_frames),
      Bind({"tracking.mode",
            "Tracker",
            track,
            "template: refreshed each frame, as the thesis. plane: keyframe-anchored.",
            "",
            1,
            0,
            0,
            1,
            0,
            0,
            0,
            true,
            {"template", "plane"}},
           tracking, &TrackingSettings::mode),
      Bind({"tracking.template_size_px", "Template size", track,
            "Side of the site's own template, odd.", "px", 1, 0, 11, 101, 21, 61},
           tracking, &TrackingSettings::template_size_px),
      Bind({"tracking.search_radius_px", "Search radius", track, "Half side of the search window.",
            "px", 1, 0, 4, 128, 16, 64},
           tracking, &TrackingSettings::search_radius_px),
      Bind({"tracking.max_features", "Features", track,
            "Most features tracked on the ground plane.", "", 1, 0, 20, 500, 60, 200},
           tracking, &TrackingSettings::max_features),
      Bind({"tracking.min_coherence", "Min coherence", track,
            "Below it the tracker re-anchors; still below: vision is lost.", "", 1, 2, 0.1, 0.99,
            0.5, 0.9},
           tracking, &TrackingSettings::min_coherence),
      Bind({"tracking.accel_noise_mps2", "Filter noise", track,
            "Acceleration noise of the vision filter, per root hertz.", "m/s²", 1, 3, 0.001, 5,
            0.01, 0.5},
           tracking, &TrackingSettings::accel_noise_mps2),
      Bind({"mission.glide_slope_deg", "Glide slope", flight,
            "Angle of the descent below the horizon.", "°", 1, 0, 20, 90, 30, 60},
           mission, &MissionSettings::glide_slope_deg),
      Bind({"mission.descent_rate_mps", "Descent rate", flight,
            "Sink rate down the glide slope, part of the approval; slower near the ground.", "m/s",
            1, 2, 0.2, 1.5, 0.4, 1.2},
           mission, &MissionSettings::descent_rate_mps),
      Bind({"mission.arm_window_s", "Arm window", flight, "An armed site disarms after this time.",
            "s", 1, 0, 5, 600, 30, 120},
           mission, &MissionSettings::arm_window_s),
      Bind({"mission.approval_expiry_s", "Approval expiry", flight,
            "An approval is dead after this time unless descent began.", "s", 1, 0, 5, 120, 20, 60},
           mission, &MissionSettings::approval_expiry_s),
      Bind({"mission.propose_after_s", "Propose after", flight,
            "A site must have won for this long.", "s", 1, 1, 0, 60, 0.5, 5},
           mission, &MissionSettings::propose_after_s),
      Bind({"mission.propose_after_maps", "Propose after maps", flight,
            "A site must have won this many maps.", "", 1, 0, 1, 100, 2, 10},
           mission, &MissionSettings::propose_after_maps),
      Bind({"mission.max_vision_outage_s", "Vision outage", flight,
            "Longest inertial flight without vision before climbing away.", "s", 1, 1, 0.2, 10, 1,
            3},
           mission, &MissionSettings::max_vision_outage_s),
  };
}

const std::vector<Binding>& Bindings() {
  static const std::vector<Binding> bindings = MakeBindings();
  return bindings;
}

const Binding* FindBinding(std::string_view name) {
  const auto& all = Bindings();
  const auto it =
      std::find_if(all.begin(), all.end(), [&](const Binding& b) { return b.info.name == name; });
  return it == all.end() ? nullptr : &*it;
}

std::string Number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace

Eigen::Vector3d SladSettings::up_W() const {
  const double tilt = Rad(up_tilt_deg), azimuth = Rad(up_azimuth_deg);
  return {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), -std::cos(tilt)};
}

const std::vector<SettingInfo>& SettingTable() {
  static const std::vector<SettingInfo> table = [] {
    std::vector<SettingInfo> rows;
    for (const Binding& binding : Bindings()) {
      rows.push_back(binding.info);
    }
    return rows;
  }();
  return table;
}

const SettingInfo* FindSetting(std::string_view name) {
  for (const SettingInfo& info : SettingTable()) {
    if (info.name == name) {
      return &info;
    }
  }
  return nullptr;
}

double GetSetting(const Settings& settings, std::string_view name) {
  const Binding* binding = FindBinding(name);
  PALACE_CHECK(binding != nullptr, name);
  return binding->get(settings);
}

Status SetSettingValue(Settings& settings, std::string_view name, double value) {
  const Binding* binding = FindBinding(name);
  if (binding == nullptr) {
    return InvalidError("unknown setting '" + std::string(name) + "'");
  }
  const SettingInfo& info = binding->info;
  if (!std::isfinite(value) || value < info.min || value > info.max) {
    return InvalidError(info.name + " = " + Number(value) + " is out of range, limits " +
                        Number(info.min) + " to " + Number(info.max));
  }
  if (info.integer && value != std::floor(value)) {
    return InvalidError(info.name + " = " + Number(value) + " must be a whole number");
  }
  Settings changed = settings;
  binding->set(changed, value);
  const auto& s = changed.stereo;
  if (s.block_size_px % 2 == 0 || s.refine_window_px % 2 == 0 ||
      changed.tracking.template_size_px % 2 == 0) {
    return InvalidError(info.name + " = " + Number(value) + " must be odd");
  }
  if (s.num_disparities % 16 != 0) {
    return InvalidError(info.name + " = " + Number(value) + " must be a multiple of 16");
  }
  settings = changed;
  return Ok();
}

double ClampSetting(const SettingInfo& info, double value) {
  double clamped = std::clamp(value, info.min, info.max);
  if (!info.integer) {
    return clamped;
  }
  clamped = std::round(clamped);
  if (info.name == "stereo.num_disparities") {
    return std::clamp(std::round(clamped / 16) * 16, info.min, info.max);
  }
  const bool odd = info.name == "stereo.block_size_px" || info.name == "stereo.refine_window_px" ||
                   info.name == "tracking.template_size_px";
  return odd && std::fmod(clamped, 2) == 0 ? clamped + 1 : clamped;
}

std::uint64_t HashOf(const Settings& settings) {
  ContentHash hash;
  for (const Binding& binding : Bindings()) {
    hash.Add(std::string_view(binding.info.name));
    hash.Add(binding.get(settings));
  }
  return hash.value();
}

std::string FormatSetting(const SettingInfo& info, double value) {
  if (!info.words.empty()) {
    const auto index = static_cast<std::size_t>(std::clamp(value, info.min, info.max));
    return info.words[index];
  }
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", info.decimals, value * info.shown_per_unit);
  std::string shown = text;
  if (!shown.empty() && shown[0] == '-') {
    shown = "\u2212" + shown.substr(1);
  }
  if (info.unit.empty()) {
    return shown;
  }
  return info.unit == "°" ? shown + info.unit : shown + " " + info.unit;
}

}  // namespace palace
