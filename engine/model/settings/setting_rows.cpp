#include "engine/model/settings/setting_rows.h"

#include <utility>

namespace palace {
namespace {

using Row = RowBuilder;

// Where the groups of members lie, in settings that may change or not.
constexpr auto kSlad = [](auto& s) -> auto& { return s.slad; };
constexpr auto kGrid = [](auto& s) -> auto& { return s.slad.grid; };
constexpr auto kLimits = [](auto& s) -> auto& { return s.slad.limits; };
constexpr auto kLander = [](auto& s) -> auto& { return s.slad.lander; };
constexpr auto kFusion = [](auto& s) -> auto& { return s.slad.fusion; };
constexpr auto kChoice = [](auto& s) -> auto& { return s.slad.choice; };
constexpr auto kStereo = [](auto& s) -> auto& { return s.stereo; };
constexpr auto kTracking = [](auto& s) -> auto& { return s.tracking; };
constexpr auto kMission = [](auto& s) -> auto& { return s.mission; };

std::vector<Row> HazardRows() {
  return {
      Row("slad.max_slope_deg", "Max slope", kLimits, &HazardLimits::max_slope_deg)
          .Says("Largest angle of the ground under the lander to the up vector.")
          .Shown("°", 1)
          .Within(0.5, 45)
          .Usually(2, 15),
      Row("slad.max_deviation_m", "Max roughness", kLimits, &HazardLimits::max_deviation_m)
          .Says("Highest point off the fitted plane inside the lander base.")
          .Shown("cm", 1, 100)
          .Within(0.005, 1.0)
          .Usually(0.02, 0.3),
      Row("slad.max_step_m", "Max step", kLimits, &HazardLimits::max_step_m)
          .Says("Largest height difference between neighbours inside the lander base. Modern mode.")
          .Shown("cm", 1, 100)
          .Within(0.01, 2.0)
          .Usually(0.05, 0.4),
      Row("slad.nav_error_m", "Navigation error", kLander, &Lander::nav_error_m)
          .Says("Touchdown dispersion, added to the lander radius to give the clear radius.")
          .Shown("m", 2)
          .Within(0, 5)
          .Usually(0.1, 2),
      Row("slad.min_safe_probability", "Min safe probability", kLimits,
          &HazardLimits::min_safe_probability)
          .Says("A place whose probability of a safe touchdown is lower is refused; where noise "
                "allows no more, it is provisional. Modern mode.")
          .Shown("", 3)
          .Within(0, 0.9999)
          .Usually(0.5, 0.9999),
  };
}

std::vector<Row> LanderRows() {
  return {
      Row("slad.lander_base_size_m", "Base size", kLander, &Lander::base_size_m)
          .Says("Diameter of the circle that holds the skids.")
          .Shown("m", 2)
          .Within(0.2, 20)
          .Usually(0.5, 6),
      Row("slad.gear", "Gear", kLander, &Lander::gear)
          .Says("What the lander stands on: skids, or four pads at the corners.")
          .Choice({"skids", "pads"}),
      Row("slad.gear_length_m", "Gear length", kLander, &Lander::gear_length_m)
          .Says("Length of the skids, or distance between fore and aft pads.")
          .Shown("m", 2)
          .Within(0.1, 20)
          .Usually(0.5, 4),
      Row("slad.gear_width_m", "Gear width", kLander, &Lander::gear_width_m)
          .Says("Distance between the middles of the skids or pads.")
          .Shown("m", 2)
          .Within(0.1, 20)
          .Usually(0.3, 3),
      Row("slad.belly_clearance_m", "Belly clearance", kLander, &Lander::belly_clearance_m)
          .Says("Height of the airframe above the plane the gear rests on.")
          .Shown("m", 2)
          .Within(0.02, 5)
          .Usually(0.1, 1),
      Row("slad.elevated", "Raised tops", kLimits, &HazardLimits::elevated)
          .Says("Flat tops raised above their surroundings, such as roofs: avoid or allow. Modern "
                "mode.")
          .Choice({"avoid", "allow"}),
      Row("slad.rotor_diameter_m", "Rotor diameter", kLander, &Lander::rotor_diameter_m)
          .Says("Width of the approach corridor.")
          .Shown("m", 2)
          .Within(0.2, 20)
          .Usually(1, 8),
      Row("slad.max_rock_size_m", "Max rock size", kLander, &Lander::max_rock_size_m)
          .Says("Spacing of the samples in the plane fit.")
          .Shown("m", 2)
          .Within(0.05, 5)
          .Usually(0.1, 1),
      Row("slad.up_tilt_deg", "Up vector tilt", kLander, &Lander::up_tilt_deg)
          .Says("Tilt of the landing direction off the vertical.")
          .Shown("°", 1)
          .Within(0, 30)
          .Usually(0, 10),
      Row("slad.up_azimuth_deg", "Up vector azimuth", kLander, &Lander::up_azimuth_deg)
          .Says("Compass direction of that tilt.")
          .Shown("°", 0)
          .Within(0, 360),
      Row("slad.commit_height_m", "Commit height", kFusion, &FusionSettings::commit_height_m)
          .Says("Below this height above the site its last verdict stands.")
          .Shown("m", 1)
          .Within(0.5, 10)
          .Usually(1.5, 5),
  };
}

std::vector<Row> GridRows() {
  return {
      Row("slad.mode", "Mode", kSlad, &SladSettings::mode)
          .Says("thesis: Table 4.4 exactly, errata corrected. modern: fused, probabilistic.")
          .Choice({"thesis", "modern"}),
      Row("slad.grid_rows", "Least rows", kGrid, &GridSettings::rows)
          .Says("Rows of the maps, north to south. Where more is in view modern maps have up to "
                "twice as many.")
          .Shown("", 0)
          .Within(1, GridSettings::kMostCells)
          .Usually(20, 400),
      Row("slad.grid_cols", "Least columns", kGrid, &GridSettings::cols)
          .Says("Columns of the maps, west to east. Where more is in view modern maps have up to "
                "twice as many.")
          .Shown("", 0)
          .Within(1, GridSettings::kMostCells)
          .Usually(20, 400),
      Row("slad.cell_m", "Cell", kGrid, &GridSettings::cell_m)
          .Says("Side of a cell in modern mode.")
          .Shown("m", 2)
          .Within(0.02, 5)
          .Usually(0.05, 0.5),
      Row("slad.bounds", "Bounds", kGrid, &GridSettings::bounds)
          .Says("Where the map lies: around the data, as given, or from the field of view (4.4, "
                "4.5).")
          .Choice({"data", "given", "field_of_view"}),
      Row("slad.x_min_m", "X min", kGrid, &GridSettings::x_min_m)
          .Says("Southern bound under given bounds, relative to the map centre.")
          .Shown("m", 1)
          .Within(-1000, 1000)
          .Usually(-20, 20),
      Row("slad.x_max_m", "X max", kGrid, &GridSettings::x_max_m)
          .Says("Northern bound under given bounds, relative to the map centre.")
          .Shown("m", 1)
          .Within(-1000, 1000)
          .Usually(-20, 20),
      Row("slad.y_min_m", "Y min", kGrid, &GridSettings::y_min_m)
          .Says("Western bound under given bounds, relative to the map centre.")
          .Shown("m", 1)
          .Within(-1000, 1000)
          .Usually(-20, 20),
      Row("slad.y_max_m", "Y max", kGrid, &GridSettings::y_max_m)
          .Says("Eastern bound under given bounds, relative to the map centre.")
          .Shown("m", 1)
          .Within(-1000, 1000)
          .Usually(-20, 20),
      Row("slad.border_size_cells", "Border size", kGrid, &GridSettings::border_size_cells)
          .Says(
              "How far the rim is interpolated. Modern mode draws it apart and never lands there.")
          .Shown("cells", 0)
          .Within(0, 50)
          .Usually(0, 10),
      Row("slad.data_size_cells", "Data size", kGrid, &GridSettings::data_size_cells)
          .Says("Holes up to this size are filled. Modern mode never lands on filled cells.")
          .Shown("cells", 0)
          .Within(0, 20)
          .Usually(0, 4),
  };
}

std::vector<Row> FusionRows() {
  return {
      Row("slad.frames_fused", "Frames fused", kFusion, &FusionSettings::frames_fused)
          .Says("A cell forgets frames older than this many maps.")
          .Shown("", 0)
          .Within(1, 200)
          .Usually(5, 50),
      Row("slad.site_spacing_m", "Site spacing", kChoice, &SiteChoice::spacing_m)
          .Says("Least distance between two proposed sites.")
          .Shown("m", 1)
          .Within(0.5, 50)
          .Usually(2, 10),
      Row("slad.sites_kept", "Sites kept", kChoice, &SiteChoice::sites_kept)
          .Says("Most sites proposed at once.")
          .Shown("", 0)
          .Within(1, 12)
          .Usually(1, 8),
      Row("slad.choice", "Choice", kChoice, &SiteChoice::ranking)
          .Says("farthest: most room to any hazard, less what may hide there. cost: least cost.")
          .Choice({"farthest", "cost"}),
  };
}

std::vector<Row> StereoRows() {
  return {
      Row("stereo.method", "Matcher", kStereo, &StereoSettings::method)
          .Says("Whole pixels: census (our semi-global matcher) or sgbm (OpenCV's three-way SGBM).")
          .Choice({"sgbm", "census"}),
      Row("stereo.pyramid_levels", "Pyramid levels", kStereo, &StereoSettings::pyramid_levels)
          .Says("Times the pictures are halved for the whole-pixel search. Faster, but small "
                "objects go first.")
          .Shown("", 0)
          .Within(0, 3)
          .Usually(0, 1),
      Row("stereo.prefilter", "Prefilter", kStereo, &StereoSettings::prefilter)
          .Says("Filter before the whole-pixel search; the fraction is measured in unfiltered "
                "pictures.")
          .Choice({"none", "laplacian", "bilateral"}),
      Row("stereo.filter_order", "Filter order", kStereo, &StereoSettings::filter_order)
          .Says("Whether the prefilter sees rectified pictures, or raw ones as in the thesis.")
          .Choice({"rectify_filter", "filter_rectify"}),
      Row("stereo.num_disparities", "Disparities", kStereo, &StereoSettings::num_disparities)
          .Says("Width of the disparity window, a multiple of 16.")
          .Shown("px", 0)
          .Within(16, 256)
          .Usually(32, 160),
      Row("stereo.block_size_px", "Block size", kStereo, &StereoSettings::block_size_px)
          .Says("Side of the block of OpenCV's matcher, odd.")
          .Shown("px", 0)
          .Within(3, 15)
          .Usually(3, 9),
      Row("stereo.refine_window_px", "Refine window", kStereo, &StereoSettings::refine_window_px)
          .Says("Side of the window that refines the fraction of a pixel, odd.")
          .Shown("px", 0)
          .Within(5, 21)
          .Usually(7, 13),
      Row("stereo.max_sigma_px", "Max sigma", kStereo, &StereoSettings::max_sigma_px)
          .Says("Points with a larger disparity sigma are unknown.")
          .Shown("px", 2)
          .Within(0.05, 3)
          .Usually(0.2, 1),
      Row("stereo.uniqueness_percent", "Uniqueness", kStereo, &StereoSettings::uniqueness_percent)
          .Says("Margin of the best match over the second.")
          .Shown("%", 0)
          .Within(0, 50)
          .Usually(0, 20),
      Row("stereo.max_left_right_px", "Left-right limit", kStereo,
          &StereoSettings::max_left_right_px)
          .Says("Largest disagreement of the two matching directions.")
          .Shown("px", 1)
          .Within(0.5, 4),
      Row("stereo.max_refined_left_right_px", "Refined left-right limit", kStereo,
          &StereoSettings::max_refined_left_right_px)
          .Says("The same with the fraction: a pixel further behind the nearest surface that the "
                "right camera sees there is hidden from it.")
          .Shown("px", 2)
          .Within(0.1, 4)
          .Usually(0.25, 1),
      Row("stereo.map_every_frames", "Map every", kStereo, &StereoSettings::map_every_frames)
          .Says("A new range map every so many frames.")
          .Shown("frames", 0)
          .Within(1, 30)
          .Usually(1, 5),
  };
}

std::vector<Row> TrackerRows() {
  return {
      Row("tracking.mode", "Tracker", kTracking, &TrackingSettings::mode)
          .Says("template: refreshed each frame, as the thesis. plane: keyframe-anchored.")
          .Choice({"template", "plane"}),
      Row("tracking.template_size_px", "Template size", kTracking,
          &TrackingSettings::template_size_px)
          .Says("Side of the site's own template, odd.")
          .Shown("px", 0)
          .Within(11, 101)
          .Usually(21, 61),
      Row("tracking.search_radius_px", "Search radius", kTracking,
          &TrackingSettings::search_radius_px)
          .Says("Half side of the search window.")
          .Shown("px", 0)
          .Within(4, 128)
          .Usually(16, 64),
      Row("tracking.max_features", "Features", kTracking, &TrackingSettings::max_features)
          .Says("Most features tracked on the ground plane.")
          .Shown("", 0)
          .Within(20, 500)
          .Usually(60, 200),
      Row("tracking.min_coherence", "Min coherence", kTracking, &TrackingSettings::min_coherence)
          .Says("Below it the tracker re-anchors; still below: vision is lost.")
          .Shown("", 2)
          .Within(0.1, 0.99)
          .Usually(0.5, 0.9),
      Row("tracking.accel_noise_mps2", "Filter noise", kTracking,
          &TrackingSettings::accel_noise_mps2)
          .Says("Acceleration noise of the vision filter, per root hertz.")
          .Shown("m/s²", 3)
          .Within(0.001, 5)
          .Usually(0.01, 0.5),
  };
}

std::vector<Row> MissionRows() {
  return {
      Row("mission.glide_slope_deg", "Glide slope", kMission, &MissionSettings::glide_slope_deg)
          .Says("Angle of the descent below the horizon.")
          .Shown("°", 0)
          .Within(20, 90)
          .Usually(30, 60),
      Row("mission.descent_rate_mps", "Descent rate", kMission, &MissionSettings::descent_rate_mps)
          .Says("Sink rate down the glide slope, part of the approval; slower near the ground.")
          .Shown("m/s", 2)
          .Within(0.2, 1.5)
          .Usually(0.4, 1.2),
      Row("mission.arm_window_s", "Arm window", kMission, &MissionSettings::arm_window_s)
          .Says("An armed site disarms after this time.")
          .Shown("s", 0)
          .Within(5, 600)
          .Usually(30, 120),
      Row("mission.approval_expiry_s", "Approval expiry", kMission,
          &MissionSettings::approval_expiry_s)
          .Says("An approval is dead after this time unless descent began.")
          .Shown("s", 0)
          .Within(5, 120)
          .Usually(20, 60),
      Row("mission.propose_after_s", "Propose after", kMission, &MissionSettings::propose_after_s)
          .Says("A site must have won for this long.")
          .Shown("s", 1)
          .Within(0, 60)
          .Usually(0.5, 5),
      Row("mission.propose_after_maps", "Propose after maps", kMission,
          &MissionSettings::propose_after_maps)
          .Says("A site must have won this many maps.")
          .Shown("", 0)
          .Within(1, 100)
          .Usually(2, 10),
      Row("mission.max_vision_outage_s", "Vision outage", kMission,
          &MissionSettings::max_vision_outage_s)
          .Says("Longest inertial flight without vision before climbing away.")
          .Shown("s", 1)
          .Within(0.2, 10)
          .Usually(1, 3),
  };
}

/// What the station reckons with of a vehicle and its file tells; last, as they are set but once.
std::vector<Row> VehicleRows() {
  return {
      Row("slad.gear_forward_m", "Gear forward", kLander, &Lander::gear_forward_m)
          .Says(
              "Middle of the gear, the touchdown point, forward of the vehicle's reference point.")
          .Shown("m", 2)
          .Within(-10, 10)
          .Usually(-0.5, 0.5)
          .HashedWhenChanged(),
      Row("slad.gear_right_m", "Gear right", kLander, &Lander::gear_right_m)
          .Says("Middle of the gear to the right of the vehicle's reference point.")
          .Shown("m", 2)
          .Within(-10, 10)
          .Usually(-0.5, 0.5)
          .HashedWhenChanged(),
      Row("slad.gear_below_m", "Gear below", kLander, &Lander::gear_below_m)
          .Says("Sole of the gear below the vehicle's reference point.")
          .Shown("m", 2)
          .Within(-10, 10)
          .Usually(0.1, 2)
          .HashedWhenChanged(),
      Row("mission.max_wind_mps", "Max wind", kMission, &MissionSettings::max_wind_mps)
          .Says("With more wind at the vehicle nothing can be approved.")
          .Shown("m/s", 1)
          .Within(1, 30)
          .Usually(4, 15)
          .HashedWhenChanged(),
      Row("mission.max_tailwind_mps", "Max tailwind", kMission, &MissionSettings::max_tailwind_mps)
          .Says("An approach with more of the wind from behind is planned only where no other is "
                "clear.")
          .Shown("m/s", 1)
          .Within(0.5, 10)
          .Usually(1, 5)
          .HashedWhenChanged(),
      Row("mission.sun", "Sun", kMission, &MissionSettings::sun)
          .Says("By place: where the sun stands, by UTC and the place below, counts in the choice "
                "of the approach.")
          .Choice({"unknown", "by_place"})
          .HashedWhenChanged(),
      Row("mission.latitude_deg", "Latitude", kMission, &MissionSettings::latitude_deg)
          .Says("Of the place, north positive; for the sun only.")
          .Shown("°", 2)
          .Within(-90, 90)
          .Usually(-60, 70)
          .HashedWhenChanged(),
      Row("mission.longitude_deg", "Longitude", kMission, &MissionSettings::longitude_deg)
          .Says("Of the place, east positive; for the sun only.")
          .Shown("°", 2)
          .Within(-180, 180)
          .Usually(-180, 180)
          .HashedWhenChanged(),
      Row("mission.energy_reserve_s", "Energy reserve", kMission,
          &MissionSettings::energy_reserve_s)
          .Says("Where less flying time is left, at the rate at which fuel or battery fall, an "
                "alarm says so and no look is proposed.")
          .Shown("min", 1, 1 / 60.0)
          .Within(0, 7200)
          .Usually(60, 1200)
          .HashedWhenChanged(),
      Row("mission.settle_s", "Settling", kMission, &MissionSettings::settle_s)
          .Says("How long the vehicle takes in calm air to be still above the site: part of the "
                "time to touchdown.")
          .Shown("s", 1)
          .Within(0, 60)
          .Usually(1, 10)
          .HashedWhenChanged(),
  };
}

std::vector<SettingRow> MakeRows() {
  struct Section {
    const char* group;
    std::vector<Row> rows;
  };
  const Section sections[] = {{kHazardGroup, HazardRows()}, {kLanderGroup, LanderRows()},
                              {"Grid", GridRows()},         {"Fusion and ranking", FusionRows()},
                              {"Stereo", StereoRows()},     {"Tracker", TrackerRows()},
                              {"Mission", MissionRows()},   {"Vehicle", VehicleRows()}};
  std::vector<SettingRow> all;
  for (const Section& section : sections) {
    for (const Row& row : section.rows) {
      all.push_back(row.Done());
      all.back().info.group = section.group;
    }
  }
  return all;
}

}  // namespace

const std::vector<SettingRow>& SettingRows() {
  static const std::vector<SettingRow> rows = MakeRows();
  return rows;
}

}  // namespace palace
