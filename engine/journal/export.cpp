#include "engine/journal/export.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <system_error>

#include "engine/journal/log_index.h"
#include "engine/wire/convert.h"

namespace palace {
namespace {

std::string Number(double value) {
  if (std::isnan(value)) {
    return "";
  }
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// Quoted where a comma, a quote or a line break needs it (RFC 4180).
std::string Text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  }
  return quoted + "\"";
}

/// One line of a table.
class Row {
 public:
  explicit Row(Timestamp time) : line_(std::to_string(time.us)) {}
  Row& operator<<(double value) { return Field(Number(value)); }
  Row& operator<<(int value) { return Field(std::to_string(value)); }
  Row& operator<<(std::uint64_t value) { return Field(std::to_string(value)); }
  Row& operator<<(const std::string& text) { return Field(Text(text)); }
  Row& operator<<(const char* text) { return Field(Text(text)); }
  Row& operator<<(const Eigen::Vector3d& v) { return *this << v.x() << v.y() << v.z(); }
  Row& operator<<(const Figure& f) { return *this << f.value << f.three_sigma; }
  std::string line() const { return line_ + "\n"; }

 private:
  Row& Field(const std::string& text) {
    line_ += ',' + text;
    return *this;
  }
  std::string line_;
};

constexpr const char* kHeaders[][2] = {
    {"estimates.csv",
     "time_us,source,healthy,approval_id,north_m,east_m,down_m,north_mps,east_mps,down_mps,"
     "sigma_north_m,sigma_east_m,sigma_down_m,sigma_north_mps,sigma_east_mps,sigma_down_mps"},
    {"truth.csv",
     "time_us,north_m,east_m,down_m,north_mps,east_mps,down_mps,roll_rad,pitch_rad,yaw_rad"},
    {"decisions.csv", "time_us,origin,action,name,value,site_id,snapshot_sequence,text"},
    {"sites.csv",
     "time_us,map_time_us,map_hash,settings_hash,rank,site_id,letter,row,col,north_m,east_m,"
     "down_m,slope_rad,slope_3sigma_rad,roughness_m,roughness_3sigma_m,step_m,step_3sigma_m,"
     "height_m,height_3sigma_m,safe_distance_m,clear_radius_m,clearance_m,cost,safe_probability,"
     "worst_probability,worst_heading_rad,best_probability,best_heading_rad,flags,confirmed,"
     "corridor_clear,clear_approaches,age_s,distance_m,reason"},
    {"settings.csv", "time_us,name,value"},
    {"events.csv", "time_us,kind,text"},
    {"status.csv",
     "time_us,sequence,state,settings_hash,decision_hash,best_site,best_safe_distance_m,"
     "height_above_site_m,distance_to_site_m,height_m,alarms,vision_in_force"},
};

class Exporter {
 public:
  explicit Exporter(const ChannelNames& channels) : channels_(channels) {
    for (const auto& [file, header] : kHeaders) {
      tables_[file].text = std::string(header) + "\n";
    }
  }

  void Take(const WireMessage& m) {
    const ChannelNames& n = channels_;
    if (m.channel == n.position_estimate) {
      TakeEstimate(m);
    } else if (m.channel == n.truth) {
      TakeTruth(m);
    } else if (m.channel == n.site_decision) {
      TakeDecision(m);
    } else if (m.channel == n.site_proposal) {
      TakeProposal(m);
    } else if (m.channel == n.slad_settings) {
      TakeSettings(m);
    } else if (m.channel == n.event) {
      TakeEvent(m);
    } else if (m.channel == n.station_status) {
      TakeStatus(m);
    }
  }

  Result<std::vector<ExportedTable>> Write(const std::filesystem::path& folder) const {
    std::vector<ExportedTable> written;
    for (const auto& [name, table] : tables_) {
      const std::filesystem::path path = folder / name;
      std::ofstream file(path, std::ios::binary | std::ios::trunc);
      file << table.text;
      file.close();
      if (!file) {
        return UnavailableError(path.string() +
                                ": cannot be written; choose another folder or free space");
      }
      written.push_back({path, table.rows});
    }
    return written;
  }

 private:
  struct Table {
    std::string text;
    std::uint64_t rows = 0;
  };

