#include "engine/simulation/sensor_tables.h"

#include <cmath>
#include <vector>

#include "engine/camera/camera_pair.h"
#include "engine/camera/files/camera_files.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/model/rig_limits.h"
#include "engine/simulation/vehicle_tables.h"

namespace palace {
namespace {

constexpr NumberLimits kShare{0, 1, "give a share"};
constexpr NumberLimits kLoss{0, 0.95, "give a share; what never comes at all is a fault"};
constexpr NumberLimits kMetres{0, 10, "give metres"};
constexpr double kMsPerS = 1e-3, kUsPerS = 1e-6, kPerMillion = 1e-6, kMilliradian = 1e-3;

/// Required and optional numbers of one table, kept for showing in the units of the file.
class FigureTable {
 public:
  FigureTable(const toml::table& root, const std::string& file, const std::string& name,
              VehicleDescription& v)
      : name_(name), table_(root, file, name), shown_(v.sensor_values) {}

  TomlTable& plain() { return table_; }
  void Need(const std::vector<NumberRow>& rows) {
    ReadNumbers(table_, rows);
    for (const NumberRow& row : rows) {
      Show(row, true);
    }
  }
  /// What is left out keeps its value.
  void May(const std::vector<NumberRow>& rows) {
    for (const NumberRow& row : rows) {
      table_.Allow(row.key);
      const bool given = table_.Has(row.key);
      if (given) {
        ReadNumbers(table_, {row});
      }
      Show(row, given);
    }
  }
  void MayWhole(const char* key, int& into, int greatest, const char* remedy) {
    double value = into;
    May({{key, &value, {1, static_cast<double>(greatest), remedy, true}}});
    into = static_cast<int>(value);
  }
  double Rate() {
    const double rate_hz = ReadRate(table_, "rate_hz");
    shown_.push_back({name_ + ".rate_hz", rate_hz, true});
    return rate_hz;
  }
  Status Finish() { return table_.Finish(); }

