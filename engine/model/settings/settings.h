// Settings: every limit and size a person may tune, with unit, default and range in one table.
// The table binds files, sliders, --set, scripts and documentation.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/result.h"

namespace palace {

enum class SladMode : int { kThesis = 0, kModern = 1 };
enum class SiteRanking : int { kFarthest = 0, kCost = 1 };
enum class LandingGear : int { kSkids = 0, kPads = 1 };
enum class ElevatedSurface : int { kAvoid = 0, kAllow = 1 };
enum class BoundsMode : int { kData = 0, kGiven = 1, kFieldOfView = 2 };

// SLAD's settings: thesis Table 4.4 by name, and what modern mode needs. Angles in degrees only
// here, as in files, where all of them are called "slad.<name>".

/// Where the maps lie, how fine they are, and which holes in them are filled.
struct GridSettings {
  static constexpr int kMostCells = 4096;  ///< along a side, of a map that is made here

  int rows = 100;
  int cols = 100;
  double cell_m = 0.15;  ///< modern mode; thesis mode derives it from the bounds
  BoundsMode bounds = BoundsMode::kData;
  double x_min_m = -7.5;  ///< north, relative to the map centre under kGiven
  double x_max_m = 7.5;
  double y_min_m = -7.5;
  double y_max_m = 7.5;
  int border_size_cells = 2;
  int data_size_cells = 1;
  friend bool operator==(const GridSettings&, const GridSettings&) = default;
};

/// What the ground may be like under the lander.
struct HazardLimits {
  double max_slope_deg = 10;
  double max_deviation_m = 0.10;
  double max_step_m = 0.15;
  double min_safe_probability = 0.90;  ///< see RequiredSafeProbability (cell_explanation.h)
  ElevatedSurface elevated = ElevatedSurface::kAvoid;
  friend bool operator==(const HazardLimits&, const HazardLimits&) = default;
};

/// What lands: its sizes, how it stands, and how well it meets the place.
struct Lander {
  double base_size_m = 3.6;  ///< diameter
  LandingGear gear = LandingGear::kSkids;
  double gear_length_m = 1.2;  ///< of the skids, or between fore and aft pads
  double gear_width_m = 0.9;   ///< between the skids' or pads' middles
  double gear_forward_m = 0;   ///< middle of the gear in B: the touchdown point
  double gear_right_m = 0;
  double gear_below_m = 0.9;
  double belly_clearance_m = 0.35;  ///< of the airframe above the plane the gear rests on
  double rotor_diameter_m = 3.1;
  double max_rock_size_m = 0.40;  ///< spacing of samples in the plane fit
  double up_tilt_deg = 0;         ///< up vector tilted towards up_azimuth_deg
  double up_azimuth_deg = 0;
  double nav_error_m = 0.5;  ///< touchdown dispersion added to the lander radius