  void Add(const char* table, const Row& row) {
    tables_[table].text += row.line();
    ++tables_[table].rows;
  }
  void TakeEstimate(const WireMessage& m) {
    const Result<VehicleMessage> message = DecodeVehicleMessage(m, channels_);
    if (!message) {
      return;
    }
    static constexpr const char* kSources[] = {"none", "gps", "vision"};
    const auto& e = std::get<PositionEstimate>(*message);
    Add("estimates.csv", Row(e.time)
                             << kSources[static_cast<int>(e.source)] << static_cast<int>(e.healthy)
                             << e.approval_id << e.p_WB << e.v_WB << e.sigma_p_m << e.sigma_v_mps);
  }
  void TakeTruth(const WireMessage& m) {
    const Result<Truth> truth = DecodeTruth(m);
    if (truth) {
      const EulerAngles a = EulerFromRotation(truth->X_WB.R);
      Add("truth.csv", Row(truth->time) << truth->X_WB.p << truth->v_WB << a.roll_rad << a.pitch_rad
                                        << a.yaw_rad);
    }
  }
  void TakeDecision(const WireMessage& m) {
    const Result<EngineCommand> command = DecodeCommand(m);
    if (!command) {
      return;
    }
    static constexpr const char* kOrigins[] = {"operator", "script", "replay"};
    static constexpr const char* kActions[] = {"set_setting",
                                               "apply",
                                               "discard",
                                               "select",
                                               "disarm",
                                               "approve",
                                               "refuse",
                                               "hold",
                                               "wave_off",
                                               "acknowledge_alarm",
                                               "acknowledge_wave_off",
                                               "bookmark"};
    std::string name;
    std::string text;
    double value = NAN;
    std::string site;
    std::string sequence;
    if (const auto* set = std::get_if<SetSetting>(&command->action)) {
      name = set->name;
      value = set->value;
    } else if (const auto* select = std::get_if<SelectSite>(&command->action)) {
      site = std::to_string(select->site_id);
    } else if (const auto* approve = std::get_if<ApproveSite>(&command->action)) {
      site = std::to_string(approve->site_id);
      sequence = std::to_string(approve->snapshot_sequence);
    } else if (const auto* refuse = std::get_if<RefuseSite>(&command->action)) {
      site = std::to_string(refuse->site_id);
    } else if (const auto* alarm = std::get_if<AcknowledgeAlarm>(&command->action)) {
      name = alarm->alarm;
    } else if (const auto* bookmark = std::get_if<AddBookmark>(&command->action)) {
      text = bookmark->note;
    }
    Add("decisions.csv", Row(m.time) << kOrigins[static_cast<int>(command->origin)]
                                     << kActions[command->action.index()] << name << value << site
                                     << sequence << text);
  }
  void TakeProposal(const WireMessage& m) {
    const Result<SiteProposal> proposal = DecodeProposal(m);
    if (!proposal) {
      return;
    }
    int rank = 0;
    for (const LandingSite& s : proposal->selection.sites) {
      Add("sites.csv", Row(proposal->time)
                           << std::to_string(proposal->map_time.us) << proposal->map_hash
                           << proposal->settings_hash << ++rank << s.id << std::string(1, s.letter)
                           << s.cell.row << s.cell.col << s.p_WS << s.slope_rad << s.roughness_m
                           << s.step_m << s.height_m << s.safe_distance_m << s.clear_radius_m
                           << s.clearance_m << s.cost << s.safe_probability
                           << s.touchdown.worst_probability << s.touchdown.worst_heading_rad
                           << s.touchdown.best_probability << s.touchdown.best_heading_rad
                           << static_cast<int>(s.flags) << static_cast<int>(s.confirmed)
                           << static_cast<int>(s.corridor_clear)
                           << static_cast<int>(s.clear_approaches) << s.age_s << s.distance_m
                           << s.reason);
    }
  }
  void TakeSettings(const WireMessage& m) {
    const Result<Settings> settings = DecodeSettings(m);
    if (settings) {
      for (const SettingInfo& info : SettingTable()) {
        Add("settings.csv", Row(m.time) << info.name << GetSetting(*settings, info.name));
      }
    }
  }
  void TakeEvent(const WireMessage& m) {
    static constexpr const char* kKinds[] = {"state", "site",     "decision", "setting",
                                             "alarm", "bookmark", "vehicle"};
    const Result<Event> event = DecodeEvent(m);
    if (event) {
      Add("events.csv", Row(event->time) << kKinds[static_cast<int>(event->kind)] << event->text);
    }
  }
  void TakeStatus(const WireMessage& m) {
    const Result<FlightRecordSample> s = DecodeStationStatus(m);
    if (s) {
      Add("status.csv",
          Row(s->time) << s->sequence << MissionStateName(s->state) << s->settings_hash
                       << s->decision_hash
                       << (s->best_site != 0 ? std::string(1, s->best_site) : std::string())
                       << s->best_safe_distance_m << s->height_above_site_m << s->distance_to_site_m
                       << s->height_m << s->alarms << static_cast<int>(s->vision_in_force));
    }
  }

  ChannelNames channels_;
  std::map<std::string, Table> tables_;
};

}  // namespace

Result<std::vector<ExportedTable>> ExportCsv(const std::filesystem::path& log,
                                             const std::filesystem::path& folder,
                                             const ChannelNames& channels) {
  const Result<LogFile> file = LogFile::Open(log);
  if (!file) {
    return file.error();
  }
  const Result<LogIndex> index = BuildIndex(*file);
  if (!index) {
    return index.error();
  }
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) {
    return UnavailableError(folder.string() + ": cannot be made (" + failed.message() +
                            "); choose another folder with --out");
  }
  Exporter exporter(channels);
  for (const LogEntry& entry : index->entries) {
    const std::string& channel = index->channels[entry.channel];
    if (channel == channels.camera_left || channel == channels.camera_right) {
      continue;
    }
    const Result<WireMessage> message = ReadEvent(*file, entry, index->channels);
    if (message) {
      exporter.Take(*message);
    }
  }
  return exporter.Write(folder);
}

}  // namespace palace
