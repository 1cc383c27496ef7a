#include "engine/tools/camera_command.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "engine/camera/camera_info.h"
#include "engine/camera/files/point_lines.h"
#include "engine/core/command_line.h"
#include "engine/tools/camera_verbs.h"

namespace palace {
namespace {

Result<CameraFileOptions> FileOptions(const CameraOptions& options) {
  CameraFileOptions file;
  if (!options.side.empty()) {
    file.side = options.side == "right" ? StereoSide::kRight : StereoSide::kLeft;
  }
  if (!options.size.empty()) {
    char rest = '\0';
    if (std::sscanf(options.size.c_str(), "%6dx%6d%c", &file.size.width, &file.size.height,
                    &rest) != 2 ||
        file.size.width < 1 || file.size.height < 1 || file.size.width > 65536 ||
        file.size.height > 65536) {
      return UsageError("--size " + options.size +
                        ": must be WIDTHxHEIGHT in whole pixels from 1 to 65536, e.g. 640x480");
    }
  }
  return file;
}

using PointFunction = Result<std::string> (*)(const CameraModel&, std::istream&,
                                              const std::string&);

int RunPoints(const CameraOptions& options, PointFunction function) {
  if (const Status apart = CheckNoInput(options.out, {options.model, options.in}); !apart) {
    return FailCamera(apart.error());
  }
  const auto model = ReadCameraModel(options.model, options);
  if (!model) {
    return FailCamera(model.error());
  }
  std::ifstream file;
  if (options.in != "-") {
    std::error_code none;
    if (std::filesystem::is_directory(options.in, none)) {
      return FailCamera(UnavailableError(options.in + ": is a folder; name a file in it"));
    }
    if (std::filesystem::exists(options.in, none)) {
      file.open(options.in);
    }
    if (!file.is_open()) {
      return FailCamera(
          UnavailableError(options.in + ": no such file; check the name, '-' is stdin"));
    }
  }
  const auto text = function(*model, options.in == "-" ? std::cin : file,
                             options.in == "-" ? "stdin" : options.in);
  if (!text) {
    return FailCamera(text.error());
  }
  if (options.out.empty()) {
    std::cout << *text;
    return 0;
  }
  const Status written = WriteCameraText(options.out, *text);
  return written ? 0 : FailCamera(written.error());
}

int RunInfo(const CameraOptions& options) {
  const auto model = ReadCameraModel(options.model, options);
  if (!model) {
    return FailCamera(model.error());
  }
  std::cout << "file              " << options.model << "\n" << CameraInfoText(*model);
  return 0;
}

void AddFileOptions(CLI::App& verb, CameraOptions& options) {
  verb.add_option("--camera", options.side, "Which camera of a file that holds two: left or right")
      ->check(CLI::IsMember({"left", "right"}));
  verb.add_option("--size", options.size,
                  "Picture size, e.g. 640x480, for files that do not tell it");
}

}  // namespace

int FailCamera(const Error& error) {
  std::cerr << "palacectl: " << error.message << "\n";
  return error.code == ErrorCode::kUsage ? 2 : 1;
}

Result<CameraModel> ReadCameraModel(const std::string& path, const CameraOptions& options,
                                    std::optional<StereoSide> side) {
  auto file = FileOptions(options);
  if (!file) {
    return file.error();
  }
  if (path == "-" || path == "/dev/stdin") {
    return UsageError(path +
                      ": a camera model is read from a file; only points and pixels may "
                      "come from stdin");
  }
  if (!options.side.empty() && ReadCameraFile(path, {std::nullopt, file->size}).ok()) {
    return UsageError("--camera " + options.side + ": " + path +
                      " holds one camera; leave --camera out");
  }
  if (side && options.side.empty()) {
    file->side = side;
  }
  return ReadCameraFile(path, *file);
}

Status WriteCameraText(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  return file ? Ok()
              : Status(UnavailableError("cannot write " + path +
                                        "; choose a place you may write to and that has room"));
}

Status WriteCameraModel(const std::string& path, const std::string& text) {
  std::error_code none;
  const bool replaces = std::filesystem::is_regular_file(path, none);
  const Status written = WriteCameraText(path, text);
  if (written && replaces) {
    std::cerr << "palacectl: warning: an earlier file " << path << " was replaced\n";
  }
  return written;
}

void AddCameraCommand(CLI::App& app, int& exit_code) {
  CLI::App* camera = app.add_subcommand(
      "camera", "Camera model files: project, backproject, convert, info, align");
  camera->require_subcommand(1);
  camera->footer(
      "Model files: JPL .cahv/.cahvor/.cahvore, PDS labels, Willson .cpcc, OpenCV YAML and XML, "
      "ROS\n"
      "camera_info, mrcal .cameramodel, EuRoC sensor.yaml and Kalibr camchain.yaml (pinhole with\n"
      "radtan, equidistant or none); the content tells which. Points are in the frame and unit of\n"
      "the file: metres, millimetres for .cpcc. Pixel (0,0) is the centre of the top-left pixel.");
  auto options = std::make_shared<CameraOptions>();
  CLI::App* project = camera->add_subcommand(
      "project", "Lines X,Y,Z to lines x,y (17 digits) or 'invalid' outside the model's range");
  project->add_option("--model", options->model, "Camera model file")->required();
  project->add_option("--points", options->in, "File of lines X,Y,Z; - reads stdin")->required();
  CLI::App* backproject = camera->add_subcommand(
      "backproject",
      "Lines x,y to lines ox,oy,oz,rx,ry,rz (ray origin, unit direction) or 'invalid'");
  backproject->add_option("--model", options->model, "Camera model file")->required();
  backproject->add_option("--pixels", options->in, "File of lines x,y; - reads stdin")->required();
  for (CLI::App* verb : {project, backproject}) {
    verb->add_option("--out", options->out, "File for the result; stdout without it");
    AddFileOptions(*verb, *options);
  }
  CLI::App* convert = camera->add_subcommand(
      "convert", "Another lens family or file format; prints the residual in pixels");
  convert->add_option("--model", options->model, "Camera model file")->required();
  convert->footer(
      "Lenses are fitted to the rays of the old model; the residual tells how well. cahv is not\n"
      "fitted: it keeps the old image plane and the field of view by JPL's rule, so that every\n"
      "pixel of the picture resampled to it has a source; the residual tells how far pixels move.");
  convert->add_option("--to", options->to,
                      "cahv, cahvor, cahvore, tsai, pinhole, opencv4, opencv5, opencv8, opencv12, "
                      "fisheye, ros, ros8, ros_fisheye; without it the extension of --out decides");
  convert->add_option("--out", options->out, "File to write (.xml: OpenCV XML)")->required();
  AddFileOptions(*convert, *options);
  CLI::App* info =
      camera->add_subcommand("info", "Family, size, focal lengths, field of view, distortion");
  info->add_option("--model", options->model, "Camera model file")->required();
  AddFileOptions(*info, *options);
  CLI::App* align = camera->add_subcommand(
      "align", "A stereo pair of CAHV models whose rows are epipolar lines (JPL's rules)");
  align->add_option("--left", options->left, "Left camera model file")->required();
  align->add_option("--right", options->right, "Right camera model file")->required();
  align->add_option("--out", options->out, "Folder for left.cahv and right.cahv")->required();
  align
      ->add_option("--form", options->form,
                   "newer (mean axis), older (mean columns), average (mean scale and centre), or "
                   "auto: average for two CAHV files, else newer. average keeps no field of view: "
                   "pixels at the border may have no source")
      ->check(CLI::IsMember({"auto", "newer", "older", "average"}))
      ->capture_default_str();
  align
      ->add_option(
          "--field", options->field,
          "inside: every pixel has a source (minfov 1); covering: every source pixel keeps "
          "a place (minfov 0); newer and older only")
      ->check(CLI::IsMember({"inside", "covering"}))
      ->capture_default_str();
  align
      ->add_option("--baseline", options->baseline_m,
                   "Metres between the cameras, for files without a pose")
      ->check(FiniteRange(0.001, 1000.0));
  align->add_option("--size", options->size,
                    "Size of both pictures, for files that do not tell it");
  const CLI::Option* field = align->get_option("--field");
  project->callback([=, &exit_code] { exit_code = RunPoints(*options, ProjectPoints); });
  backproject->callback([=, &exit_code] { exit_code = RunPoints(*options, BackProjectPixels); });
  convert->callback([=, &exit_code] { exit_code = RunCameraConvert(*options); });
  info->callback([=, &exit_code] { exit_code = RunInfo(*options); });
  align->callback([=, &exit_code] {
    options->field_is_given = field->count() > 0;
    exit_code = RunCameraAlign(*options);
  });
}

}  // namespace palace
