#include "engine/model/settings/sound_settings.h"

#include <cmath>
#include <vector>

#include "engine/core/text.h"
#include "engine/model/approval_limits.h"
#include "engine/model/settings/setting_rows.h"

namespace palace {
namespace {

constexpr std::size_t kMostNamed = 3;

/// Shown values are rounded: a size that is shown equal to what it must hold does.
constexpr double kSlack_m = 0.005;

}  // namespace

std::string WhyNotLandable(const Lander& lander) {
  const double gear_m = std::hypot(lander.gear_length_m, lander.gear_width_m);
  if (lander.base_size_m < gear_m - kSlack_m) {
    return WithNumbers("Base size %.2f m, min %.2f m: its circle holds the gear",
                       lander.base_size_m, gear_m);
  }
  const double clear_m = lander.clear_radius_m();
  return clear_m < ApprovalLimits::kLeastRadius_m || clear_m > ApprovalLimits::kMostRadius_m
             ? WithNumbers("Required clear radius %.2f m, vehicles take %.1f to %.0f m", clear_m,
                           ApprovalLimits::kLeastRadius_m, ApprovalLimits::kMostRadius_m)
             : "";
}

std::string OutsideUsual(const Settings& settings) {
  std::vector<std::string> outside;
  for (const SettingRow& row : SettingRows()) {
    const SettingInfo& info = row.info;
    if (info.group != kHazardGroup && info.group != kLanderGroup) {
      continue;
    }
    const double value = row.get(settings);
    if (value < info.soft_min || value > info.soft_max) {
      outside.push_back(info.label + " " + FormatSetting(info, value) + " (usually " +
                        FormatSetting(info, info.soft_min) + " to " +
                        FormatSetting(info, info.soft_max) + ")");
    }
  }
  if (outside.size() > kMostNamed) {
    const std::size_t more = outside.size() - kMostNamed;
    outside.resize(kMostNamed);
    return Joined(outside) + WithNumbers(" and %.0f more", static_cast<double>(more));
  }
  return Joined(outside);
}

}  // namespace palace
