#include "engine/tools/camera_command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "engine/camera/alignment.h"
#include "engine/camera/cahvor.h"
#include "engine/camera/camera_files.h"
#include "engine/camera/camera_pair.h"
#include "engine/camera/conversion.h"
#include "engine/tools/camera_info.h"
#include "engine/tools/camera_points.h"

namespace palace {
namespace {

struct CameraOptions {
  std::string model;
  std::string side;  ///< "left", "right" or empty
  std::string size;  ///< "640x480" or empty
  std::string in;    ///< points or pixels
  std::string out;
  std::string to;
  std::string left;
  std::string right;
  std::string form = "auto";
  std::string field = "inside";
  double baseline_m = 0;
};

int Fail(const Error& error) {
  std::cerr << "palacectl: " << error.message << "\n";
  return error.code == ErrorCode::kUsage ? 2 : 1;
}

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

Result<CameraModel> ReadModel(const std::string& path, const CameraOptions& options,
                              std::optional<StereoSide> side = std::nullopt) {
  auto file = FileOptions(options);
  if (!file) {
    return file.error();
  }
  if (side && options.side.empty()) {
    file->side = side;
  }
  return ReadCameraFile(path, *file);
}

Status WriteText(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  return file ? Ok()
              : Status(UnavailableError("cannot write " + path +
                                        "; choose a place you may write to and that has room"));
}

using PointFunction = Result<std::string> (*)(const CameraModel&, std::istream&,
                                              const std::string&);

int RunPoints(const CameraOptions& options, PointFunction function) {
  const auto model = ReadModel(options.model, options);
  if (!model) {
    return Fail(model.error());
  }
  std::ifstream file;
  if (options.in != "-") {
    std::error_code none;
    if (std::filesystem::is_regular_file(options.in, none)) {
      file.open(options.in);
    }
    if (!file.is_open()) {
      return Fail(UnavailableError(options.in + ": no such file; check the name, '-' is stdin"));
    }
  }
  const auto text = function(*model, options.in == "-" ? std::cin : file,
                             options.in == "-" ? "stdin" : options.in);
  if (!text) {
    return Fail(text.error());
  }
  if (options.out.empty()) {
    std::cout << *text;
    return 0;
  }
  const Status written = WriteText(options.out, *text);
  return written ? 0 : Fail(written.error());
}

int RunInfo(const CameraOptions& options) {
  const auto model = ReadModel(options.model, options);
  if (!model) {
    return Fail(model.error());
  }
  std::cout << "file              " << options.model << "\n" << CameraInfoText(*model);
  return 0;
}

/// What --to names: a family, and the container of the file.
struct ConversionGoal {
  LensFamily family = LensFamily::kCahvor;
  CameraFormat format = CameraFormat::kJplText;
};

Result<ConversionGoal> GoalOf(const CameraOptions& options) {
  std::string name = options.to;
  std::string extension = std::filesystem::path(options.out).extension().string();
  if (name.empty()) {
    name = extension == ".yml" || extension == ".yaml" || extension == ".xml" ? "opencv5"
           : extension.size() > 1                                             ? extension.substr(1)
                                                                              : "";
  }
  ConversionGoal goal;
  const bool ros = name.substr(0, 3) == "ros";
  name = name == "cpcc" ? "tsai" : name == "opencv" || name == "ros" ? "opencv5" : name;
  name = name == "ros8" ? "opencv8" : name == "ros_fisheye" ? "fisheye" : name;
  const auto family = LensFamilyFromName(name);
  if (!family) {
    return UsageError("--to " + (options.to.empty() ? "(from the name of --out)" : options.to) +
                      ": choose cahv, cahvor, cahvore, tsai, pinhole, opencv4, opencv5, opencv8, "
                      "opencv12, fisheye, ros, ros8 or ros_fisheye");
  }
  goal.family = *family;
  if (goal.family == LensFamily::kTsai) {
    goal.format = CameraFormat::kWillson;
  } else if (goal.family > LensFamily::kTsai) {
    goal.format = ros                   ? CameraFormat::kRosYaml
                  : extension == ".xml" ? CameraFormat::kOpenCvXml
                                        : CameraFormat::kOpenCvYaml;
  }
  return goal;
}

void PrintResidual(const ConvertedCamera& converted, LensFamily family, const CameraModel& source) {
  const Residual& r = converted.residual;
  std::printf("residual  rms %.6g px, max %.6g px at pixel (%.1f, %.1f), over %d pixels\n",
              r.rms_px, r.max_px, r.worst_pixel.x(), r.worst_pixel.y(), r.pixels);
  if (family == LensFamily::kCahv && r.max_px > 1e-6) {
    std::printf(
        "          a CAHV camera has no distortion: pictures must be resampled, the residual "
        "is how far pixels move\n");
  }
  if (r.without_ray > 0) {
    std::printf("warning   %d pixels of the grid have no ray in the source model; left out\n",
                r.without_ray);
  }
  if (r.unseen > 0) {
    std::printf("warning   %d rays are beyond the range of the new model; left out\n", r.unseen);
  }
  if (std::abs(converted.lost_shear_px) > 1e-9) {
    std::printf(
        "lost      row shear of %.6g px: the new family has perpendicular rows and columns\n",
        converted.lost_shear_px);
  }
  if (converted.lost_pupil_m > 0) {
    std::printf(
        "lost      motion of the entrance pupil, up to %.3g m: the residual holds for far "
        "points\n",
        converted.lost_pupil_m);
  }
  if (source.unit_m != 1 || family == LensFamily::kTsai) {
    std::printf("lengths   %s in the source, %s in the new file\n", source.unit_m == 1 ? "m" : "mm",
                family == LensFamily::kTsai ? "mm" : "m");
  }
}

int RunConvert(const CameraOptions& options) {
  const auto goal = GoalOf(options);
  if (!goal) {
    return Fail(goal.error());
  }
  const auto model = ReadModel(options.model, options);
  if (!model) {
    return Fail(model.error());
  }
  const auto converted = ConvertCamera(*model, goal->family);
  if (!converted) {
    return Fail({converted.error().code, options.model + ": " + converted.error().message});
  }
  const auto text = CameraToText(converted->model, goal->format);
  if (!text) {
    return Fail(text.error());
  }
  if (const Status written = WriteText(options.out, *text); !written) {
    return Fail(written.error());
  }
  std::printf("from      %s: %s\nto        %s: %s, %s\n", options.model.c_str(),
              FamilyOf(*model).c_str(), options.out.c_str(), FamilyOf(converted->model).c_str(),
              CameraFormatName(goal->format));
  PrintResidual(*converted, goal->family, *model);
  return 0;
}

/// Greatest difference of rows over points in front of both cameras, 2 to 200 baselines away.
double WorstRowError(const AlignedPair& pair) {
  const double baseline = (pair.right.C - pair.left.C).norm();
  double worst = 0;
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 20; ++j) {
      const auto ray = RayFromPixelCahvor(
          pair.left, {i * (pair.left.width - 1) / 20.0, j * (pair.left.height - 1) / 20.0});
      for (const double range : {2.0, 20.0, 200.0}) {
        const Eigen::Vector3d p = ray->origin + range * baseline * ray->direction;
        const auto a = ProjectCahvor(pair.left, p);
        const auto b = ProjectCahvor(pair.right, p);
        if (a && b) {
          worst = std::max(worst, std::abs(a->y() - b->y()));
        }
      }
    }
  }
  return worst;
}

