// As in every file that includes toml++: no exceptions, and a damaged file never aborts.
#define TOML_EXCEPTIONS 0
#define TOML_ASSERT(expr) static_assert(true)
#include "engine/wire/channels.h"

#include <cstdint>
#include <set>

#include <toml++/toml.h>

#include "engine/core/files.h"
#include "engine/core/plain_text.h"
#include "engine/core/toml_text.h"

namespace palace {
namespace {

struct Row {
  const char* key;
  std::string ChannelNames::*name;
};

constexpr std::size_t kLongestChannel = 63;

const std::vector<Row>& Rows() {
  using N = ChannelNames;
  static const std::vector<Row> rows = {
      {"camera_left", &N::camera_left},
      {"camera_right", &N::camera_right},
      {"camera_rig", &N::camera_rig},
      {"vehicle_pose", &N::vehicle_pose},
      {"imu", &N::imu},
      {"gps", &N::gps},
      {"laser_range", &N::laser_range},
      {"vehicle_status", &N::vehicle_status},
      {"command_ack", &N::command_ack},
      {"authority", &N::authority},
      {"truth", &N::truth},
      {"arrival", &N::arrival},
      {"mission", &N::mission},
      {"slad_settings", &N::slad_settings},
      {"site_proposal", &N::site_proposal},
      {"site_decision", &N::site_decision},
      {"command", &N::command},
      {"position_estimate", &N::position_estimate},
      {"tracker_status", &N::tracker_status},
      {"station_status", &N::station_status},
      {"session_request", &N::session_request},
      {"abort", &N::abort},
      {"event", &N::event},
      {"refused", &N::refused},
  };
  return rows;
}

const Row* FindRow(std::string_view key) {
  for (const Row& row : Rows()) {
    if (key == row.key) {
      return &row;
    }
  }
  return nullptr;
}

std::string CheckName(const std::string& name) {
  if (name.empty() || name.size() > kLongestChannel) {
    return "has " + std::to_string(name.size()) + " bytes; LCM takes 1 to 63";
  }
  for (const char c : name) {
    if (c <= ' ' || c > '~') {
      return "holds a blank or a character that is not printable ASCII";
    }
  }
  return name.rfind("#!", 0) == 0 ? "begins with #!, which LCM keeps for itself" : "";
}

Result<ChannelNames> FromTable(const toml::table& root, const std::string& origin) {
  const auto at = [&](const toml::node& node) {
    return origin + ":" + std::to_string(node.source().begin.line) + ": ";
  };
  ChannelNames names;
  for (const auto& [section, node] : root) {
    if (section.str() != "channels" || !node.is_table()) {
      return InvalidError(at(node) + "unknown key '" + std::string(section.str()) +
                          "'; the file has one table, [channels]");
    }
    for (const auto& [key, value] : *node.as_table()) {
      const std::string label = "channels." + Printable(key.str());
      const Row* row = FindRow(key.str());
      if (row == nullptr) {
        return InvalidError(at(value) + "unknown key '" + label +
                            "'; the keys are the default names in lower case, e.g. camera_left");
      }
      if (!value.is_string()) {
        return InvalidError(at(value) + label + " must be a text in quotes");
      }
      names.*(row->name) = value.as_string()->get();
      const std::string problem = CheckName(names.*(row->name));
      if (!problem.empty()) {
        return InvalidError(at(value) + label + " " + Printable(problem));
      }
    }
  }
  std::set<std::string> seen;
  for (const Row& row : Rows()) {
    if (!seen.insert(names.*(row.name)).second) {
      return InvalidError(origin + ": the channel name '" + names.*(row.name) +
                          "' is used twice; give each key its own");
    }
  }
  return names;
}

}  // namespace

std::vector<std::string> ChannelNames::FromVehicle() const {
  return {camera_left, camera_right,   camera_rig,  vehicle_pose, imu,  gps,
          laser_range, vehicle_status, command_ack, authority,    truth};
}

std::vector<std::string> ChannelNames::ToVehicle() const {
  return {command, position_estimate, session_request, abort};
}

Result<ChannelNames> ParseChannels(std::string_view text, const std::string& origin) {
  const Result<toml::table> parsed = ParseToml(text, origin);
  if (!parsed) {
    return parsed.error();
  }
  return FromTable(*parsed, origin);
}

Result<ChannelNames> LoadChannels(const std::filesystem::path& file) {
  const Result<std::string> text = ReadTextFile(file);
  return text ? ParseChannels(*text, file.string()) : Result<ChannelNames>(text.error());
}

}  // namespace palace
