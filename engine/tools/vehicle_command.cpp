#include "engine/tools/vehicle_command.h"

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "engine/camera/camera_model.h"
#include "engine/core/files.h"
#include "engine/core/text.h"
#include "engine/core/units.h"
#include "engine/simulation/vehicle_file.h"

namespace palace {
namespace {

struct VehicleOptions {
  std::string vehicle;  ///< empty: list them
  std::string write;
};

int Fail(const Error& error) {
  std::cerr << "palacectl vehicle: " << error.message << "\n";
  return error.code == ErrorCode::kUsage ? 2 : 1;
}

/// "32 of 37 recalled".
std::string MarkCounts(const VehicleDescription& vehicle) {
  std::string text;
  for (const ValueMark mark :
       {ValueMark::kSourced, ValueMark::kRecalled, ValueMark::kComputed, ValueMark::kChosen}) {
    int count = 0;
    for (const MarkedValue& value : vehicle.marked) {
      count += value.mark == mark ? 1 : 0;
    }
    if (count > 0) {
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + ValueMarkName(mark);
    }
  }
  return text;
}

void Print(const VehicleDescription& v) {
  const bool multirotor = std::holds_alternative<MultirotorParameters>(v.model);
  const Eigen::Vector3d camera = v.rig.position_body_m, gear = v.lander.skid_centre_B();
  std::printf("%s, %s, from %s\n", v.name.c_str(), multirotor ? "multirotor" : "helicopter",
              v.origin.c_str());
  std::printf("mass %.3g kg, base %.2f m, gear %.2f by %.2f m at (%.2f, %.2f, %.2f) m\n", v.mass_kg,
              v.lander.base_size_m, v.lander.gear_length_m, v.lander.gear_width_m, gear.x(),
              gear.y(), gear.z());
  std::printf("cameras at (%.2f, %.2f, %.2f) m, tilt %.1f deg, baseline %.2f m, %d x %d, %.3g Hz\n",
              camera.x(), camera.y(), camera.z(), Deg(v.rig.tilt_rad), v.rig.baseline_m,
              v.rig.left.pinhole.width, v.rig.left.pinhole.height, v.rig.rate_hz);
  std::printf("touchdown to %.2f m/s down, %.2f m/s across, %.1f deg; wind to %.1f m/s\n",
              v.gear.sink_mps, v.gear.across_mps, Deg(v.gear.tilt_rad), v.limits.max_wind_mps);
  std::printf("%s\n", MarkCounts(v).c_str());
  for (const MarkedValue& value : v.marked) {
    std::printf("  %-34s %12s  %s\n", value.name.c_str(), NumberText(value.value).c_str(),
                ValueMarkName(value.mark));
  }
}

/// What the file says of its sensors; what it leaves out is off.
void PrintSensors(const VehicleDescription& v) {
  for (const auto& [name, camera] :
       {std::pair("left", &v.rig.left), std::pair("right", &v.rig.right)}) {
    if (camera->model) {
      std::printf("%s camera: %s\n", name, FamilyOf(*camera->model).c_str());
    }
  }
  std::string left_out;
  std::printf("sensors\n");
  for (const SensorValue& value : v.sensor_values) {
    if (value.given) {
      std::printf("  %-34s %12s\n", value.name.c_str(), NumberText(value.value).c_str());
    } else {
      left_out += (left_out.empty() ? "" : ", ") + value.name;
    }
  }
  std::printf("left out, so off or as usual: %s\n",
              left_out.empty() ? "nothing" : left_out.c_str());
}

int ShowVehicle(const VehicleOptions& options) {
  if (options.vehicle.empty() && !options.write.empty()) {
    return Fail(UsageError("--write: which vehicle? Name one of " + Joined(VehicleNames())));
  }
  if (options.vehicle.empty()) {
    for (const std::string& name : VehicleNames()) {
      std::printf("%-12s %s\n", name.c_str(), LoadVehicle(name).value().name.c_str());
    }
    return 0;
  }
  const Result<VehicleDescription> vehicle = LoadVehicle(options.vehicle);
  if (!vehicle) {
    return Fail(vehicle.error());
  }
  if (options.write.empty()) {
    Print(*vehicle);
    PrintSensors(*vehicle);
    return 0;
  }
  const std::string_view text = VehicleText(options.vehicle);
  if (text.empty()) {
    return Fail(UsageError("--write copies a built-in vehicle: " + Joined(VehicleNames())));
  }
  if (std::error_code none; std::filesystem::exists(options.write, none)) {
    return Fail(UsageError(options.write + " is there already; name another file"));
  }
  const Status written = WriteTextFile(options.write, std::string(text));
  return written ? 0 : Fail(written.error());
}

}  // namespace

void AddVehicleCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "vehicle",
      "List the vehicles, or check a vehicle file and show its figures with their marks");
  const auto options = std::make_shared<VehicleOptions>();
  command->add_option("vehicle", options->vehicle,
                      "A name (" + Joined(VehicleNames()) + ") or a file; nothing: list the names");
  command->add_option("--write", options->write, "Copy the file of a built-in vehicle, to edit it");
  command->callback([options, &exit_code] { exit_code = ShowVehicle(*options); });
}

}  // namespace palace
