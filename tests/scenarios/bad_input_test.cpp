// Bad input: one message that names the thing and the remedy, exit 1 or 2, nothing left behind.
#include <algorithm>
#include <set>
#include <sstream>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "engine/simulation/vehicle_file.h"
#include "tests/scenarios/scenario.h"

namespace palace {
namespace {

constexpr double kLimit_s = 30;

struct BadInput {
  const char* name;
  bool station;  ///< palace, else palacectl
  std::vector<std::string> arguments;
  int exit_code;
  std::vector<std::string> said;  ///< parts of the one message: the thing, the remedy
  std::vector<std::pair<std::string, std::string>> environment = {};
};

void PrintTo(const BadInput& row, std::ostream* out) { *out << row.name; }

std::string Rig() {
  std::string text;
  for (const char* side : {"left", "right"}) {
    text += "[" + std::string(side) +
            "]\nwidth = 64\nheight = 48\nfx_px = 60\nfy_px = 60\ncx_px = 32\ncy_px = 24\n";
  }
  return text +
         "[rig]\nbaseline_m = 0.5\n[mount]\ntilt_deg = -90\n"
         "[pose]\nroll_deg = 0\npitch_deg = 0\nheading_deg = 0\nheight_m = 10\n"
         "[images]\nleft = \"l.png\"\nright = \"r.png\"\n";
}

/// Line 13 tells a mass that no vehicle has.
std::string HeavyVehicle() {
  std::string text(VehicleText(kDefaultVehicle));
  const std::string_view mass = "value = 68";
  return text.replace(text.find(mass), mass.size(), "value = 9e9");
}

class BadInputs : public Scenario, public testing::WithParamInterface<BadInput> {
 protected:
  BadInputs() {
    WriteFile("text.lcm", "this is no log\n");
    WriteFile("empty.lcm", "");
    WriteFile("file", "in place of a folder");
    WriteFile("bad.script", "wait seconds 1\nfly away\n");
    WriteFile("set.script", "set slad.colour 3\n");
    WriteFile("wait.script", "wait state PROPOSED soon\n");
    WriteFile("idle.script", "wait seconds 1\nquit\n");
    WriteFile("colour.toml", "[slad]\ncolour = 3\n");
    WriteFile("slope.toml", "[slad]\nmax_slope_deg = 300\n");
    std::filesystem::create_directory(folder_ / "folder");
    const cv::Mat picture(48, 64, CV_8UC1, cv::Scalar(90));
    cv::imwrite((folder_ / "l.png").string(), picture);
    cv::imwrite((folder_ / "r.png").string(), picture);
    cv::imwrite((folder_ / "large.png").string(), cv::Mat(96, 64, CV_8UC1, cv::Scalar(90)));
    const std::filesystem::path cut = folder_ / "cut.png";
    std::filesystem::copy_file(folder_ / "l.png", cut);
    std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
    WriteRig("good", "", "");
    const std::string columns = "file,time,north,east,down,roll,pitch,heading\n";
    const std::string pose = "l,0,0,0,-10,0,0,0\n";
    WriteFile("poses_stem.csv", columns + "other,0,0,0,-10,0,0,0\n");
    WriteFile("poses_few.csv", columns + pose);
    WriteFile("poses_nan.csv", columns + "l,0,0,0,nan,0,0,0\n");
    WriteFile("poses_back.csv", columns + pose + "r,-1,0,0,-10,0,0,0\n");
    WriteFile("poses_twice.csv", columns + pose + "l,1,0,0,-10,0,0,0\n");
    WriteFile("poses_column.csv", "file,time,north,east,down,roll,pitch,yaw\n" + pose);
    WriteRig("surveyed", "\"r.png\"", "\"r.png\"\nposes = \"poses_nan.csv\"");
    WriteRig("missing", "fx_px = 60\n", "");
    WriteRig("negative", "width = 64", "width = -64");
    WriteRig("nan", "baseline_m = 0.5", "baseline_m = nan");
    WriteRig("unknown", "[mount]", "[mount]\ncolour = 3");
    WriteRig("syntax", "[mount]", "[mount");
    WriteRig("size", "\"l.png\"", "\"large.png\"");
    WriteRig("both_sizes", "\"l.png\"\nright = \"r.png\"", "\"large.png\"\nright = \"large.png\"");
    WriteRig("cut", "\"l.png\"", "\"cut.png\"");
    WriteRig("none", "\"l.png\"", "\"q*.png\"");
    WriteFile("heavy.toml", HeavyVehicle());
    WriteFile("text.avi", "this is no film\n");
    WriteFile("empty.avi", "");
    WriteFile("noise.avi", std::string("\1\2\3", 3) + std::string(3000, '\7'));
    for (const char* name : {"film.avi", "film2.avi"}) {
      cv::VideoWriter writer((folder_ / name).string(), cv::CAP_FFMPEG,
                             cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10, cv::Size(32, 24));
      writer.write(cv::Mat(24, 32, CV_8UC3, cv::Scalar::all(90)));
    }
    WriteCameras("text", "\"text.avi\"", "\"film.avi\"");
    WriteCameras("empty", "\"empty.avi\"", "\"film.avi\"");
    WriteCameras("noise", "\"noise.avi\"", "\"film.avi\"");
    WriteCameras("folder", "\"folder\"", "\"film.avi\"");
    WriteCameras("no_film", "\"missing.avi\"", "\"film.avi\"");
    WriteCameras("film_size", "\"film.avi\"", "\"film2.avi\"");
    WriteCameras("no_device", "253", "254");
    WriteCameras("refused", "\"http://127.0.0.1:9/a\"", "\"http://127.0.0.1:9/b\"");
    WriteCameras("scheme", "\"ftp://127.0.0.1/a\"", "\"film.avi\"");
    WriteCameras("mixed", "253", "\"film.avi\"");
    WriteCameras("one", "253", "253");
  }
  void WriteCameras(const std::string& name, const std::string& left, const std::string& right) {
    WriteFile("cameras_" + name + ".toml",
              Rig() + "[capture]\nleft = " + left + "\nright = " + right + "\n");
  }
  void WriteRig(const std::string& name, const std::string& from, const std::string& to) {
    std::string text = Rig();
    text.replace(text.find(from), from.size(), to);
    WriteFile(name + ".toml", text);
  }
  std::set<std::string> Files() const {
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
      files.insert(std::filesystem::relative(entry.path(), folder_).string());
    }
    return files;
  }
};

/// The lines of stderr without what the graphics driver says of itself.
std::vector<std::string> Messages(const std::string& err) {
  std::vector<std::string> lines;
  std::istringstream stream(err);
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line.rfind("libEGL", 0) != 0 && line.rfind("MESA", 0) != 0) {
      lines.push_back(line);
    }
  }
  return lines;
}

