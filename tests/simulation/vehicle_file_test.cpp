// Vehicle files: the built-in ones are what they were, every number of them is used, and a mistake
// is named with file, line, key, value and limit.
#include "engine/simulation/vehicle_file.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/world/scene_library.h"
#include "tests/support/own_path.h"

namespace palace {
namespace {

std::string Text(std::string_view vehicle = kDefaultVehicle) {
  return std::string(VehicleText(vehicle));
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

int LineOf(const std::string& text, const std::string& what) {
  const std::size_t at = text.find(what);
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
}

TEST(VehicleFile, EveryBuiltInVehicleIsWhole) {
  ASSERT_EQ(VehicleNames(), (std::vector<std::string>{"multirotor", "r50"}));
  for (const std::string& name : VehicleNames()) {
    const auto vehicle = LoadVehicle(name);
    ASSERT_TRUE(vehicle) << vehicle.error().message;
    EXPECT_FALSE(vehicle->name.empty());
    EXPECT_EQ(vehicle->origin, name + ".toml (built in)");
    EXPECT_GT(vehicle->marked.size(), 15u) << "each real figure has its mark";
  }
}

// What a station reckons with when it is told of no vehicle is the default one.
TEST(VehicleFile, TheDefaultVehicleIsTheOneOfTheDefaultSettingsAndRig) {
  const VehicleDescription& r50 = DefaultVehicle();
  EXPECT_EQ(SettingsFor(r50), Settings{});
  const StereoRig rig = DefaultRig();
  EXPECT_EQ(r50.rig.left.pinhole.fx_px, rig.left.pinhole.fx_px);
  EXPECT_EQ(r50.rig.left.pinhole.width, rig.left.pinhole.width);
  EXPECT_EQ(r50.rig.right.pinhole.cy_px, rig.right.pinhole.cy_px);
  EXPECT_EQ(r50.rig.position_body_m, rig.position_body_m);
  EXPECT_EQ(r50.rig.baseline_m, rig.baseline_m);
  EXPECT_EQ(r50.rig.tilt_rad, rig.tilt_rad);
  EXPECT_EQ(r50.rig.rate_hz, rig.rate_hz);
  EXPECT_EQ(r50.actuators.delay_s, 0.02);
  EXPECT_TRUE(std::isinf(r50.actuators.rate_per_s));
  EXPECT_FALSE(r50.ground_effect.on);
}

TEST(VehicleFile, MarksAreKept) {
  const auto mark_of = [](const VehicleDescription& vehicle, const std::string& name) {
    for (const MarkedValue& value : vehicle.marked) {
      if (value.name == name) {
        return std::string(ValueMarkName(value.mark));
      }
    }
    return std::string("none");
  };
  EXPECT_EQ(mark_of(DefaultVehicle(), "derivatives.Xu"), "recalled");
  EXPECT_EQ(mark_of(DefaultVehicle(), "ground_effect.rotor_radius_m"), "sourced");
  const std::string text = Replaced(Text(), "Xu = { value = -0.0505, mark = \"recalled\" }",
                                    "Xu = { value = -0.0611, mark = \"sourced\" }");
  const auto replaced = ParseVehicle(text, "mine.toml");
  ASSERT_TRUE(replaced) << replaced.error().message;
  EXPECT_EQ(mark_of(*replaced, "derivatives.Xu"), "sourced");
  EXPECT_EQ(std::get<RotorcraftParameters>(replaced->model).Xu, -0.0611);
  EXPECT_EQ(mark_of(LoadVehicle("multirotor").value(), "multirotor.arm_m"), "chosen");
}

TEST(VehicleFile, TheStationIsToldSizesAndWind) {
  const VehicleDescription multirotor = LoadVehicle("multirotor").value();
  Settings settings = SettingsFor(multirotor);
  EXPECT_EQ(settings.slad.lander.base_size_m, 1.3);
  EXPECT_EQ(settings.slad.lander.skid_centre_B(), Eigen::Vector3d(0, 0, 0.3));
  EXPECT_EQ(settings.slad.lander.nav_error_m, Settings{}.slad.lander.nav_error_m);
  EXPECT_EQ(settings.mission.max_wind_mps, multirotor.limits.max_wind_mps);
  settings.slad.lander = Settings{}.slad.lander;
  settings.mission.max_wind_mps = Settings{}.mission.max_wind_mps;
  settings.mission.settle_s = Settings{}.mission.settle_s;
  EXPECT_EQ(settings, Settings{}) << "and nothing else";
}

struct Mistake {
  const char* name;
  const char* from;  ///< of the vehicle's own file
  const char* to;
  const char* said;  ///< after file and line
  const char* vehicle = "r50";
  const char* at = nullptr;  ///< the text whose line is named; null: `to`
};

TEST(VehicleFile, MistakesAreNamed) {
  const Mistake mistakes[] = {
      {"no TOML", "[vehicle]", "[vehicle", ""},
      {"unknown table", "[gps]", "[gsp]", "unknown table [gsp]; known here: "},
      {"model of another kind", "[derivatives]\n", "[multirotor]\n", "unknown table [multirotor]",
       "r50", "[multirotor]\ntau_f"},
      {"unknown kind", "\"helicopter\"", "\"blimp\"",
       "vehicle.kind = \"blimp\" must be helicopter or multirotor"},
      {"unknown key", "travel = 1 ", "travle = 1 ", "actuators.travel is missing", "r50",
       "[actuators]"},
      {"a key too many", "travel = 1 ", "slack = 2\ntravel = 1 ",
       "unknown key actuators.slack; known here: "},
      {"weight", "value = 68", "value = 0",
       "mass_kg.value = 0 is outside 0.1 .. 2000; give kilograms"},
      {"not a number", "base_size_m = 3.6", "base_size_m = nan",
       "airframe.base_size_m = nan is outside 0.2 .. 20"},
      {"a whole number that no double holds", "base_size_m = 3.6", "base_size_m = 9007199254740993",
       "airframe.base_size_m = 9.007199255e+15 is outside 0.2 .. 20"},
      {"a text for a number", "base_size_m = 3.6", "base_size_m = \"3.6\"",
       "airframe.base_size_m must be a number"},
      {"gear wider than the vehicle", "base_size_m = 3.6", "base_size_m = 1.4",
       "airframe.base_size_m = 1.4 does not hold the gear, 1.5 m from corner to corner"},
      {"gear", "gear = \"skids\"", "gear = \"wheels\"",
       "airframe.gear = \"wheels\" must be skids or pads"},
      {"camera that looks up", "tilt_deg = -45", "tilt_deg = 45",
       "camera.tilt_deg = 45 is outside -90 .. 0; -90 looks straight down"},
      {"a place of two numbers", "[0.8, -0.5, 0.3]", "[0.8, -0.5]",
       "camera.position_body_m must be a list of 3 numbers"},
      {"huge pictures", "width = 640\nheight = 480", "width = 8192\nheight = 8192",
       "camera.height: ", "r50", "height = 8192"},
      {"limits crossed", "max_descent_rate_mps = 1.5", "max_descent_rate_mps = 0.05",
       "limits.max_descent_rate_mps = 0.05 lies below min_descent_rate_mps = 0.1"},
      {"no mark", "{ value = 82.6, mark = \"recalled\" }", "{ value = 82.6 }",
       "Ma.mark is missing"},
      {"unmarked", "Ma = { value = 82.6, mark = \"recalled\" }", "Ma = 82.6",
       "derivatives.Ma must be { value = ..., mark = \"...\" }"},
      {"a mark of one's own", "Ma = { value = 82.6, mark = \"recalled\" }",
       "Ma = { value = 82.6, mark = \"guessed\" }",
       "Ma.mark = \"guessed\" must be sourced, recalled, computed or chosen"},
      {"a derivative is missing", "Ma = { value = 82.6, mark = \"recalled\" }", "",
       "derivatives.Ma is missing; give { value = ..., mark = \"...\" }", "r50", "[derivatives]\n"},
      {"impossible derivative", "value = 82.6", "value = 1e9",
       "Ma.value = 1000000000 is outside -1000 .. 1000"},
      {"a lag shorter than a step", "tau_f = { value = 0.046", "tau_f = { value = 0.001",
       "tau_f.value = 0.001 is outside 0.005 .. 5"},
      {"delay off the grid", "delay_s = 0.02", "delay_s = 0.021",
       "actuators.delay_s = 0.021 is no multiple of 0.005 s"},
      {"rate off the grid", "control_rate_hz = 50", "control_rate_hz = 30",
       "actuators.control_rate_hz = 30 does not divide the simulator's 200 steps a second"},
      {"rate of nothing", "[laser]\nrate_hz = 20", "[laser]\nrate_hz = 0",
       "laser.rate_hz = 0 is outside 1 .. 200", "r50", "rate_hz = 0"},
      {"share", "dropout = 0.02", "dropout = 2", "laser.dropout = 2 is outside 0 .. 1"},
      {"too heavy to lift", "value = 5, ", "value = 50, ",
       "multirotor.max_thrust_n = 25 is too little: four must lift 1.2 times 490.3325 N",
       "multirotor", "max_thrust_n"},
      {"too light to sink", "min_thrust_n = { value = 1,", "min_thrust_n = { value = 13,",
       "multirotor.min_thrust_n = 13 is too much", "multirotor"},
      {"motors without lag", "motor_lag_s = { value = 0.05", "motor_lag_s = { value = 0",
       "motor_lag_s.value = 0 is outside 0.005 .. 1", "multirotor"},
  };
  for (const Mistake& mistake : mistakes) {
    SCOPED_TRACE(mistake.name);
    const std::string text = Replaced(Text(mistake.vehicle), mistake.from, mistake.to);
    const auto read = ParseVehicle(text, "mine.toml");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::kInvalid);
    const std::string& said = read.error().message;
    const int line = LineOf(text, mistake.at != nullptr ? mistake.at : mistake.to);
    EXPECT_TRUE(said.starts_with("mine.toml:" + std::to_string(line) + ": ")) << line << "\n"
                                                                              << said;
    EXPECT_NE(said.find(mistake.said), std::string::npos) << said;
  }
}

// Cut anywhere, a file is refused or whole; it never stops the program.
TEST(VehicleFile, ACutFileIsRefused) {
  for (const std::string& name : VehicleNames()) {
    const std::string text = Text(name);
    const std::size_t last_key = text.find("max_range_m");
    for (std::size_t length = 0; length < last_key; length += 37) {
      EXPECT_FALSE(ParseVehicle(text.substr(0, length), "cut.toml")) << name << " " << length;
    }
  }
}

TEST(VehicleFile, ANameOrAFile) {
  const auto unknown = LoadVehicle("zeppelin");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::kUsage);
  EXPECT_EQ(unknown.error().message,
            "there is no vehicle \"zeppelin\"; name a file, or one of multirotor, r50");
  const std::filesystem::path folder = OwnPath();
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / "mine.toml";
  std::ofstream(file) << Replaced(Text(), "Yamaha R-50\"", "My own\"");
  const auto mine = LoadVehicle(file.string());
  ASSERT_TRUE(mine) << mine.error().message;
  EXPECT_EQ(mine->name, "My own");
  EXPECT_EQ(mine->origin, file.string());
  EXPECT_FALSE(LoadVehicle(folder.string()));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace palace
