// Willson's .cpcc: camera parameters and calibration constants of Tsai's model, one number a line.
#include <array>
#include <vector>

#include "engine/camera/files/camera_file_formats.h"

namespace palace {
namespace {

constexpr double kMillimetre = 0.001;

/// The numbers of a file in order, and where they belong. p1 and p2 are placeholders of his format.
struct Field {
  const char* name;
  double* value;
  bool positive;
};

std::vector<Field> FieldsOf(TsaiModel& m, std::array<double, 2>& p) {
  return {{"Ncx", &m.sensor_columns, true},
          {"Nfx", &m.frame_columns, true},
          {"dx", &m.dx, true},
          {"dy", &m.dy, true},
          {"dpx", &m.dpx, true},
          {"dpy", &m.dpy, true},
          {"Cx", &m.Cx_px, false},
          {"Cy", &m.Cy_px, false},
          {"sx", &m.sx, true},
          {"f", &m.f, true},
          {"kappa1", &m.kappa1, false},
          {"Tx", &m.T.x(), false},
          {"Ty", &m.T.y(), false},
          {"Tz", &m.T.z(), false},
          {"Rx", &m.Rx_rad, false},
          {"Ry", &m.Ry_rad, false},
          {"Rz", &m.Rz_rad, false},
          {"p1", p.data(), false},
          {"p2", p.data() + 1, false}};
}

}  // namespace

Result<CameraModel> ReadWillson(const KeyedText& text) {
  TsaiModel model;
  std::array<double, 2> p{};
  int number = 0;
  if (text.Has("18") && !text.Has("19")) {
    return text.Wrong(
        "18",
        "18 numbers, one is missing or one too many; a .cpcc file holds 17, or 19 with "
        "p1 and p2");
  }
  for (const Field& field : FieldsOf(model, p)) {
    const std::string key = std::to_string(++number);
    const bool optional = number > 17;
    if (!text.Has(key)) {
      if (optional) {
        continue;
      }
      return text.Missing(std::string("number ") + key + " (" + field.name + ")",
                          "a .cpcc file holds Ncx Nfx dx dy dpx dpy Cx Cy sx f kappa1 Tx Ty Tz Rx "
                          "Ry Rz, then p1 p2, one a line");
    }
    const auto value = text.Number(key);
    if (!value) {
      return InvalidError(value.error().message + " (" + field.name + ")");
    }
    if (field.positive && !(*value > 0)) {
      return text.Wrong(key, std::string(field.name) + " must be positive");
    }
    if (optional && *value != 0) {
      return text.Wrong(
          key, std::string(field.name) + " must be 0; Tsai's model has no tangential distortion");
    }
    *field.value = *value;
  }
  if (text.Has("20")) {
    return text.Wrong("20", "a .cpcc file ends after 19 numbers");
  }
  CameraModel camera{model, kMillimetre};
  if (text.Has("Dimensions")) {  // our own comment line: the format itself tells no height
    const auto size = ReadSides(text, "Dimensions");
    if (!size) {
      return size.error();
    }
    SetSize(camera, size->width, size->height);
  }
  return WithInternals(text, {"10", "10", "7", "8"}, camera);
}

std::string WillsonToText(const CameraModel& model) {
  TsaiModel m = std::get<TsaiModel>(model.lens);
  if (model.unit_m != kMillimetre) {
    m = std::get<TsaiModel>(InUnit(model, kMillimetre).lens);
  }
  std::array<double, 2> p{};
  std::string text;
  for (const Field& field : FieldsOf(m, p)) {
    text += Exact(*field.value) + "\n";
  }
  if (HasSize(model)) {
    text += "# Dimensions = " + std::to_string(m.width) + " " + std::to_string(m.height) + "\n";
  }
  return text;
}

}  // namespace palace
