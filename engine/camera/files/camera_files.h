// Camera model files of every format that PALACE reads and writes.
//
//   format            read  write  what it holds
//   JPL text          yes   yes    CAHV, CAHVOR, CAHVORE; Dimensions may be missing
//   PDS3/VICAR label  yes   -      group GEOMETRIC_CAMERA_MODEL, also inside a longer label; its
//                                  lengths (MODEL_COMPONENT_UNIT) become metres
//   Willson .cpcc     yes   yes    Tsai; millimetres
//   OpenCV YAML, XML  yes   yes    pinhole and fisheye with up to 14 coefficients, R and T if there
//   ROS camera_info   yes   yes    plumb_bob, rational_polynomial, equidistant; F is the rectified
//                                  frame of the left camera (P tells the right one's place)
//   mrcal             yes   -      PINHOLE, OPENCV4/5/8/12, CAHVOR, CAHVORE
//   EuRoC sensor.yaml yes   (yes)  pinhole with radial-tangential, equidistant or no distortion; F
//                                  is the body (T_BS)
//   Kalibr camchain   yes   -      the same lenses; F is cam0. Left cam0, right cam1 (T_cn_cnm1);
//                                  further cameras and the IMU's place (T_cam_imu) are not read
//   (yes): by EurocSensorText, as it asks for a rate
//
// The content tells the format; the name's extension counts only where content fits two. Everything
// is read by our own bounded parsers (keyed_text.h). Errors name file, line, key, value and limit.
// A file cut short is refused or, where only comments and optional lines are lost, reads as the
// same camera; OpenCV YAML of other writers has no end mark and may lose R and T that stand last.
// A size that a file does not tell is 0. Lengths stay in the file's unit (CameraModel::unit_m).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/camera/camera_model.h"
#include "engine/core/result.h"

namespace palace {

enum class CameraFormat {
  kJplText,
  kPdsLabel,
  kWillson,
  kOpenCvYaml,
  kOpenCvXml,
  kRosYaml,
  kMrcal,
  kEurocSensor,
  kKalibrChain
};

/// "JPL text", "PDS label", ...
const char* CameraFormatName(CameraFormat format);

enum class StereoSide { kLeft, kRight };

struct CameraFileOptions {
  std::optional<StereoSide> side;  ///< which camera of a file of two (OpenCV, Kalibr)
  PictureSize size;                ///< for files that do not tell; refused if the file contradicts
};

/// Format of the content. Refuses text of no known format.
Result<CameraFormat> CameraFormatOf(std::string_view text, const std::string& name);
/// Parses text of any format. `name` is the file's, for errors and as tie-breaker.
Result<CameraModel> ParseCameraText(std::string_view text, const std::string& name,
                                    const CameraFileOptions& options = {});
/// Reads a file of at most 16 MiB.
Result<CameraModel> ReadCameraFile(const std::filesystem::path& path,
                                   const CameraFileOptions& options = {});
/// Refuses to write `out` where it is one of the files that are read, by whatever name.
Status CheckNoInput(const std::filesystem::path& out,
                    const std::vector<std::filesystem::path>& inputs);
/// The text of a file; numbers with 17 digits, so that reading gives the same camera to the bit.
/// Refuses formats that cannot hold the model's family, and those that are only read.
Result<std::string> CameraToText(const CameraModel& model, CameraFormat format);

/// EuRoC's sensor.yaml of a camera whose frame F is the body, in metres. Refuses what those lenses
/// do not hold exactly: more than k1 k2 p1 p2, other families, an unknown size.
Result<std::string> EurocSensorText(const CameraModel& camera, double rate_hz,
                                    const std::string& comment);

/// JPL text that must be CAHV or CAHVOR with Dimensions, as rigs and calibration use it.
Result<CahvorModel> ParseCahvorText(std::string_view text, const std::string& name);
std::string CahvorToText(const CahvorModel& model);

}  // namespace palace
