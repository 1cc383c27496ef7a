#define TOML_EXCEPTIONS 0
// toml++ 3.3 asserts that a table header starts with a key ("[?]" in a damaged file aborts), but
// reports the same as an error two lines later. Files are input: never abort on them.
#define TOML_ASSERT(expr) static_assert(true)
#include "engine/camera/rig_file.h"

#include <cmath>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include <toml++/toml.h>

#include "engine/camera/cahvor.h"
#include "engine/camera/camera_files.h"
#include "engine/camera/camera_pair.h"
#include "engine/camera/text_file.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kLargestSide_px = 16384;
constexpr double kLargest = 1e6;
constexpr std::int64_t kLargestDevice = 255;
constexpr double kBaselineMismatch = 0.01;  // share by which baseline_m may differ from the models

/// A number's limits and what to do when it is outside them.
struct Range {
  double least = 0;
  double greatest = 0;
  const char* remedy = "";
  bool whole = false;
};

std::string NumberText(double value) {
  std::ostringstream text;
  text.precision(10);
  text << value;
  return text.str();
}

/// One table of the file. Keys are asked for by name; the first error is kept; Finish reports keys
/// that nobody asked for.
class Table {
 public:
  Table(const toml::table& root, std::string file, std::string name)
      : file_(std::move(file)), name_(std::move(name)), line_(1) {
    if (const toml::node* node = root.get(name_)) {
      line_ = static_cast<int>(node->source().begin.line);
      table_ = node->as_table();
      if (table_ == nullptr) {
        Fail(line_, "[" + name_ + "] must be a table");
      }
    }
  }

  bool present() const { return table_ != nullptr; }
  bool Has(const char* key) const { return table_ != nullptr && table_->contains(key); }

  double Number(const char* key, const Range& range) {
    const toml::node* node = Required(key);
    return node == nullptr ? 0 : ReadNumber(*node, key, range);
  }
  double NumberOr(const char* key, const Range& range, double otherwise) {
    return Has(key) ? Number(key, range) : otherwise;
  }

  bool BoolOr(const char* key, bool otherwise) {
    if (!Has(key)) {
      return otherwise;
    }
    const toml::node* node = Required(key);
    if (const auto value = node->value_exact<bool>()) {
      return *value;
    }
    Fail(LineOf(*node), Name(key) + " must be true or false");
    return otherwise;
  }

  std::string Text(const char* key) {
    const toml::node* node = Required(key);
    if (node == nullptr) {
      return {};
    }
    const auto value = node->value_exact<std::string>();
    if (!value || value->empty()) {
      Fail(LineOf(*node), Name(key) + " must be a text in quotes, not empty");
      return {};
    }
    return *value;
  }

  /// A text, or a whole number as text: a device may be given as "0" or 0.
  std::string TextOrIndex(const char* key) {
    const toml::node* node = Required(key);
    if (node == nullptr || !node->is_integer()) {
      return node == nullptr ? std::string() : Text(key);
    }
    const auto index = *node->value<std::int64_t>();
    if (index < 0 || index > kLargestDevice) {
      Fail(LineOf(*node), Name(key) + " = " + std::to_string(index) + " is outside 0 .. " +
                              std::to_string(kLargestDevice) +
                              "; give the number of a device (ls /dev/video*)");
    }
    return std::to_string(index);
  }

  std::vector<double> Numbers(const char* key, std::size_t least, std::size_t most,
                              const Range& range) {
    const toml::node* node = Required(key);
    if (node == nullptr) {
      return {};
    }
    const toml::array* array = node->as_array();
    if (array == nullptr || array->size() < least || array->size() > most) {
      Fail(LineOf(*node), Name(key) + " must be a list of " + std::to_string(least) +
                              (least == most ? "" : " to " + std::to_string(most)) + " numbers");
      return {};
    }
    std::vector<double> numbers;
    for (const toml::node& element : *array) {
      numbers.push_back(ReadNumber(element, key, range));
    }
    return numbers;
  }