bool IsCahv(const CameraModel& model) {
  const auto* cahvor = std::get_if<CahvorModel>(&model.lens);
  return cahvor != nullptr && IsLinear(*cahvor);
}

int RunAlign(const CameraOptions& options) {
  const auto left = ReadModel(options.left, options, StereoSide::kLeft);
  if (!left) {
    return Fail(left.error());
  }
  const auto right = ReadModel(options.right, options, StereoSide::kRight);
  if (!right) {
    return Fail(right.error());
  }
  const auto placed = PlacePair(
      *left, *right, options.baseline_m > 0 ? std::optional(options.baseline_m) : std::nullopt,
      options.left, options.right);
  if (!placed) {
    return Fail(placed.error());
  }
  AlignmentOptions alignment;
  const bool average =
      options.form == "average" || (options.form == "auto" && IsCahv(*left) && IsCahv(*right));
  alignment.form = average                   ? AlignmentForm::kAverage
                   : options.form == "older" ? AlignmentForm::kColumns
                                             : AlignmentForm::kNormals;
  alignment.field = options.field == "covering" ? FieldOfView::kCovering : FieldOfView::kInside;
  const auto pair = AlignPair(placed->left, placed->right, alignment);
  if (!pair) {
    return Fail(
        {pair.error().code, options.left + ", " + options.right + ": " + pair.error().message});
  }
  std::error_code error;
  std::filesystem::create_directories(options.out, error);
  const std::filesystem::path folder = options.out;
  for (const auto& [name, model] :
       {std::pair{"left.cahv", &pair->left}, {"right.cahv", &pair->right}}) {
    if (const Status written = WriteText((folder / name).string(), CahvorToText(*model));
        !written) {
      return Fail(written.error());
    }
  }
  const CahvInternals internals = InternalsOf(pair->left);
  const double baseline_m = (pair->right.C - pair->left.C).norm();
  std::printf("form          %s\n", average ? "mean scale and centre (CAHV)"
                                    : alignment.form == AlignmentForm::kColumns
                                        ? "older: mean of the columns"
                                        : "newer: mean of the axes");
  std::printf("focal length  hs %.9f px, vs %.9f px\n", internals.hs_px, internals.vs_px);
  std::printf("image centre  hc %.9f px, vc %.9f px\n", internals.hc_px, internals.vc_px);
  std::printf("baseline      %.9f m (disparity x depth = %.6f px m)\n", baseline_m,
              internals.hs_px * baseline_m);
  std::printf("row error     max %.3g px over 1323 points 2 to 200 baselines away\n",
              WorstRowError(*pair));
  std::printf("written       %s, %s\n", (folder / "left.cahv").string().c_str(),
              (folder / "right.cahv").string().c_str());
  return 0;
}