 private:
  void Show(const NumberRow& row, bool given) {
    shown_.push_back({name_ + "." + row.key, *row.into / row.si, given});
  }
  std::string name_;
  TomlTable table_;
  std::vector<SensorValue>& shown_;
};

/// Two ideal pinholes from width, height and view_deg.
void ReadPinholes(TomlTable& table, StereoRig& rig) {
  PinholeCamera camera;
  double view_rad = 1;
  const NumberLimits side{RigLimits::kLeastSide_px, RigLimits::kMostSide_px, "give pixels", true};
  camera.width = static_cast<int>(table.Number("width", side));
  camera.height = static_cast<int>(table.Number("height", side));
  ReadNumbers(table,
              {{"baseline_m", &rig.baseline_m, {0.02, 10, "give metres between the focal points"}},
               {"view_deg", &view_rad, {5, 120, "give the horizontal angle of view"}, kRadPerDeg}});
  if (const std::string why = WhyNoPictureSize(camera.width, camera.height);
      table.Finish() && !why.empty()) {
    table.FailKey("height", ": " + why);
  }
  camera.fx_px = camera.fy_px = camera.width / 2.0 / std::tan(view_rad / 2);
  camera.cx_px = (camera.width - 1) / 2.0;
  camera.cy_px = (camera.height - 1) / 2.0;
  rig.left.pinhole = rig.right.pinhole = camera;
}

/// Two cameras of any lens family, from the files that left_model_file and right_model_file name.
/// The first failure of a file is its own; of the table, the table's.
Status ReadModels(TomlTable& table, const std::optional<std::filesystem::path>& folder,
                  StereoRig& rig) {
  table.Allow("view_deg");
  if (table.Has("view_deg")) {
    table.FailKey("view_deg", " contradicts left_model_file; give one of them");
  }
  CameraFileOptions options;
  for (const char* key : {"width", "height", "baseline_m"}) {
    table.Allow(key);
  }
  if (table.Has("width") || table.Has("height")) {  // for files that tell no size
    const NumberLimits side{RigLimits::kLeastSide_px, RigLimits::kMostSide_px, "give pixels", true};
    options.size.width = static_cast<int>(table.Number("width", side));
    options.size.height = static_cast<int>(table.Number("height", side));
  }
  std::optional<double> baseline_m;
  if (table.Has("baseline_m")) {
    baseline_m = table.Number("baseline_m", {0.02, 10, "give metres between the focal points"});
  }
  const std::string names[] = {table.Text("left_model_file"), table.Text("right_model_file")};
  if (!folder) {
    table.FailKey("left_model_file", " = \"" + names[0] +
                                         "\": this text is no file on disk, so it "
                                         "cannot name one");
  }
  if (const Status read = table.Finish(); !read) {
    return read;
  }
  std::vector<CameraModel> models;
  for (const StereoSide side : {StereoSide::kLeft, StereoSide::kRight}) {
    options.side = side;
    const std::string& name = names[side == StereoSide::kLeft ? 0 : 1];
    auto model = ReadCameraFile(*folder / name, options);
    if (!model) {
      return model.error();
    }
    if (!HasSize(*model)) {
      table.FailKey(side == StereoSide::kLeft ? "left_model_file" : "right_model_file",
                    " = \"" + name + "\": the file tells no picture size; add width and height");
      return table.Finish();
    }
    models.push_back(std::move(*model));
  }
  const auto pair = PlacePair(models[0], models[1], baseline_m, names[0], names[1]);
  if (!pair) {
    return pair.error();
  }
  SetCameras(rig, *pair);
  return Ok();
}

/// An exposure and its readout are over before the next begins.
void CheckShutter(TomlTable& table, const VehicleDescription& v) {
  const CameraFigures& c = v.sensors.camera;
  const int rows = std::max(v.rig.left.pinhole.height, v.rig.right.pinhole.height);
  const double taken_s = c.exposure_s + c.line_delay_s * (rows - 1);
  if (taken_s > 1 / v.rig.rate_hz) {
    table.FailKey(c.line_delay_s > 0 ? "line_delay_us" : "exposure_ms",
                  ": exposure and readout of " + std::to_string(rows) + " rows take " +
                      NumberText(1e3 * taken_s) + " ms, a pair comes every " +
                      NumberText(1e3 / v.rig.rate_hz) + " ms");
  }
}

Status ReadCamera(const toml::table& root, const std::string& file,
                  const std::optional<std::filesystem::path>& folder, VehicleDescription& v) {
  FigureTable figures(root, file, "camera", v);
  TomlTable& table = figures.plain();
  StereoRig& rig = v.rig;
  CameraFigures& c = v.sensors.camera;
  const std::vector<double> place = table.Numbers(
      "position_body_m", 3, 3, {-10, 10, "give the left focal point forward, right and down"});
  if (place.size() == 3) {
    rig.position_body_m = {place[0], place[1], place[2]};
  }
  figures.Need(
      {{"tilt_deg", &rig.tilt_rad, {-90, 0, "-90 looks straight down, 0 ahead"}, kRadPerDeg},
       {"rate_hz", &rig.rate_hz, {0.5, 120, "give pairs a second"}},
       {"noise_grey", &c.noise_grey, {0, 50, "give grey levels of 255"}},
       {"brightness_gain_right", &c.brightness_gain_right, {0.1, 10, "1 is alike"}}});
  const NumberLimits offset{-100, 100, "give grey levels of 255"};
  const NumberLimits exposure{0, 200, "give milliseconds; 0 is an instant"};
  const NumberLimits line{0, 1000, "give microseconds from row to row; 0 is a global shutter"};
  figures.May(
      {{"gain", &c.gain, {0.05, 20, "1 is as bright as the scene"}},
       {"offset_left_grey", &c.offset_left_grey, offset},
       {"offset_right_grey", &c.offset_right_grey, offset},
       {"full_well_electrons",
        &c.full_well_electrons,
        {100, 1e7, "give electrons that make grey 255, or leave it out"}},
       {"blur_px", &c.blur_px, {0, 10, "give pixels, one standard deviation"}},
       {"vignetting", &c.vignetting, {0, 0.95, "give the share of light that corners lack"}},
       {"exposure_ms", &c.exposure_s, exposure, kMsPerS},
       {"line_delay_us", &c.line_delay_s, line, kUsPerS},
       {"right_late_ms", &c.right_late_s, {-200, 200, "give milliseconds"}, kMsPerS},
       {"latency_s", &c.latency_s, {0, 0.5, "give seconds"}},
       {"dropped", &c.dropped, kLoss},
       {"repeated", &c.repeated, kLoss}});
  figures.MayWhole("exposure_samples", c.exposure_samples, 64, "give moments of an exposure");
  figures.MayWhole("shutter_bands", c.shutter_bands, 128, "give bands of rows");
  const bool of_files = table.Has("left_model_file") || table.Has("right_model_file");
  for (const char* key : {"left_model_file", "right_model_file"}) {
    table.Allow(key);
  }
  if (of_files) {
    if (const Status read = ReadModels(table, folder, rig); !read) {
      return read;
    }
  } else {
    ReadPinholes(table, rig);
  }
  if (table.Finish()) {
    CheckShutter(table, v);
  }
  return table.Finish();
}

Status ReadGps(const toml::table& root, const std::string& file, VehicleDescription& v) {
  FigureTable table(root, file, "gps", v);
  SensorFigures& s = v.sensors;
  s.gps_rate_hz = table.Rate();
  constexpr double kLongest_s = 0.9;  // the vehicle's navigation keeps a second
  const NumberLimits sigma{0.001, 50, "give metres, one standard deviation"};
  const NumberLimits drift{0, 50, "give metres, one standard deviation"};
  const NumberLimits latency{0, kLongest_s, "give seconds"};
  table.Need({{"horizontal_m", &s.gps.horizontal_m, sigma},
              {"vertical_m", &s.gps.vertical_m, sigma},
              {"velocity_mps", &s.gps.velocity_mps, {0.001, 10, "give m/s"}},
              {"latency_s", &s.gps.latency_s, latency}});
  table.May({{"latency_jitter_s", &s.gps.latency_jitter_s, latency},
             {"drift_horizontal_m", &s.gps.drift_horizontal_m, drift},
             {"drift_vertical_m", &s.gps.drift_vertical_m, drift},
             {"drift_time_s", &s.gps.drift_time_s, {1, 1e6, "give seconds"}},
             {"dropout", &s.gps.dropout, kLoss}});
  if (table.Finish() && s.gps.latency_s + s.gps.latency_jitter_s > kLongest_s) {
    table.plain().FailKey("latency_jitter_s",
                          " = " + NumberText(s.gps.latency_jitter_s) + " and latency_s = " +
                              NumberText(s.gps.latency_s) + " are more than 0.9 s together");
  }
  return table.Finish();
}

Status ReadImu(const toml::table& root, const std::string& file, VehicleDescription& v) {
  FigureTable table(root, file, "imu", v);
  ImuNoise& imu = v.sensors.imu;
  v.sensors.imu_rate_hz = table.Rate();
  table.Need({{"gyro_rad_s_sqrt_hz", &imu.gyro_rad_s_sqrt_hz, kShare},
              {"accel_mps2_sqrt_hz", &imu.accel_mps2_sqrt_hz, kShare},
              {"gyro_bias_rad_s", &imu.gyro_bias_rad_s, kShare},
              {"accel_bias_mps2", &imu.accel_bias_mps2, kShare}});
  const NumberLimits scale{0, 100'000, "give parts in a million, one standard deviation"};
  table.May(
      {{"gyro_walk_rad_s2_sqrt_hz", &imu.gyro_walk_rad_s2_sqrt_hz, kShare},
       {"accel_walk_mps3_sqrt_hz", &imu.accel_walk_mps3_sqrt_hz, kShare},
       {"gyro_scale_ppm", &imu.gyro_scale, scale, kPerMillion},
       {"accel_scale_ppm", &imu.accel_scale, scale, kPerMillion},
       {"misalignment_deg", &imu.misalignment_rad, {0, 5, "give degrees"}, kRadPerDeg},
       {"gyro_limit_rad_s", &imu.gyro_limit_rad_s, {0.1, 100, "give rad/s, or leave it out"}},
       {"accel_limit_mps2",
        &imu.accel_limit_mps2,
        {12, 1000, "give m/s2, more than gravity, or leave it out"}},
       {"gyro_quantum_rad_s", &imu.gyro_quantum_rad_s, {0, 0.1, "give rad/s"}},
       {"accel_quantum_mps2", &imu.accel_quantum_mps2, {0, 1, "give m/s2"}},
       {"vibration_mps2", &imu.vibration_mps2, {0, 50, "give m/s2, the amplitude of each axis"}},
       {"vibration_hz", &imu.vibration_hz, {0.1, 2000, "give hertz"}}});
  return table.Finish();
}

Status ReadAttitude(const toml::table& root, const std::string& file, VehicleDescription& v) {
  FigureTable table(root, file, "attitude", v);
  AhrsNoise& attitude = v.sensors.attitude;
  const NumberLimits angle{0, 10, "give degrees"};
  table.Need({{"white_deg", &attitude.white_rad, angle, kRadPerDeg},
              {"bias_deg", &attitude.bias_rad, angle, kRadPerDeg},
              {"bias_time_s", &attitude.bias_time_s, {0.1, 1e6, "give seconds"}}});
  table.May({{"delay_s", &attitude.delay_s, {0, 0.5, "give seconds"}}});
  return table.Finish();
}

Status ReadLaser(const toml::table& root, const std::string& file, VehicleDescription& v) {
  FigureTable table(root, file, "laser", v);
  LaserNoise& laser = v.sensors.laser;
  v.sensors.laser_rate_hz = table.Rate();
  table.Need({{"sigma_m", &laser.sigma_m, kMetres},
              {"sigma_per_m", &laser.sigma_per_m, kShare},
              {"quantum_m", &laser.quantum_m, {1e-4, 1, "give metres"}},
              {"dropout", &laser.dropout, kShare},
              {"max_range_m", &laser.max_range_m, {1, 2000, "give metres"}}});
  table.May({{"footprint_mrad", &laser.footprint_rad, {0, 100, "give milliradians"}, kMilliradian},
             {"spike", &laser.spike, kShare},
             {"spike_m", &laser.spike_m, {0, 100, "give metres"}}});
  return table.Finish();
}

Status ReadClock(const toml::table& root, const std::string& file, VehicleDescription& v) {
  FigureTable table(root, file, "clock", v);
  table.May({{"drift_ppm",
              &v.clock_drift,
              {-500, 500, "give microseconds a second; quartz has up to 100"},
              kPerMillion}});
  return table.Finish();
}

}  // namespace

Status ReadSensors(const toml::table& root, const std::string& file,
                   const std::optional<std::filesystem::path>& folder, VehicleDescription& v) {
  Status status = ReadCamera(root, file, folder, v);
  for (const auto& read : {ReadGps, ReadImu, ReadAttitude, ReadLaser, ReadClock}) {
    status = status ? read(root, file, v) : status;
  }
  return status;
}

}  // namespace palace