  void Fail(int line, const std::string& text) {
    if (!error_) {
      error_ = InvalidError(file_ + ":" + std::to_string(line) + ": " + text);
    }
  }
  void FailKey(const char* key, const std::string& text) {
    const toml::node* node = table_ == nullptr ? nullptr : table_->get(key);
    Fail(node == nullptr ? line_ : LineOf(*node), Name(key) + text);
  }

  /// The first error, or the first key that was not asked for.
  Status Finish() {
    if (!error_ && table_ != nullptr) {
      for (const auto& [key, node] : *table_) {
        if (!asked_.contains(std::string(key.str()))) {
          Fail(LineOf(node), "unknown key " + Name(key.str()) + "; known here: " + Asked());
          break;
        }
      }
    }
    return error_ ? Status(*error_) : Ok();
  }

  /// Names a key as known without reading it.
  void Allow(const char* key) { asked_.insert(key); }

 private:
  static int LineOf(const toml::node& node) { return static_cast<int>(node.source().begin.line); }
  std::string Name(std::string_view key) const { return name_ + "." + std::string(key); }

  std::string Asked() const {
    std::string text;
    for (const std::string& key : asked_) {
      text += (text.empty() ? "" : ", ") + key;
    }
    return text;
  }

  const toml::node* Required(const char* key) {
    asked_.insert(key);
    const toml::node* node = table_ == nullptr ? nullptr : table_->get(key);
    if (node == nullptr) {
      Fail(line_, table_ == nullptr ? "table [" + name_ + "] is missing; add it with " + Name(key)
                                    : Name(key) + " is missing; add it to [" + name_ + "]");
    }
    return node;
  }

  double ReadNumber(const toml::node& node, const char* key, const Range& range) {
    if (!node.is_number()) {
      Fail(LineOf(node), Name(key) + " must be a number");
      return 0;
    }
    const double value = *node.value<double>();
    if (!(value >= range.least && value <= range.greatest)) {
      Fail(LineOf(node), Name(key) + " = " + NumberText(value) + " is outside " +
                             NumberText(range.least) + " .. " + NumberText(range.greatest) + "; " +
                             range.remedy);
    } else if (range.whole && value != std::floor(value)) {
      Fail(LineOf(node),
           Name(key) + " = " + NumberText(value) + " must be a whole number; " + range.remedy);
    }
    return value;
  }

  std::string file_;
  std::string name_;
  int line_ = 1;
  const toml::table* table_ = nullptr;
  std::set<std::string> asked_;
  std::optional<Error> error_;
};

constexpr Range kSide{1, kLargestSide_px, "give the size of the pictures in pixels", true};
constexpr Range kFocal{1e-3, kLargest, "give the focal length in pixels"};
constexpr Range kCentre{-kLargest, kLargest, "give the principal point in pixels"};
constexpr Range kDistortion{-100, 100, "give k1 k2 p1 p2 k3 as OpenCV does"};
constexpr Range kBaseline{1e-3, 1000, "give the distance of the cameras in metres"};
constexpr Range kTilt{-90, 0, "the tilt is negative downwards: 0 horizon, -90 nadir"};
constexpr Range kPosition{-100, 100, "give metres forward, right, down of the reference point"};
constexpr Range kMinDisparity{0, kLargestSide_px, "give the least disparity in whole pixels", true};
constexpr Range kCount{0, 1024, "give a multiple of 16, or 0 to follow the pose", true};
constexpr Range kAngle{-360, 360, "give degrees"};
constexpr Range kPitch{-90, 90, "give degrees"};
constexpr Range kPoseHeight{1e-3, 1e5, "give metres above the ground"};
constexpr Range kRate{1e-3, 1000, "give pairs per second"};
constexpr Range kTolerance{0.01, 10000, "give the largest time between the pictures of a pair"};

/// The cameras that model files tell, until both are placed in one frame.
struct ModelFiles {
  std::optional<CameraModel> left;
  std::optional<CameraModel> right;
  std::string left_name;
  std::string right_name;
};

