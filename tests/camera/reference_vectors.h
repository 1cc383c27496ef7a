// The vectors of ../shared/data/cahvor_vectors as camera models.
#pragma once

#include <fstream>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "engine/model/camera_models.h"
#include "tests/support/reference_data.h"

namespace palace {

/// The parsed file, or nothing where the reference data are absent.
inline std::optional<nlohmann::json> ReadVectors(const std::string& name) {
  std::ifstream file(ReferenceData("cahvor_vectors/" + name));
  return file ? std::optional<nlohmann::json>(nlohmann::json::parse(file)) : std::nullopt;
}

inline Eigen::Vector3d Vector3From(const nlohmann::json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

inline Eigen::Vector2d Vector2From(const nlohmann::json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>()};
}

inline CahvorModel CahvorFrom(const nlohmann::json& entry) {
  CahvorModel model;
  model.width = entry.at("image_size").at(0).get<int>();
  model.height = entry.at("image_size").at(1).get<int>();
  model.C = Vector3From(entry.at("C"));
  model.A = Vector3From(entry.at("A"));
  model.H = Vector3From(entry.at("H"));
  model.V = Vector3From(entry.at("V"));
  model.O = entry.contains("O") ? Vector3From(entry.at("O")) : model.A;
  model.R = entry.contains("R") ? Vector3From(entry.at("R")) : Eigen::Vector3d::Zero();
  return model;
}

/// CAHV, CAHVOR or CAHVORE.
inline CameraModel JplModelFrom(const nlohmann::json& entry) {
  if (!entry.contains("E")) {
    return {CahvorFrom(entry)};
  }
  CahvoreModel model;
  model.base = CahvorFrom(entry);
  model.E = Vector3From(entry.at("E"));
  const int type = entry.at("mtype").get<int>();
  model.linearity = type == 1 ? 1 : type == 2 ? 0 : entry.at("linearity").get<double>();
  return {model};
}

inline TsaiModel TsaiFrom(const nlohmann::json& entry) {
  const auto number = [&](const char* key) { return entry.at(key).get<double>(); };
  TsaiModel model;
  model.width = entry.at("Nfx").get<int>();
  model.height = 480;
  model.sensor_columns = number("Ncx");
  model.frame_columns = number("Nfx");
  model.dx = number("dx");
  model.dy = number("dy");
  model.dpx = number("dpx");
  model.dpy = number("dpy");
  model.Cx_px = number("Cx");
  model.Cy_px = number("Cy");
  model.sx = number("sx");
  model.f = number("f");
  model.kappa1 = number("kappa1");
  model.T = {number("Tx"), number("Ty"), number("Tz")};
  model.Rx_rad = number("Rx");
  model.Ry_rad = number("Ry");
  model.Rz_rad = number("Rz");
  return model;
}

}  // namespace palace