TEST_P(BadInputs, AreRefusedWithOneMessageAndLeaveNothing) {
  const BadInput& row = GetParam();
  const std::set<std::string> before = Files();
  ProcessOptions options = row.station ? Palace(row.arguments) : Palacectl(row.arguments);
  options.environment = row.environment;
  const ProcessResult result = RunProcess(options, kLimit_s);
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.signal, 0);
  EXPECT_EQ(result.exit_code, row.exit_code) << result.err;
  EXPECT_EQ(result.out, "");
  const std::vector<std::string> messages = Messages(result.err);
  ASSERT_EQ(messages.size(), 1u) << result.err;
  EXPECT_EQ(messages[0].rfind(row.station ? "palace: " : "palacectl", 0), 0u) << messages[0];
  for (const std::string& part : row.said) {
    EXPECT_NE(messages[0].find(part), std::string::npos)
        << "'" << part << "' is not in: " << messages[0];
  }
  std::set<std::string> after = Files();
  after.erase("logs");  // the folder of all flights may be made, a flight in it may not
  EXPECT_EQ(after, before);
}

std::string NameOf(const testing::TestParamInfo<BadInput>& info) { return info.param.name; }

/// `palace --headless` with more words.
std::vector<std::string> H(std::vector<std::string> words) {
  words.insert(words.begin(), "--headless");
  return words;
}
/// `palacectl analyze` of a pair.
std::vector<std::string> A(const std::string& left, const std::string& right,
                           const std::string& rig, std::vector<std::string> more = {}) {
  std::vector<std::string> words = {"analyze", "--left", left,    "--right", right,
                                    "--rig",   rig,      "--out", "out"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

INSTANTIATE_TEST_SUITE_P(
    Logs, BadInputs,
    testing::Values(
        BadInput{"Missing", true, H({"--replay", "no.lcm"}), 1, {"no.lcm", "check the name"}},
        BadInput{"Text", true, H({"--replay", "text.lcm"}), 1, {"text.lcm", "choose another"}},
        BadInput{"Empty", true, H({"--replay", "empty.lcm"}), 1, {"empty.lcm", "choose another"}},
        BadInput{"Folder", true, H({"--replay", "folder"}), 1, {"folder", "name the log"}},
        BadInput{"Device", true, H({"--replay", "/dev/zero"}), 1, {"/dev/zero"}},
        BadInput{"InfoMissing", false, {"log", "info", "no.lcm"}, 1, {"no.lcm", "check the name"}},
        BadInput{"InfoText", false, {"log", "info", "text.lcm"}, 1, {"text.lcm", "another file"}},
        BadInput{"VerifyFolder", false, {"log", "verify", "folder"}, 1, {"folder", "name the log"}},
        BadInput{"ExportEmpty",
                 false,
                 {"log", "export", "empty.lcm", "--out", "out"},
                 1,
                 {"empty.lcm", "choose another"}}),
    NameOf);

INSTANTIATE_TEST_SUITE_P(
    Pictures, BadInputs,
    testing::Values(
        BadInput{"NoRig", true, H({"--images", "no.toml"}), 1, {"no.toml", "check the name"}},
        BadInput{"RigFolder", true, H({"--images", "folder"}), 1, {"folder", "is a folder"}},
        BadInput{"MissingKey",
                 true,
                 H({"--images", "missing.toml"}),
                 1,
                 {"missing.toml:1", "left.fx_px is missing", "add it to [left]"}},
        BadInput{"NegativeWidth",
                 true,
                 H({"--images", "negative.toml"}),
                 1,
                 {"negative.toml:2", "left.width = -64", "32 .. 8192"}},
        BadInput{"SurveyIsNaN",
                 true,
                 H({"--images", "surveyed.toml"}),
                 1,
                 {"poses_nan.csv:2", "down = nan"}},
        BadInput{"NotANumber",
                 true,
                 H({"--images", "nan.toml"}),
                 1,
                 {"nan.toml:16", "rig.baseline_m = nan", "metres"}},
        BadInput{"UnknownKey",
                 true,
                 H({"--images", "unknown.toml"}),
                 1,
                 {"unknown.toml:18", "mount.colour", "known here"}},
        BadInput{"Syntax", true, H({"--images", "syntax.toml"}), 1, {"syntax.toml:17", "expected"}},
        BadInput{"SizesDiffer",
                 true,
                 H({"--images", "size.toml"}),
                 1,
                 {"r.png", "64 x 48", "64 x 96", "same size"}},
        BadInput{"SizeOfRig",
                 true,
                 H({"--images", "both_sizes.toml"}),
                 1,
                 {"large.png", "64 x 96", "64 x 48", "correct width and height"}},
        BadInput{
            "CutShort", true, H({"--images", "cut.toml"}), 1, {"cut.png", "cut short", "again"}},
        BadInput{"NoMatch", true, H({"--images", "none.toml"}), 1, {"none.toml", "q*.png"}}),
    NameOf);

/// `palace --headless --cameras` of one of the rigs.
std::vector<std::string> C(const std::string& name) {
  return H({"--cameras", "cameras_" + name + ".toml"});
}

INSTANTIATE_TEST_SUITE_P(
    Cameras, BadInputs,
    testing::Values(
        BadInput{"NoCameraRig", true, C("nowhere"), 1, {"cameras_nowhere.toml", "check the name"}},
        BadInput{"NoCaptureTable",
                 true,
                 H({"--cameras", "good.toml"}),
                 1,
                 {"good.toml", "[capture] is missing", "left and right"}},
        BadInput{"NoFilm", true, C("no_film"), 1, {"missing.avi", "check the name"}},
        BadInput{"TextAsFilm", true, C("text"), 1, {"text.avi", "text, no video"}},
        BadInput{"EmptyFilm", true, C("empty"), 1, {"empty.avi", "is empty", "record it again"}},
        BadInput{"NoiseAsFilm", true, C("noise"), 1, {"noise.avi", "no video", "convert it"}},
        BadInput{"FolderAsFilm", true, C("folder"), 1, {"folder", "no file"}},
        BadInput{
            "SizeOfFilm", true, C("film_size"), 1, {"film.avi", "32 x 24", "64 x 48", "calibrate"}},
        BadInput{"NoCamera", true, C("no_device"), 1, {"/dev/video253", "v4l2-ctl"}},
        BadInput{"StreamRefused", true, C("refused"), 1, {"http://127.0.0.1:9/a", "network"}},
        BadInput{"SchemeOfStream", true, C("scheme"), 1, {"capture.left", "ftp://", "rtsp"}},
        BadInput{"FilmAndCamera", true, C("mixed"), 1, {"/dev/video253", "film.avi", "clocks"}},
        BadInput{"OneCameraTwice", true, C("one"), 1, {"capture.right = 253", "side_by_side"}}),
    NameOf);

INSTANTIATE_TEST_SUITE_P(
    Words, BadInputs,
    testing::Values(
        BadInput{"UnknownOption", true, {"--frobnicate"}, 2, {"--frobnicate", "palace --help"}},
        BadInput{"StrayWord", true, H({"log.lcm"}), 2, {"log.lcm", "palace --help"}},
        BadInput{"MissingValue", true, H({"--replay"}), 2, {"--replay", "palace --help"}},
        BadInput{
            "TwoSources", true, H({"--replay", "a", "--images", "b"}), 2, {"--replay", "exclude"}},
        BadInput{"CamerasAndImages",
                 true,
                 H({"--cameras", "a", "--images", "b"}),
                 2,
                 {"--cameras", "exclude"}},
        BadInput{"KeyWithoutBus", true, H({"--key", "heli-1"}), 2, {"--key", "--connect"}},
        BadInput{"EmptyUrl", true, H({"--connect", ""}), 2, {"--connect", "udpm://"}},
        BadInput{"UrlKind", true, H({"--connect", "radio://x"}), 2, {"radio://x", "udpm://"}},
        BadInput{"UrlAddress",
                 true,
                 H({"--connect", "udpm://host:7667"}),
                 2,
                 {"'host'", "multicast address", "239.255.76.67"}},
        BadInput{"UnknownScenario",
                 true,
                 H({"--scenario", "moon"}),
                 2,
                 {"moon", "runway, cones, slope, empty"}},
        BadInput{"UnknownSetting",
                 true,
                 H({"--set", "slad.colour=3"}),
                 2,
                 {"slad.colour", "slad.max_slope_deg"}},
        BadInput{
            "UnknownFault", true, H({"--fault", "gps_jmp=3"}), 2, {"gps_jmp", "palacectl faults"}},
        BadInput{"NoFaultsFile", true, H({"--faults", "no.toml"}), 2, {"--faults: no.toml"}},
        BadInput{"FaultOfALiveVehicle",
                 true,
                 H({"--connect", "memq://", "--fault", "gps_jump=3"}),
                 2,
                 {"--fault", "--connect", "built-in simulation"}},
        BadInput{"UnknownGroup", true, H({"--set", "x.y=3"}), 2, {"x.y", "slad."}},
        BadInput{"SettingRange",
                 true,
                 H({"--set", "slad.max_slope_deg=300"}),
                 2,
                 {"slad.max_slope_deg = 300", "0.5 to 45"}},
        BadInput{"SettingNoNumber",
                 true,
                 H({"--set", "slad.max_slope_deg=steep"}),
                 2,
                 {"steep", "number"}},
        BadInput{"NoSettingsFile", true, H({"--settings", "no.toml"}), 2, {"no.toml", "path"}},
        BadInput{"SettingsUnknownKey",
                 true,
                 H({"--settings", "colour.toml"}),
                 2,
                 {"colour.toml:2", "slad.colour"}},
        BadInput{"SettingsRange",
                 true,
                 H({"--settings", "slope.toml"}),
                 2,
                 {"slope.toml:2", "max_slope_deg", "45"}},
        BadInput{"ReplayAndScenario",
                 true,
                 H({"--replay", "x.lcm", "--scenario", "runway"}),
                 2,
                 {"--scenario", "leave it out", "--replay"}},
        BadInput{"BusAndWind",
                 true,
                 H({"--connect", "memq://", "--wind", "3"}),
                 2,
                 {"--wind", "--connect"}},
        BadInput{"ChannelsOfASimulation",
                 true,
                 H({"--channels", "x.toml"}),
                 2,
                 {"--channels", "--connect", "--replay"}},
        BadInput{"NoScript", true, H({"--script", "no.script"}), 2, {"no.script", "check"}},
        BadInput{"ScriptFolder", true, H({"--script", "folder"}), 2, {"folder"}},
        BadInput{"ScriptLine", true, H({"--script", "bad.script"}), 2, {"bad.script:2", "'fly'"}},
        BadInput{"ScriptSetting",
                 true,
                 H({"--script", "set.script"}),
                 2,
                 {"set.script:1", "slad.colour"}},
        BadInput{
            "ScriptNumber", true, H({"--script", "wait.script"}), 2, {"wait.script:1", "'soon'"}}),
    NameOf);

INSTANTIATE_TEST_SUITE_P(
    Places, BadInputs,
    testing::Values(
        BadInput{"RecordInProc", true, H({"--record", "/proc/x"}), 1, {"/proc/x", "--record DIR"}},
        BadInput{"RecordInFile", true, H({"--record", "file"}), 1, {"file", "--record DIR"}},
        BadInput{"NoOpenGl",
                 true,
                 H({"--script", "idle.script"}),
                 1,
                 {"no OpenGL", "libgl1-mesa-dri"},
                 {{"__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent"}}},
        BadInput{"NoDriver",
                 true,
                 H({"--script", "idle.script"}),
                 1,
                 {"no OpenGL", "libgl1-mesa-dri"},
                 {{"__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent"}}},
        BadInput{"NoVehicle", true, H({"--vehicle", "heavy.toml"}), 1, {"heavy.toml:13:"}},
        BadInput{"VehicleOfARecord",
                 true,
                 {"--replay", "empty.lcm", "--vehicle", "r50"},
                 2,
                 {"--vehicle", "--replay"}},
        BadInput{"NoDisplay", true, {"--script", "idle.script"}, 1, {"DISPLAY", "--headless"}},
        BadInput{"SimulateNoOpenGl",
                 false,
                 {"simulate", "--log", "x.lcm", "--duration-s", "1", "--fast"},
                 1,
                 {"no OpenGL", "libgl1-mesa-dri"},
                 {{"__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent"}}}),
    NameOf);

INSTANTIATE_TEST_SUITE_P(
    Analyze, BadInputs,
    testing::Values(
        BadInput{"NoCommand", false, {}, 2, {"subcommand", "--help"}},
        BadInput{"UnknownCommand", false, {"fly"}, 2, {"'fly'", "simulate, analyze"}},
        BadInput{"NoVehicle",
                 false,
                 {"vehicle", "zeppelin"},
                 2,
                 {"zeppelin", "name a file, or one of multirotor, r50"}},
        BadInput{"HeavyVehicle",
                 false,
                 {"simulate", "--log", "x.lcm", "--vehicle", "heavy.toml"},
                 1,
                 {"heavy.toml:13: mass_kg.value = 9000000000 is outside 0.1 .. 2000"}},
        BadInput{"VehicleOfAnExperiment",
                 false,
                 {"evaluate", "landing", "--trials", "1", "--vehicle", "zeppelin"},
                 2,
                 {"zeppelin", "multirotor, r50"}},
        BadInput{"KeyOfALog",
                 false,
                 {"simulate", "--log", "out", "--key", "heli-1"},
                 2,
                 {"--key", "--url"}},
        BadInput{"NoOut", false, {"analyze", "--left", "l.png"}, 2, {"--out", "--help"}},
        BadInput{"NoInput", false, {"analyze", "--out", "out"}, 2, {"--elevation", "--points"}},
        BadInput{"NoRight",
                 false,
                 {"analyze", "--left", "l.png", "--rig", "good.toml", "--out", "out"},
                 2,
                 {"--right", "--rig"}},
        BadInput{"TwoInputs",
                 false,
                 A("l.png", "r.png", "good.toml", {"--points", "p.xyz"}),
                 2,
                 {"--points", "one input"}},
        BadInput{"RigAndPictureSwapped", false, A("l.png", "good.toml", "r.png"), 1, {"r.png"}},
        BadInput{"NoPicture", false, A("no.png", "r.png", "good.toml"), 1, {"no.png", "check"}},
        BadInput{"PictureCut", false, A("l.png", "cut.png", "good.toml"), 1, {"cut.png", "again"}},
        BadInput{"PictureSize",
                 false,
                 A("l.png", "large.png", "good.toml"),
                 1,
                 {"large.png", "64 x 96"}},
        BadInput{"RigKey", false, A("l.png", "r.png", "missing.toml"), 1, {"missing.toml:1"}},
        BadInput{"Setting",
                 false,
                 A("l.png", "r.png", "good.toml", {"--set", "slad.x=1"}),
                 2,
                 {"slad.x", "slad.max_slope_deg"}},
        BadInput{"PosesWithoutThePicture",
                 false,
                 A("l.png", "r.png", "good.toml", {"--poses", "poses_stem.csv"}),
                 1,
                 {"poses_stem.csv:2", "file = l", "1 rows"}},
        BadInput{"FewerPosesThanPairs",
                 false,
                 A("?.png", "?.png", "good.toml", {"--poses", "poses_few.csv"}),
                 1,
                 {"poses_few.csv:2", "file = r", "1 of 2 left pictures"}},
        BadInput{"PairsWithoutPoses",
                 false,
                 A("?.png", "?.png", "good.toml"),
                 2,
                 {"2 left pictures", "--poses POSES.csv"}},
        BadInput{"PoseIsNaN",
                 false,
                 A("l.png", "r.png", "good.toml", {"--poses", "poses_nan.csv"}),
                 1,
                 {"poses_nan.csv:2", "down = nan", "-100000 .. 100000"}},
        BadInput{"PoseOfTheRigIsNaN",
                 false,
                 A("l.png", "r.png", "surveyed.toml"),
                 1,
                 {"poses_nan.csv:2", "down = nan"}},
        BadInput{"TimesGoBack",
                 false,
                 A("l.png", "r.png", "good.toml", {"--poses", "poses_back.csv"}),
                 1,
                 {"poses_back.csv:3", "time = -1", "the 0 of line 2"}},
        BadInput{"StemTwice",
                 false,
                 A("l.png", "r.png", "good.toml", {"--poses", "poses_twice.csv"}),
                 1,
                 {"poses_twice.csv:3", "file = l", "line 2"}},
        BadInput{"PosesColumn",
                 false,
                 A("l.png", "r.png", "good.toml", {"--poses", "poses_column.csv"}),
                 1,
                 {"poses_column.csv:1", "'yaw'", "heading"}},
        BadInput{"NoPoses",
                 false,
                 A("l.png", "r.png", "good.toml", {"--poses", "no.csv"}),
                 1,
                 {"no.csv"}},
        BadInput{"PosesOfAModel",
                 false,
                 {"analyze", "--elevation", "dem.tif", "--poses", "p.csv", "--out", "out"},
                 2,
                 {"--poses", "--left"}},
        BadInput{"OutIsAFile",
                 false,
                 {"analyze", "--left", "l.png", "--right", "r.png", "--rig", "good.toml", "--out",
                  "file"},
                 1,
                 {"file", "--out"}},
        BadInput{"NoElevation",
                 false,
                 {"analyze", "--elevation", "no.tif", "--out", "out"},
                 1,
                 {"no.tif", "exist"}},
        BadInput{"ElevationIsText",
                 false,
                 {"analyze", "--elevation", "file", "--out", "out"},
                 1,
                 {"file", "TIFF"}},
        BadInput{"PointsAreText",
                 false,
                 {"analyze", "--points", "good.toml", "--out", "out"},
                 1,
                 {"good.toml"}}),
    NameOf);

}  // namespace
}  // namespace palace