Status ReadModelFile(Table& table, const RigFile& file, StereoSide side, ModelFiles& models) {
  for (const char* key : {"fx_px", "fy_px", "cx_px", "cy_px", "distortion"}) {
    if (table.Has(key)) {
      table.FailKey(key, " contradicts model_file; give one of them");
    }
    table.Allow(key);
  }
  CameraFileOptions options;
  options.side = side;
  for (const char* key : {"width", "height"}) {
    table.Allow(key);
  }
  if (table.Has("width") || table.Has("height")) {  // for files that tell no size
    options.size.width = static_cast<int>(table.Number("width", kSide));
    options.size.height = static_cast<int>(table.Number("height", kSide));
  }
  const std::string model_file = table.Text("model_file");
  if (Status status = table.Finish(); !status) {
    return status;
  }
  const std::filesystem::path path = file.folder / model_file;
  auto model = ReadCameraFile(path, options);
  if (!model) {
    return model.error();
  }
  if (!HasSize(*model)) {
    table.FailKey("model_file", " = " + model_file +
                                    ": the file tells no picture size; add width and height here");
    return table.Finish();
  }
  (side == StereoSide::kLeft ? models.left : models.right) = *model;
  (side == StereoSide::kLeft ? models.left_name : models.right_name) = path.string();
  return Ok();
}

Status ReadCamera(const toml::table& root, const std::string& name, StereoSide side,
                  const RigFile& file, RigCamera& camera, ModelFiles& models) {
  Table table(root, name, side == StereoSide::kLeft ? "left" : "right");
  if (table.Has("model_file")) {
    return ReadModelFile(table, file, side, models);
  }
  table.Allow("model_file");
  PinholeCamera& pinhole = camera.pinhole;
  pinhole.width = static_cast<int>(table.Number("width", kSide));
  pinhole.height = static_cast<int>(table.Number("height", kSide));
  pinhole.fx_px = table.Number("fx_px", kFocal);
  pinhole.fy_px = table.Number("fy_px", kFocal);
  pinhole.cx_px = table.Number("cx_px", kCentre);
  pinhole.cy_px = table.Number("cy_px", kCentre);
  table.Allow("distortion");
  if (table.Has("distortion")) {
    const std::vector<double> values = table.Numbers("distortion", 4, 5, kDistortion);
    std::copy(values.begin(), values.end(), camera.distortion.begin());
  }
  return table.Finish();
}

bool Distorted(const RigCamera& camera) {
  return camera.cahvor || camera.model || camera.distortion != std::array<double, 5>{};
}

void SetModel(RigCamera& camera, const CameraModel& model) {
  if (const auto* cahvor = std::get_if<CahvorModel>(&model.lens)) {
    camera.cahvor = *cahvor;
  } else {
    camera.model = model;
  }
  camera.pinhole = PinholeFromCahv(LinearPartOf(model)).camera;
}

/// The baseline, and the cameras of model files placed by it.
Status ReadBaseline(Table& table, const ModelFiles& models, StereoRig& rig) {
  if (!models.left || !models.right) {
    rig.baseline_m = table.Number("baseline_m", kBaseline);
    return Ok();
  }
  table.Allow("baseline_m");
  std::optional<double> told;
  if (table.Has("baseline_m")) {
    told = table.Number("baseline_m", kBaseline);
  }
  const auto pair =
      PlacePair(*models.left, *models.right, told, models.left_name, models.right_name);
  if (!pair) {
    return pair.error();
  }
  SetModel(rig.left, pair->left);
  SetModel(rig.right, pair->right);
  const double of_models = (CentreOf(pair->right) - CentreOf(pair->left)).norm();
  rig.baseline_m = told.value_or(of_models);
  if (!(std::abs(rig.baseline_m - of_models) <= kBaselineMismatch * of_models)) {
    table.FailKey("baseline_m", " = " + NumberText(rig.baseline_m) + " m, the camera models are " +
                                    NumberText(of_models) +
                                    " m apart; leave the key out or correct it");
  }
  return Ok();
}