  double radius_m() const { return base_size_m / 2; }
  double clear_radius_m() const { return radius_m() + nav_error_m; }
  /// The touchdown point in B, metres.
  Eigen::Vector3d skid_centre_B() const { return {gear_forward_m, gear_right_m, gear_below_m}; }
  /// Unit up vector in W (north, east, down).
  Eigen::Vector3d up_W() const;
  friend bool operator==(const Lander&, const Lander&) = default;
};

/// How long maps are remembered, and until when they are made.
struct FusionSettings {
  int frames_fused = 10;  ///< a cell forgets frames older than this many maps
  double commit_height_m = 3.0;
  friend bool operator==(const FusionSettings&, const FusionSettings&) = default;
};

/// Which places are proposed.
struct SiteChoice {
  SiteRanking ranking = SiteRanking::kFarthest;
  double spacing_m = 3.1;  ///< at least one rotor diameter
  int sites_kept = 6;
  friend bool operator==(const SiteChoice&, const SiteChoice&) = default;
};

struct SladSettings {
  SladMode mode = SladMode::kModern;
  GridSettings grid;
  HazardLimits limits;
  Lander lander;
  FusionSettings fusion;
  SiteChoice choice;
  friend bool operator==(const SladSettings&, const SladSettings&) = default;
};

enum class StereoMethod : int { kSgbm = 0, kCensus = 1 };
enum class StereoPrefilter : int { kNone = 0, kLaplacian = 1, kBilateral = 2 };
enum class FilterOrder : int { kRectifyFirst = 0, kFilterFirst = 1 };

struct StereoSettings {
  StereoMethod method = StereoMethod::kCensus;
  int pyramid_levels = 0;  ///< times the pictures are halved for the whole-pixel search
  StereoPrefilter prefilter = StereoPrefilter::kNone;
  FilterOrder filter_order = FilterOrder::kRectifyFirst;
  int block_size_px = 5;     ///< of OpenCV's matcher
  int num_disparities = 64;  ///< width of the window that follows laser and pose
  int refine_window_px = 9;
  double max_sigma_px = 0.5;  ///< points with a larger disparity sigma are unknown
  double uniqueness_percent = 10;
  double max_left_right_px = 1;
  double max_refined_left_right_px = 0.5;
  int map_every_frames = 1;  ///< a new range map every so many frames
  friend bool operator==(const StereoSettings&, const StereoSettings&) = default;
};

enum class TrackerMode : int { kTemplate = 0, kPlane = 1 };
struct TrackingSettings {
  TrackerMode mode = TrackerMode::kPlane;
  int template_size_px = 41;
  int search_radius_px = 32;
  int max_features = 120;
  double min_coherence = 0.7;
  double accel_noise_mps2 = 0.03;  ///< per sqrt(Hz), of the vision filter
  friend bool operator==(const TrackingSettings&, const TrackingSettings&) = default;
};

enum class SunSource : int { kUnknown = 0, kByPlace = 1 };
struct MissionSettings {
  double glide_slope_deg = 45;
  double descent_rate_mps = 1.0;
  double arm_window_s = 60;
  double approval_expiry_s = 30;
  double propose_after_s = 1;
  int propose_after_maps = 3;
  double max_vision_outage_s = 2;
  double max_wind_mps = 8;                     ///< in which the vehicle's controllers hold a hover
  double max_tailwind_mps = 2.5;               ///< of an approach; a judgement, 5 knots
  SunSource sun = SunSource::kUnknown;         ///< kByPlace: by UTC and the two below
  double latitude_deg = 0, longitude_deg = 0;  ///< north and east positive
  double energy_reserve_s = 300;  ///< of flying time that no search uses up; 0: it may use all
  double settle_s = 3.8;  ///< until the vehicle is still above the site, by landings in calm air
  friend bool operator==(const MissionSettings&, const MissionSettings&) = default;
};

struct Settings {
  SladSettings slad;
  StereoSettings stereo;
  TrackingSettings tracking;
  MissionSettings mission;
  friend bool operator==(const Settings&, const Settings&) = default;
};

/// One row of the table of settings.
struct SettingInfo {
  std::string name{};         ///< "slad.max_slope_deg", as files and scripts write it
  std::string label{};        ///< "Max slope", as the screen shows it
  std::string group{};        ///< "Hazard limits"
  std::string description{};  ///< one or two sentences
  std::string unit{};         ///< shown unit: "°", "cm", "m", "cells", ""
  double shown_per_unit = 1;  ///< shown value = value * shown_per_unit (100 for cm)
  int decimals = 1;           ///< of the shown value
  double min = 0;             ///< hard limits
  double max = 0;
  double soft_min = 0;  ///< usual range; outside it is hatched
  double soft_max = 0;
  double default_value = 0;
  bool integer = false;
  std::vector<std::string> words{};  ///< for choices: value 0, 1, ... as written in files
};

/// All settings, in the order screens and files show them.
const std::vector<SettingInfo>& SettingTable();
/// Null when no setting has that name.
const SettingInfo* FindSetting(std::string_view name);
double GetSetting(const Settings& settings, std::string_view name);
/// Refuses unknown names and values out of range, naming the limit. Bounds that contradict
/// each other (x_min_m >= x_max_m) are refused where a file is read whole (settings_io.h).
Status SetSettingValue(Settings& settings, std::string_view name, double value);
/// The value a drag may reach: clamped to the hard limits and rounded for integers.
double ClampSetting(const SettingInfo& info, double value);
std::uint64_t HashOf(const Settings& settings);
/// "10.0°", "8.0 cm", "thesis": the value as the screen shows it, with its unit.
std::string FormatSetting(const SettingInfo& info, double value);

}  // namespace palace
