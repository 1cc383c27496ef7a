// One reader and writer a format behind camera_files.h.
#pragma once

#include "engine/camera/files/camera_files.h"
#include "engine/camera/files/keyed_text.h"

namespace palace {

Result<CameraModel> ReadJplText(const KeyedText& text);
std::string JplToText(const CahvorModel& base, const CahvoreModel* cahvore);
Result<CameraModel> ReadPdsLabel(const KeyedText& text);
Result<CameraModel> ReadWillson(const KeyedText& text);
/// Lengths are converted to millimetres.
std::string WillsonToText(const CameraModel& model);
Result<CameraModel> ReadOpenCv(const KeyedText& text, const CameraFileOptions& options);
std::string OpenCvToYaml(const CameraModel& model);
std::string OpenCvToXml(const CameraModel& model);
Result<CameraModel> ReadRos(const KeyedText& text);
std::string RosToYaml(const CameraModel& model);
Result<CameraModel> ReadMrcal(const KeyedText& text);
Result<CameraModel> ReadEurocSensor(const KeyedText& text);
Result<CameraModel> ReadKalibrChain(const KeyedText& text, const CameraFileOptions& options);

constexpr int kLargestSide_px = 65536;

/// Width and height from two keys, or 0 x 0 where the text has neither.
Result<PictureSize> ReadSize(const KeyedText& text, const std::string& width_key,
                             const std::string& height_key);
/// Width and height from one list of two whole numbers.
Result<PictureSize> ReadSides(const KeyedText& text, const std::string& key);
/// Where a file tells the internals of its camera.
struct InternalsKeys {
  std::string focal_across, focal_down, centre_across, centre_down;
  static InternalsKeys In(const std::string& key) { return {key, key, key, key}; }
};
/// The camera, its size known, unless a focal length lies outside 1 .. 1e6 px or the principal
/// point farther than ten pictures away (1e6 px where their size is unknown).
Result<CameraModel> WithInternals(const KeyedText& text, const InternalsKeys& keys,
                                  CameraModel model);
/// Makes of the numbers of `key`, which may hold few digits, the rotation they stand for. Refuses
/// what is none.
Status TakeRotation(const KeyedText& text, const std::string& key, Eigen::Matrix3d& R);
/// A number with 17 digits, which reads back to the same bits.
std::string Exact(double value);
/// Such numbers with `separator` between them.
std::string Exact(const double* values, std::size_t count, const char* separator);

}  // namespace palace