Status ReadRig(const toml::table& root, const std::string& name, const ModelFiles& models,
               StereoRig& rig) {
  if (models.left.has_value() != models.right.has_value()) {
    return InvalidError(name +
                        ": one camera has a model_file and the other has not; give both or none");
  }
  Table table(root, name, "rig");
  if (Status status = ReadBaseline(table, models, rig); !status) {
    return status;
  }
  const bool distorted = Distorted(rig.left) || Distorted(rig.right);
  table.Allow("rectified");
  rig.rectified = table.BoolOr("rectified", !distorted);
  if (rig.rectified && distorted) {
    table.FailKey("rectified",
                  " = true contradicts a model_file or distortion; rectified pictures have none");
  }
  for (const char* key : {"min_disparity_px", "num_disparities"}) {
    table.Allow(key);
  }
  rig.min_disparity_px = static_cast<int>(table.NumberOr("min_disparity_px", kMinDisparity, 0));
  rig.num_disparities = static_cast<int>(table.NumberOr("num_disparities", kCount, 0));
  if (rig.num_disparities % 16 != 0) {
    table.FailKey("num_disparities", " = " + std::to_string(rig.num_disparities) +
                                         " must be a multiple of 16, or 0 to follow the pose");
  }
  if (rig.min_disparity_px >= rig.left.pinhole.width) {
    table.FailKey("min_disparity_px", " = " + std::to_string(rig.min_disparity_px) +
                                          " must be less than the picture's width " +
                                          std::to_string(rig.left.pinhole.width));
  }
  return table.Finish();
}

Status ReadMount(const toml::table& root, const std::string& name, StereoRig& rig) {
  Table table(root, name, "mount");
  rig.tilt_rad = Rad(table.Number("tilt_deg", kTilt));
  table.Allow("position_body_m");
  if (table.Has("position_body_m")) {
    const std::vector<double> p = table.Numbers("position_body_m", 3, 3, kPosition);
    if (p.size() == 3) {
      rig.position_body_m = {p[0], p[1], p[2]};
    }
  }
  return table.Finish();
}

Status ReadPose(const toml::table& root, const std::string& name, RigFile& file) {
  Table table(root, name, "pose");
  if (table.present()) {
    EulerAngles attitude;
    attitude.roll_rad = Rad(table.Number("roll_deg", kAngle));
    attitude.pitch_rad = Rad(table.Number("pitch_deg", kPitch));
    attitude.yaw_rad = Rad(table.Number("heading_deg", kAngle));
    VehiclePose pose;
    pose.X_WB.R = RotationFromEuler(attitude);
    pose.X_WB.p.z() = -table.Number("height_m", kPoseHeight);
    file.pose = pose;
  }
  return table.Finish();
}

Status ReadImages(const toml::table& root, const std::string& name, RigFile& file) {
  Table images(root, name, "images");
  if (images.present()) {
    file.left_pattern = images.Text("left");
    file.right_pattern = images.Text("right");
    images.Allow("rate_hz");
    file.rig.rate_hz = images.NumberOr("rate_hz", kRate, file.rig.rate_hz);
  }
  return images.Finish();
}

/// The size asked of a device must be the one that the camera models are made for.
int ReadCaptureSide(Table& table, const char* key, int expected, const char* which) {
  table.Allow(key);
  const int side = static_cast<int>(table.NumberOr(key, kSide, expected));
  if (side != expected) {
    table.FailKey(key, " = " + std::to_string(side) + " px, " + which + " is " +
                           std::to_string(expected) + " px; calibrate for the size you capture");
  }
  return side;
}

void ReadCaptureAddresses(Table& table, RigCapture& capture) {
  for (const char* key : {"side_by_side", "right", "pair_tolerance_ms"}) {
    table.Allow(key);
  }
  capture.left = table.TextOrIndex("left");
  capture.side_by_side = table.BoolOr("side_by_side", false);
  if (capture.side_by_side) {
    for (const char* key : {"right", "pair_tolerance_ms"}) {
      if (table.Has(key)) {
        table.FailKey(key, " contradicts side_by_side = true; leave one of them out");
      }
    }
    return;
  }
  capture.right = table.TextOrIndex("right");
  if (capture.right == capture.left) {
    table.FailKey("right", " = " + capture.right +
                               " is the left camera too; give two, or side_by_side = true where "
                               "one device gives both pictures");
  }
  if (table.Has("pair_tolerance_ms")) {
    capture.pair_tolerance_s = table.Number("pair_tolerance_ms", kTolerance) * 1e-3;
  }
}

