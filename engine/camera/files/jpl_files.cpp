// JPL camera models: text files and the GEOMETRIC_CAMERA_MODEL group of PDS3 and VICAR labels.
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/camera/cahvor.h"
#include "engine/camera/files/camera_file_formats.h"

namespace palace {
namespace {

/// Where a label or a text file keeps the parts of a model.
struct Keys {
  std::string C = "C", A = "A", H = "H", V = "V", O = "O", R = "R", E = "E";
  std::string type = "T";       ///< of CAHVORE, where the model line does not tell
  std::string parameter = "P";  ///< linearity of type 3
  double C_m = 1, E_m = 1;      ///< metres of the unit that they are told in
};

Status ReadVector(const KeyedText& text, const std::string& key, Eigen::Vector3d& vector) {
  const auto numbers = text.Numbers(key, 3, 3);
  if (!numbers) {
    return numbers.error();
  }
  vector = Eigen::Map<const Eigen::Vector3d>(numbers->data());
  return Ok();
}

Status ReadUnitVector(const KeyedText& text, const std::string& key, Eigen::Vector3d& vector) {
  if (Status status = ReadVector(text, key, vector); !status) {
    return status;
  }
  const double length = vector.norm();
  if (!(length > 0.99 && length < 1.01)) {
    return text.Wrong(key, "has length " + std::to_string(length) +
                               ", a direction must have length 1 within 0.01");
  }
  // A vector that is unit to rounding stays as it is: files round-trip to the bit.
  if (std::abs(length - 1) > 4 * std::numeric_limits<double>::epsilon()) {
    vector /= length;
  }
  return Ok();
}

Status ReadBase(const KeyedText& text, const Keys& keys, bool has_distortion, CahvorModel& model) {
  std::vector<Status> steps = {
      ReadVector(text, keys.C, model.C), ReadUnitVector(text, keys.A, model.A),
      ReadVector(text, keys.H, model.H), ReadVector(text, keys.V, model.V)};
  if (has_distortion) {
    steps.push_back(ReadUnitVector(text, keys.O, model.O));
    steps.push_back(ReadVector(text, keys.R, model.R));
  } else {
    model.O = model.A;
    if (text.Has(keys.R)) {
      steps.push_back(ReadVector(text, keys.R, model.R));
    }
  }
  for (const Status& step : steps) {
    if (!step) {
      return step;
    }
  }
  if (!has_distortion && !model.R.isZero(0)) {
    return text.Wrong(keys.R, "a CAHV model has no distortion; name the model CAHVOR if it has it");
  }
  model.C *= keys.C_m;
  const Eigen::Vector3d across = model.A.cross(model.H);
  const Eigen::Vector3d down = model.A.cross(model.V);
  if (!(across.norm() > 1e-6)) {
    return text.Wrong(keys.H, "runs along A; the focal length hs = |A x H| would be 0");
  }
  if (!(down.norm() > 1e-6)) {
    return text.Wrong(keys.V, "runs along A; the focal length vs = |A x V| would be 0");
  }
  if (!(across.cross(down).norm() > 1e-6 * across.norm() * down.norm())) {
    return text.Wrong(keys.V, "runs along H; rows and columns would be parallel");
  }
  // (A x H) x (A x V) . A is (H' x V') . A: A is unit.
  if (!(across.cross(down).dot(model.A) > 0)) {
    return text.Wrong(keys.H,
                      "gives a mirrored model: (H' x V') . A is negative, with x to the right, y "
                      "down and A forward it must be positive; correct the sign of H or V");
  }
  if (has_distortion && !(model.O.dot(model.A) > 0)) {
    return text.Wrong(keys.O, "points away from A; the optical axis must look forward");
  }
  return Ok();
}

Result<CameraModel> ReadCahvore(const KeyedText& text, const Keys& keys, double linearity,
                                const std::string& where) {
  CahvoreModel model;
  if (Status status = ReadBase(text, keys, true, model.base); !status) {
    return status.error();
  }
  if (Status status = ReadVector(text, keys.E, model.E); !status) {
    return status.error();
  }
  if (!(std::abs(linearity) <= 10)) {
    return text.Wrong(where, "the linearity must lie within -10 .. 10; real lenses have -1 .. 1");
  }
  model.E *= keys.E_m;
  model.linearity = linearity;
  return CameraModel{model};
}

/// Linearity of a CAHVORE type.
Result<double> LinearityOf(const KeyedText& text, double type, const std::string& type_key,
                           const std::string& parameter_key) {
  if (type == 1 || type == 2) {
    return type == 1 ? 1.0 : 0.0;
  }
  if (type != 3) {
    return text.Wrong(type_key, "CAHVORE has the types 1 perspective, 2 fisheye, 3 general");
  }
  return text.Number(parameter_key);
}

Result<CameraModel> WithSize(const KeyedText& text, const Keys& keys, Result<CameraModel> model,
                             const Result<PictureSize>& size) {
  if (model && !size) {
    return size.error();
  }
  if (model) {
    SetSize(*model, size->width, size->height);
    return WithInternals(text, {keys.H, keys.V, keys.H, keys.V}, *model);
  }
  return model;
}

/// "CAHVORE3,0.37 = general": family, type and linearity of the model line.
Result<CameraModel> ReadCahvoreLine(const KeyedText& text, std::string_view word) {
  KeyedText parts(text.file());
  const int line = text.Find("Model")->line;
  const auto comma = word.find(',');
  parts.Add("Model", line, text.Find("Model")->text);
  parts.Add("type", line, word.substr(7, comma == std::string_view::npos ? comma : comma - 7));
  if (comma != std::string_view::npos) {
    parts.Add("linearity of the Model line", line, word.substr(comma + 1));
  }
  const auto type = parts.Number("type");
  if (!type) {
    return text.Wrong("Model",
                      "a CAHVORE model needs its type: CAHVORE1, CAHVORE2 or CAHVORE3,linearity");
  }
  const auto linearity = LinearityOf(parts, *type, "Model", "linearity of the Model line");
  return linearity ? ReadCahvore(text, Keys{}, *linearity, "Model")
                   : Result<CameraModel>(linearity.error());
}

/// Older files without a model line: the vectors that are there tell.
Result<CameraModel> ReadUnnamed(const KeyedText& text) {
  const Keys keys;
  if (text.Has("E")) {
    const auto type = text.Number(keys.type);
    if (!type) {
      return text.Missing("Model",
                          "a CAHVORE model needs the line Model = CAHVORE1, CAHVORE2 or "
                          "CAHVORE3,linearity");
    }
    const auto linearity = LinearityOf(text, *type, keys.type, keys.parameter);
    return linearity ? ReadCahvore(text, keys, *linearity, keys.parameter)
                     : Result<CameraModel>(linearity.error());
  }
  CahvorModel model;
  const Status status = ReadBase(text, keys, text.Has("O") || text.Has("R"), model);
  return status ? Result<CameraModel>(CameraModel{model}) : Result<CameraModel>(status.error());
}

/// METER of "Meters", without what stands around it.
std::string UnitName(std::string_view text) {
  std::string name;
  for (const char c : text) {
    if (std::string_view(" \t\r\n\f\v(){}<>\"'").find(c) == std::string_view::npos) {
      name += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
  }
  if (name.size() > 2 && name.back() == 'S') {
    name.pop_back();
  }
  return name;
}

/// The entry of a list of units; empty where the list is shorter.
std::string UnitInList(std::string_view list, std::size_t index) {
  for (; index > 0; --index) {
    const auto comma = list.find(',');
    if (comma == std::string_view::npos) {
      return {};
    }
    list.remove_prefix(comma + 1);
  }
  return UnitName(list.substr(0, list.find(',')));
}

/// Metres of a component's unit, which stands as <unit> behind its numbers or in the label's list
/// of units; `untold_m` where neither tells it, as labels do for E.
Result<double> UnitOf(const KeyedText& text, const std::string& key, const std::string& list_key,
                      std::size_t index, double untold_m) {
  std::string unit;
  std::string where = key;
  const KeyedValue* value = text.Find(key);
  std::string_view rest = value == nullptr ? std::string_view{} : std::string_view(value->text);
  for (auto at = rest.find('<'); at != std::string_view::npos; at = rest.find('<')) {
    rest.remove_prefix(at + 1);
    const std::string next = UnitName(rest.substr(0, rest.find('>')));
    if (!unit.empty() && next != unit) {
      return text.Wrong(key, "its numbers have different units; give them in one");
    }
    unit = next;
  }
  const KeyedValue* list = text.Find(list_key);
  if (unit.empty() && list != nullptr) {
    if (list->is_cut || list->again_line > 0) {
      return text.Wrong(list_key,
                        "is cut short, or given again with another value; give it once, whole");
    }
    unit = UnitInList(list->text, index);
    where = list_key;
  }
  if (unit.empty() || unit == "N/A") {
    return untold_m;
  }
  struct Unit {
    std::string_view name;
    double m;
  };
  static constexpr std::array<Unit, 9> kUnits = {{{"M", 1},
                                                  {"METER", 1},
                                                  {"METRE", 1},
                                                  {"CM", 0.01},
                                                  {"CENTIMETER", 0.01},
                                                  {"CENTIMETRE", 0.01},
                                                  {"MM", 0.001},
                                                  {"MILLIMETER", 0.001},
                                                  {"MILLIMETRE", 0.001}}};
  for (const Unit& known : kUnits) {
    if (unit == known.name) {
      return known.m;
    }
  }
  return text.Wrong(where, "the unit of " + key +
                               " must be METER, CENTIMETER or MILLIMETER; N/A counts as metres");
}

}  // namespace

Result<CameraModel> ReadJplText(const KeyedText& text) {
  const auto size =
      text.Has("Dimensions") ? ReadSides(text, "Dimensions") : Result<PictureSize>(PictureSize{});
  if (!text.Has("Model")) {
    return WithSize(text, Keys{}, ReadUnnamed(text), size);
  }
  const std::string value = text.Word("Model");
  const std::string_view name = Trimmed(std::string_view(value).substr(0, value.find('=')));
  if (name.substr(0, 7) == "CAHVORE") {
    return WithSize(text, Keys{}, ReadCahvoreLine(text, name), size);
  }
  const std::string_view word = name.substr(0, name.find_first_of(" \t,"));
  if (word != "CAHV" && word != "CAHVOR") {
    return text.Wrong("Model", "PALACE reads CAHV, CAHVOR and CAHVORE");
  }
  CahvorModel model;
  const Status status = ReadBase(text, Keys{}, word == "CAHVOR", model);
  return status ? WithSize(text, Keys{}, CameraModel{model}, size)
                : Result<CameraModel>(status.error());
}

std::string JplToText(const CahvorModel& base, const CahvoreModel* cahvore) {
  const bool linear = cahvore == nullptr && IsLinear(base);
  std::string text = "Model = ";
  if (cahvore == nullptr) {
    text += linear ? "CAHV = perspective, linear" : "CAHVOR = perspective, distortion";
  } else if (cahvore->linearity == 1) {
    text += "CAHVORE1 = perspective, distortion, pupil";
  } else if (cahvore->linearity == 0) {
    text += "CAHVORE2 = fish-eye";
  } else {
    text += "CAHVORE3," + Exact(cahvore->linearity) + " = general";
  }
  text += "\n";
  if (base.width > 0 && base.height > 0) {
    text += "Dimensions = " + std::to_string(base.width) + " " + std::to_string(base.height) + "\n";
  }
  const auto add = [&](const char* key, const Eigen::Vector3d& v) {
    text += std::string(key) + " = " + Exact(v.data(), 3, " ") + "\n";
  };
  add("C", base.C);
  add("A", base.A);
  add("H", base.H);
  add("V", base.V);
  if (!linear) {
    add("O", base.O);
    add("R", base.R);
  }
  if (cahvore != nullptr) {
    add("E", cahvore->E);
  }
  const CahvInternals internals = InternalsOf(base);
  text += "Hs    = " + Exact(internals.hs_px) + "\nHc    = " + Exact(internals.hc_px) +
          "\nVs    = " + Exact(internals.vs_px) + "\nVc    = " + Exact(internals.vc_px) +
          "\nTheta = " + Exact(internals.theta_rad) + " (" +
          std::to_string(internals.theta_rad * 180 / std::numbers::pi) + " deg)\n";
  return text;
}

Result<CameraModel> ReadPdsLabel(const KeyedText& text) {
  std::string group;
  for (const char* name :
       {"GEOMETRIC_CAMERA_MODEL.", "GEOMETRIC_CAMERA_MODEL_PARMS.", "GEOM_CAMERA_MODEL."}) {
    if (group.empty() && text.Has(name + std::string("MODEL_TYPE"))) {
      group = name;
    }
  }
  const std::string type_key = group + "MODEL_TYPE";
  if (!text.Has(type_key)) {
    return text.Missing("MODEL_TYPE",
                        "the label needs a group GEOMETRIC_CAMERA_MODEL with a camera model");
  }
  // The components' names tell which is which; without them JPL's order holds.
  std::string names = text.Word(group + "MODEL_COMPONENT_ID");
  std::string order;
  for (const char c : names) {
    order +=
        std::string_view("CAHVORETP").find(c) != std::string_view::npos ? std::string(1, c) : "";
  }
  order = order.empty() ? "CAHVORETP" : order;
  const auto key_of = [&](char letter) {
    const auto at = order.find(letter);
    return at == std::string::npos ? group + "MODEL_COMPONENT of " + letter
                                   : group + "MODEL_COMPONENT_" + std::to_string(at + 1);
  };
  Keys keys = {key_of('C'), key_of('A'), key_of('H'), key_of('V'), key_of('O'),
               key_of('R'), key_of('E'), key_of('T'), key_of('P')};
  // VICAR labels write it with two underlines.
  const std::string units =
      text.FirstOf({group + "MODEL_COMPONENT_UNIT", group + "MODEL_COMPONENT__UNIT"});
  const auto C_m = UnitOf(text, keys.C, units, order.find('C'), 1);
  if (!C_m) {
    return C_m.error();
  }
  const auto E_m = UnitOf(text, keys.E, units, order.find('E'), *C_m);
  if (!E_m) {
    return E_m.error();
  }
  keys.C_m = *C_m;
  keys.E_m = *E_m;
  const auto size = text.Has("IMAGE.LINES") ? ReadSize(text, "IMAGE.LINE_SAMPLES", "IMAGE.LINES")
                                            : ReadSize(text, "NS", "NL");
  const std::string type = text.Word(type_key);
  if (type == "CAHVORE") {
    const auto number = text.Number(keys.type);
    if (!number) {
      return number.error();
    }
    const auto linearity = LinearityOf(text, *number, keys.type, keys.parameter);
    return linearity
               ? WithSize(text, keys, ReadCahvore(text, keys, *linearity, keys.parameter), size)
               : Result<CameraModel>(linearity.error());
  }
  if (type != "CAHV" && type != "CAHVOR") {
    return text.Wrong(type_key, "PALACE reads CAHV, CAHVOR and CAHVORE");
  }
  CahvorModel model;
  const Status status = ReadBase(text, keys, type == "CAHVOR", model);
  return status ? WithSize(text, keys, CameraModel{model}, size)
                : Result<CameraModel>(status.error());
}

}  // namespace palace
