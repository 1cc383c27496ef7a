#include "engine/model/settings/settings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/core/hash.h"
#include "engine/core/units.h"
#include "engine/model/settings/setting_rows.h"

namespace palace {
namespace {

const SettingRow* FindRow(std::string_view name) {
  const auto& all = SettingRows();
  const auto it = std::find_if(all.begin(), all.end(),
                               [&](const SettingRow& row) { return row.info.name == name; });
  return it == all.end() ? nullptr : &*it;
}

std::string Number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace

Eigen::Vector3d Lander::up_W() const {
  const double tilt = Rad(up_tilt_deg), azimuth = Rad(up_azimuth_deg);
  return {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), -std::cos(tilt)};
}

const std::vector<SettingInfo>& SettingTable() {
  static const std::vector<SettingInfo> infos = [] {
    std::vector<SettingInfo> table;
    for (const SettingRow& row : SettingRows()) {
      table.push_back(row.info);
    }
    return table;
  }();
  return infos;
}

const SettingInfo* FindSetting(std::string_view name) {
  for (const SettingInfo& info : SettingTable()) {
    if (info.name == name) {
      return &info;
    }
  }
  return nullptr;
}

double GetSetting(const Settings& settings, std::string_view name) {
  const SettingRow* row = FindRow(name);
  PALACE_CHECK(row != nullptr, name);
  return row->get(settings);
}

Status SetSettingValue(Settings& settings, std::string_view name, double value) {
  const SettingRow* row = FindRow(name);
  if (row == nullptr) {
    return InvalidError("unknown setting '" + std::string(name) + "'");
  }
  const SettingInfo& info = row->info;
  if (!std::isfinite(value) || value < info.min || value > info.max) {
    return InvalidError(info.name + " = " + Number(value) + " is out of range, limits " +
                        Number(info.min) + " to " + Number(info.max));
  }
  if (info.integer && value != std::floor(value)) {
    return InvalidError(info.name + " = " + Number(value) + " must be a whole number");
  }
  Settings changed = settings;
  row->set(changed, value);
  const auto& s = changed.stereo;
  if (s.block_size_px % 2 == 0 || s.refine_window_px % 2 == 0 ||
      changed.tracking.template_size_px % 2 == 0) {
    return InvalidError(info.name + " = " + Number(value) + " must be odd");
  }
  if (s.num_disparities % 16 != 0) {
    return InvalidError(info.name + " = " + Number(value) + " must be a multiple of 16");
  }
  settings = changed;
  return Ok();
}

double ClampSetting(const SettingInfo& info, double value) {
  double clamped = std::clamp(value, info.min, info.max);
  if (!info.integer) {
    return clamped;
  }
  clamped = std::round(clamped);
  if (info.name == "stereo.num_disparities") {
    return std::clamp(std::round(clamped / 16) * 16, info.min, info.max);
  }
  const bool odd = info.name == "stereo.block_size_px" || info.name == "stereo.refine_window_px" ||
                   info.name == "tracking.template_size_px";
  return odd && std::fmod(clamped, 2) == 0 ? clamped + 1 : clamped;
}

std::uint64_t HashOf(const Settings& settings) {
  ContentHash hash;
  for (const SettingRow& row : SettingRows()) {
    const double value = row.get(settings);
    if (row.hashed_when_changed && value == row.info.default_value) {
      continue;
    }
    hash.Add(std::string_view(row.info.name));
    hash.Add(value);
  }
  return hash.value();
}

std::string FormatSetting(const SettingInfo& info, double value) {
  if (!info.words.empty()) {
    const auto index = static_cast<std::size_t>(std::clamp(value, info.min, info.max));
    return info.words[index];
  }
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", info.decimals, value * info.shown_per_unit);
  std::string shown = text;
  if (!shown.empty() && shown[0] == '-') {
    shown = "\u2212" + shown.substr(1);
  }
  if (info.unit.empty()) {
    return shown;
  }
  return info.unit == "°" ? shown + info.unit : shown + " " + info.unit;
}

}  // namespace palace
