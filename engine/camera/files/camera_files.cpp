#include "engine/camera/files/camera_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "engine/camera/cahvor.h"
#include "engine/camera/files/camera_file_formats.h"
#include "engine/core/files.h"

namespace palace {
namespace {

constexpr std::size_t kSizeLimit = 16 << 20;

bool Contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// True when the file is nothing but numbers, one a line or a few, and comments.
bool IsNumbers(std::string_view text) {
  const KeyedText numbers = ParseNumberLines(text, "");
  return numbers.Has("9") && numbers.Number("1").ok() && numbers.Number("5").ok() &&
         numbers.Number("9").ok();
}

std::string Extension(const std::string& name) {
  std::string extension = std::filesystem::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

Status ApplySize(CameraModel& model, const PictureSize& size, const std::string& name) {
  if (size.width == 0 && size.height == 0) {
    return Ok();
  }
  const int width = WidthOf(model);
  const int height = HeightOf(model);
  if ((width != 0 && width != size.width) || (height != 0 && height != size.height)) {
    return InvalidError(name + ": the file tells a size of " + std::to_string(width) + " x " +
                        std::to_string(height) + " px (0: not told), the size asked for is " +
                        std::to_string(size.width) + " x " + std::to_string(size.height) +
                        "; leave it out or correct it");
  }
  SetSize(model, size.width, size.height);
  return Ok();
}

KeyedText KeyedAs(CameraFormat format, std::string_view text, const std::string& name) {
  switch (format) {
    case CameraFormat::kJplText:
      return ParseAssignments(text, name);
    case CameraFormat::kPdsLabel:
      return ParseLabel(text, name);
    case CameraFormat::kWillson:
      return ParseNumberLines(text, name);
    case CameraFormat::kOpenCvXml:
      return ParseXml(text, name);
    case CameraFormat::kMrcal:
      return ParsePythonDict(text, name);
    case CameraFormat::kOpenCvYaml:
    case CameraFormat::kRosYaml:
    case CameraFormat::kEurocSensor:
    case CameraFormat::kKalibrChain:
      break;
  }
  return ParseYaml(text, name);
}

Result<CameraModel> ParseAs(CameraFormat format, std::string_view text, const std::string& name,
                            const CameraFileOptions& options) {
  const KeyedText keyed = KeyedAs(format, text, name);
  if (Status whole = keyed.Whole(); !whole) {
    return whole.error();
  }
  switch (format) {
    case CameraFormat::kJplText:
      return ReadJplText(keyed);
    case CameraFormat::kPdsLabel:
      return ReadPdsLabel(keyed);
    case CameraFormat::kWillson:
      return ReadWillson(keyed);
    case CameraFormat::kRosYaml:
      return ReadRos(keyed);
    case CameraFormat::kMrcal:
      return ReadMrcal(keyed);
    case CameraFormat::kEurocSensor:
      return ReadEurocSensor(keyed);
    case CameraFormat::kKalibrChain:
      return ReadKalibrChain(keyed, options);
    case CameraFormat::kOpenCvYaml:
    case CameraFormat::kOpenCvXml:
      break;
  }
  return ReadOpenCv(keyed, options);
}

Error CannotHold(const CameraModel& model, CameraFormat format) {
  return UsageError(std::string("a file of format ") + CameraFormatName(format) +
                    " cannot hold a " + FamilyOf(model) + " camera; convert the model first");
}

}  // namespace

const char* CameraFormatName(CameraFormat format) {
  static constexpr std::array<const char*, 9> kNames = {
      "JPL text",        "PDS label", "Willson .cpcc",     "OpenCV YAML",    "OpenCV XML",
      "ROS camera_info", "mrcal",     "EuRoC sensor.yaml", "Kalibr camchain"};
  return kNames[static_cast<std::size_t>(format)];
}

Result<CameraFormat> CameraFormatOf(std::string_view text, const std::string& name) {
  const std::string_view start = Trimmed(text.substr(0, 4096));
  if (start.substr(0, 5) == "<?xml" || Contains(start, "<opencv_storage")) {
    return CameraFormat::kOpenCvXml;
  }
  if (Contains(text, "MODEL_COMPONENT_1") || Contains(text, "GEOMETRIC_CAMERA_MODEL")) {
    return CameraFormat::kPdsLabel;
  }
  if (Contains(text, "lensmodel") && Contains(text, "{")) {
    return CameraFormat::kMrcal;
  }
  const KeyedText assignments = ParseAssignments(text, name);
  const bool is_jpl = (assignments.Has("Model") && assignments.Has("C")) ||
                      (assignments.Has("C") && assignments.Has("A") && assignments.Has("H")) ||
                      assignments.Word("Model").substr(0, 4) == "CAHV";
  const std::string extension = Extension(name);
  if (is_jpl) {
    return CameraFormat::kJplText;
  }
  const KeyedText yaml = ParseYaml(text, name);
  if (yaml.Has("cam0") || yaml.Has("cam1")) {
    return CameraFormat::kKalibrChain;
  }
  if (yaml.Has("T_BS") || yaml.Has("sensor_type")) {
    return CameraFormat::kEurocSensor;
  }
  if (start.substr(0, 5) == "%YAML" || Contains(text, "!!opencv-matrix")) {
    return CameraFormat::kOpenCvYaml;
  }
  if (yaml.Has("distortion_model") || yaml.Has("projection_matrix.data") || yaml.Has("P")) {
    return CameraFormat::kRosYaml;
  }
  for (const char* key : {"camera_matrix", "cameraMatrix", "M1"}) {
    if (yaml.Has(key) || yaml.Has(std::string(key) + ".data")) {
      return CameraFormat::kOpenCvYaml;
    }
  }
  if (IsNumbers(text)) {
    return CameraFormat::kWillson;
  }
  // What is too damaged to tell by itself is read as what its name promises, for the better
  // message.
  if (extension == ".cahv" || extension == ".cahvor" || extension == ".cahvore" ||
      extension == ".mod") {
    return CameraFormat::kJplText;
  }
  if (extension == ".cpcc") {
    return CameraFormat::kWillson;
  }
  return InvalidError(name +
                      ": no camera model that PALACE reads: JPL .cahv/.cahvor/.cahvore, PDS label "
                      "with GEOMETRIC_CAMERA_MODEL, Willson .cpcc, OpenCV YAML or XML, ROS "
                      "camera_info, mrcal .cameramodel, EuRoC sensor.yaml, Kalibr camchain.yaml");
}

Result<CameraModel> ParseCameraText(std::string_view text, const std::string& name,
                                    const CameraFileOptions& options) {
  if (text.size() > kSizeLimit) {
    return InvalidError(name + ": larger than 16 MiB; is it a camera model?");
  }
  if (text.substr(0, 3) == "\xEF\xBB\xBF") {
    text.remove_prefix(3);  // the byte order mark that some editors write
  }
  const auto format = CameraFormatOf(text, name);
  if (!format) {
    return format.error();
  }
  auto model = ParseAs(*format, text, name, options);
  if (!model) {
    return model.error();
  }
  if (Status status = ApplySize(*model, options.size, name); !status) {
    return status.error();
  }
  return model;
}

Result<CameraModel> ReadCameraFile(const std::filesystem::path& path,
                                   const CameraFileOptions& options) {
  const auto text = ReadTextFile(path, kSizeLimit);
  if (!text) {
    return text.error();
  }
  return ParseCameraText(*text, path.string(), options);
}

Status CheckNoInput(const std::filesystem::path& out,
                    const std::vector<std::filesystem::path>& inputs) {
  for (const std::filesystem::path& input : inputs) {
    std::error_code none;  // a file that is not there is no input
    if (std::filesystem::equivalent(out, input, none)) {
      return UsageError("--out: " + out.string() + " would overwrite " + input.string() +
                        ", which is read; choose another place");
    }
  }
  return Ok();
}

Result<std::string> CameraToText(const CameraModel& model, CameraFormat format) {
  switch (format) {
    case CameraFormat::kJplText:
      if (const auto* cahvore = std::get_if<CahvoreModel>(&model.lens)) {
        return JplToText(cahvore->base, cahvore);
      }
      if (const auto* cahvor = std::get_if<CahvorModel>(&model.lens)) {
        return JplToText(*cahvor, nullptr);
      }
      break;
    case CameraFormat::kWillson:
      if (std::holds_alternative<TsaiModel>(model.lens)) {
        return WillsonToText(model);
      }
      break;
    case CameraFormat::kOpenCvYaml:
    case CameraFormat::kOpenCvXml:
    case CameraFormat::kRosYaml:
      if (std::holds_alternative<OpenCvModel>(model.lens)) {
        return format == CameraFormat::kRosYaml      ? RosToYaml(model)
               : format == CameraFormat::kOpenCvYaml ? OpenCvToYaml(model)
                                                     : OpenCvToXml(model);
      }
      break;
    case CameraFormat::kPdsLabel:
    case CameraFormat::kMrcal:
    case CameraFormat::kEurocSensor:
    case CameraFormat::kKalibrChain:
      return UsageError(std::string("files of format ") + CameraFormatName(format) +
                        " are read, not written");
  }
  return CannotHold(model, format);
}

Result<CahvorModel> ParseCahvorText(std::string_view text, const std::string& name) {
  if (text.size() > kSizeLimit) {
    return InvalidError(name + ": larger than 16 MiB; is it a camera model?");
  }
  const auto model = ReadJplText(ParseAssignments(text, name));
  if (!model) {
    return model.error();
  }
  const auto* cahvor = std::get_if<CahvorModel>(&model->lens);
  if (cahvor == nullptr) {
    return InvalidError(name + ": a " + FamilyOf(*model) +
                        " model where CAHV or CAHVOR is needed; convert it with palacectl camera "
                        "convert");
  }
  if (!HasSize(*model)) {
    return InvalidError(name + ": Dimensions is missing; add the line Dimensions = columns rows");
  }
  return *cahvor;
}

std::string CahvorToText(const CahvorModel& model) { return JplToText(model, nullptr); }

Result<PictureSize> ReadSize(const KeyedText& text, const std::string& width_key,
                             const std::string& height_key) {
  if (!text.Has(width_key) && !text.Has(height_key)) {
    return PictureSize{};
  }
  const auto width = text.Count(width_key, 1, kLargestSide_px);
  if (!width) {
    return width.error();
  }
  const auto height = text.Count(height_key, 1, kLargestSide_px);
  if (!height) {
    return height.error();
  }
  return PictureSize{*width, *height};
}

Result<PictureSize> ReadSides(const KeyedText& text, const std::string& key) {
  const auto sides = text.Numbers(key, 2, 2);
  if (!sides) {
    return sides.error();
  }
  for (const double side : *sides) {
    if (!(side >= 1 && side <= kLargestSide_px) || side != std::floor(side)) {
      return text.Wrong(key, "sides must be whole numbers from 1 to 65536 px");
    }
  }
  return PictureSize{static_cast<int>((*sides)[0]), static_cast<int>((*sides)[1])};
}

std::string Exact(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.17g", value);
  return text.data();
}

std::string Exact(const double* values, std::size_t count, const char* separator) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += (i == 0 ? "" : separator) + Exact(values[i]);
  }
  return text;
}

}  // namespace palace
