// The table behind settings.h: each row with how to reach the member it speaks of. Internal to the
// room.
#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/model/settings/settings.h"

namespace palace {

/// Groups that say what the ground may be like, and what lands on it.
inline constexpr const char* kHazardGroup = "Hazard limits";
inline constexpr const char* kLanderGroup = "Lander";

struct SettingRow {
  SettingInfo info;
  std::function<double(const Settings&)> get;
  std::function<void(Settings&, double)> set;
  /// At its default it adds nothing to the hash of settings: a row that came after flights had been
  /// recorded, so that they keep their hashes.
  bool hashed_when_changed = false;
};

/// Builds a row for one member. Default and whole numbers follow from the member; a usual range
/// that is not given is the whole one.
class RowBuilder {
 public:
  template <typename GroupOf, typename Group, typename Member>
  RowBuilder(const char* name, const char* label, GroupOf group_of, Member Group::*member) {
    const Settings standard;
    row_.info.name = name;
    row_.info.label = label;
    row_.info.default_value = static_cast<double>(group_of(standard).*member);
    row_.info.integer = !std::is_floating_point_v<Member>;
    row_.get = [=](const Settings& s) { return static_cast<double>(group_of(s).*member); };
    row_.set = [=](Settings& s, double v) { group_of(s).*member = static_cast<Member>(v); };
  }
  RowBuilder& Says(const char* description) {
    row_.info.description = description;
    return *this;
  }
  RowBuilder& Shown(const char* unit, int decimals, double shown_per_unit = 1) {
    row_.info.unit = unit;
    row_.info.decimals = decimals;
    row_.info.shown_per_unit = shown_per_unit;
    return *this;
  }
  RowBuilder& Within(double min, double max) {
    row_.info.min = row_.info.soft_min = min;
    row_.info.max = row_.info.soft_max = max;
    return *this;
  }
  RowBuilder& Usually(double min, double max) {
    row_.info.soft_min = min;
    row_.info.soft_max = max;
    return *this;
  }
  RowBuilder& HashedWhenChanged() {
    row_.hashed_when_changed = true;
    return *this;
  }
  /// A choice: values 0, 1, ... as files write them.
  RowBuilder& Choice(std::vector<std::string> words) {
    row_.info.words = std::move(words);
    row_.info.decimals = 0;
    return Within(0, static_cast<double>(row_.info.words.size()) - 1);
  }
  SettingRow Done() const { return row_; }

 private:
  SettingRow row_;
};

/// In the order of screens and files. The order is part of a settings hash.
const std::vector<SettingRow>& SettingRows();

}  // namespace palace