Status ReadCapture(const toml::table& root, const std::string& name, RigFile& file) {
  Table table(root, name, "capture");
  if (!table.present()) {
    return table.Finish();
  }
  RigCapture capture;
  ReadCaptureAddresses(table, capture);
  const PinholeCamera& left = file.rig.left.pinhole;
  capture.width = capture.side_by_side
                      ? ReadCaptureSide(table, "width", 2 * left.width, "twice left.width")
                      : ReadCaptureSide(table, "width", left.width, "left.width");
  capture.height = ReadCaptureSide(table, "height", left.height, "left.height");
  for (const char* key : {"rate_hz", "fourcc", "loop"}) {
    table.Allow(key);
  }
  if (table.Has("rate_hz")) {
    capture.rate_hz = table.Number("rate_hz", kRate);
  }
  if (table.Has("fourcc")) {
    capture.fourcc = table.Text("fourcc");
    if (capture.fourcc.size() != 4) {
      table.FailKey("fourcc", " = " + capture.fourcc +
                                  " must have four letters, e.g. MJPG or YUYV; v4l2-ctl "
                                  "--list-formats-ext shows what a device has");
    }
  }
  capture.loop = table.BoolOr("loop", false);
  if (Status status = table.Finish(); !status) {
    return status;
  }
  file.capture = std::move(capture);
  return Ok();
}

Status CheckTables(const toml::table& root, const std::string& name) {
  static constexpr const char* kTables = "left, right, rig, mount, pose, images, capture";
  const std::set<std::string, std::less<>> known = {"left", "right",  "rig",    "mount",
                                                    "pose", "images", "capture"};
  for (const auto& [key, node] : root) {
    if (!known.contains(key.str())) {
      return InvalidError(name + ":" + std::to_string(node.source().begin.line) + ": unknown key " +
                          std::string(key.str()) + "; known tables: " + kTables);
    }
  }
  return Ok();
}

Status CheckPair(const StereoRig& rig, const std::string& name) {
  const PinholeCamera& left = rig.left.pinhole;
  const PinholeCamera& right = rig.right.pinhole;
  if (rig.rectified &&
      (left.width != right.width || left.height != right.height || left.fx_px != right.fx_px ||
       left.fy_px != right.fy_px || left.cy_px != right.cy_px)) {
    return InvalidError(name +
                        ": rig.rectified = true but [left] and [right] differ; rectified pictures "
                        "share size, focal length and cy_px");
  }
  return Ok();
}

}  // namespace

Result<RigFile> LoadRigFile(const std::filesystem::path& path) {
  const auto text = ReadTextFile(path);
  if (!text) {
    return text.error();
  }
  const std::string name = path.string();
  const toml::parse_result parsed = toml::parse(*text);
  if (!parsed) {
    return InvalidError(name + ":" + std::to_string(parsed.error().source().begin.line) + ": " +
                        std::string(parsed.error().description()));
  }
  const toml::table& root = parsed.table();
  RigFile file;
  file.folder = path.parent_path();
  Status status = CheckTables(root, name);
  const auto then = [&](const auto& step) {
    if (status) {
      status = step();
    }
  };
  ModelFiles models;
  then([&] { return ReadCamera(root, name, StereoSide::kLeft, file, file.rig.left, models); });
  then([&] { return ReadCamera(root, name, StereoSide::kRight, file, file.rig.right, models); });
  then([&] { return ReadRig(root, name, models, file.rig); });
  then([&] { return ReadMount(root, name, file.rig); });
  then([&] { return ReadPose(root, name, file); });
  then([&] { return ReadImages(root, name, file); });
  then([&] { return ReadCapture(root, name, file); });
  then([&] { return CheckPair(file.rig, name); });
  if (!status) {
    return status.error();
  }
  return file;
}

}  // namespace palace
