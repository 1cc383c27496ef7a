// Bad input: one message that names the thing and the remedy, exit 1 or 2, nothing left behind.
#include "tests/scenarios/bad_input.h"

#include <sstream>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "engine/simulation/vehicle_file.h"

namespace palace {
namespace {

constexpr double kLimit_s = 30;

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

}  // namespace

BadInputs::BadInputs() {
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

void BadInputs::WriteCameras(const std::string& name, const std::string& left,
                             const std::string& right) {
  WriteFile("cameras_" + name + ".toml",
            Rig() + "[capture]\nleft = " + left + "\nright = " + right + "\n");
}

void BadInputs::WriteRig(const std::string& name, const std::string& from, const std::string& to) {
  std::string text = Rig();
  text.replace(text.find(from), from.size(), to);
  WriteFile(name + ".toml", text);
}

std::set<std::string> BadInputs::Files() const {
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
    files.insert(std::filesystem::relative(entry.path(), folder_).string());
  }
  return files;
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

}  // namespace palace