void AddFileOptions(CLI::App& verb, CameraOptions& options) {
  verb.add_option("--camera", options.side, "Which camera of a file that holds two: left or right")
      ->check(CLI::IsMember({"left", "right"}));
  verb.add_option("--size", options.size,
                  "Picture size, e.g. 640x480, for files that do not tell it");
}

}  // namespace

void AddCameraCommand(CLI::App& app, int& exit_code) {
  CLI::App* camera = app.add_subcommand(
      "camera", "Camera model files: project, backproject, convert, info, align");
  camera->require_subcommand(1);
  camera->footer(
      "Model files: JPL .cahv/.cahvor/.cahvore, PDS labels, Willson .cpcc, OpenCV YAML and XML, "
      "ROS\n"
      "camera_info, mrcal .cameramodel; the content tells which. Points are in the frame and unit "
      "of\n"
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
                   "auto: average for two CAHV files, else newer")
      ->check(CLI::IsMember({"auto", "newer", "older", "average"}))
      ->capture_default_str();
  align
      ->add_option(
          "--field", options->field,
          "inside: every pixel has a source (minfov 1); covering: every source pixel keeps "
          "a place (minfov 0)")
      ->check(CLI::IsMember({"inside", "covering"}))
      ->capture_default_str();
  align
      ->add_option("--baseline", options->baseline_m,
                   "Metres between the cameras, for files without a pose")
      ->check(CLI::PositiveNumber);
  align->add_option("--size", options->size,
                    "Size of both pictures, for files that do not tell it");
  project->callback([=, &exit_code] { exit_code = RunPoints(*options, ProjectPoints); });
  backproject->callback([=, &exit_code] { exit_code = RunPoints(*options, BackProjectPixels); });
  convert->callback([=, &exit_code] { exit_code = RunConvert(*options); });
  info->callback([=, &exit_code] { exit_code = RunInfo(*options); });
  align->callback([=, &exit_code] { exit_code = RunAlign(*options); });
}

}  // namespace palace
