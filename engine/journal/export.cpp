#include "engine/journal/export.h"

#include <cmath>
#include <iterator>
#include <map>
#include <system_error>
#include <variant>

#include "engine/core/csv_row.h"
#include "engine/core/files.h"
#include "engine/core/text.h"
#include "engine/journal/log_index.h"
#include "engine/model/site_columns.h"
#include "engine/wire/convert.h"

namespace palace {
namespace {

/// One line of a table: the time first.
CsvRow Row(Timestamp time) {
  CsvRow row;
  row << time.us;
  return row;
}

constexpr const char* kHeaders[][2] = {
    {"estimates.csv",
     "time_us,source,healthy,approval_id,north_m,east_m,down_m,north_mps,east_mps,down_mps,"
     "sigma_north_m,sigma_east_m,sigma_down_m,sigma_north_mps,sigma_east_mps,sigma_down_mps"},
    {"truth.csv",
     "time_us,north_m,east_m,down_m,north_mps,east_mps,down_mps,roll_rad,pitch_rad,yaw_rad"},
    {"decisions.csv", "time_us,origin,action,name,value,site_id,snapshot_sequence,text"},
    {"refused.csv", "time_us,received_utc_us,sender,channel,reason,bytes,like_it,first_bytes_hex"},
    {"settings.csv", "time_us,name,value"},
    {"events.csv", "time_us,kind,text"},
    {"status.csv",
     "time_us,sequence,state,settings_hash,decision_hash,best_site,best_safe_distance_m,"
     "height_above_site_m,distance_to_site_m,height_m,alarms,vision_in_force"},
};

constexpr const char* kOrigins[] = {"operator", "script", "replay", "station"};
static_assert(std::size(kOrigins) == static_cast<std::size_t>(CommandOrigin::kStation) + 1);

/// As EventKind lists them.
constexpr const char* kKinds[] = {"state", "site",     "decision", "setting",
                                  "alarm", "bookmark", "vehicle",  "fault"};
static_assert(std::size(kKinds) == static_cast<std::size_t>(EventKind::kFault) + 1);

/// As CommandAction lists them.
constexpr const char* kActions[] = {"set_setting",
                                    "apply",
                                    "discard",
                                    "select",
                                    "disarm",
                                    "approve",
                                    "look",
                                    "turn_approach",
                                    "refuse",
                                    "hold",
                                    "wave_off",
                                    "acknowledge_alarm",
                                    "acknowledge_wave_off",
                                    "bookmark",
                                    "ask_for_command",
                                    "release_command",
                                    "command_lost",
                                    "fly_to",
                                    "set_area",
                                    "clear_area"};
static_assert(std::size(kActions) == std::variant_size_v<CommandAction>);

const char* NameOf(const CommandAction& action) {
  const auto* ask = std::get_if<AskForCommand>(&action);
  return ask != nullptr && ask->take_over ? "take_over" : kActions[action.index()];
}

class Exporter {
 public:
  explicit Exporter(const ChannelNames& channels) : channels_(channels) {
    for (const auto& [file, header] : kHeaders) {
      tables_[file].text = std::string(header) + "\n";
    }
    tables_["sites.csv"].text = std::string(kMapColumns) + "," + kSiteColumns + "\n";
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
    } else if (m.channel == n.refused) {
      TakeRefused(m);
    }
  }

  Result<std::vector<ExportedTable>> Write(const std::filesystem::path& folder) const {
    std::vector<ExportedTable> written;
    for (const auto& [name, table] : tables_) {
      const std::filesystem::path path = folder / name;
      if (const Status whole = WriteTextFile(path, table.text); !whole) {
        return whole.error();
      }
      written.push_back({path, table.rows});
    }
    return written;
  }

  /// Messages whose bytes no table could be made of.
  std::uint64_t undecodable() const { return undecodable_; }

 private:
  struct Table {
    std::string text;
    std::uint64_t rows = 0;
  };

  void Add(const char* table, const CsvRow& row) {
    tables_[table].text += row.line();
    ++tables_[table].rows;
  }
  template <typename T>
  bool Refuses(const Result<T>& decoded) {
    undecodable_ += decoded ? 0 : 1;
    return !decoded;
  }
  void TakeEstimate(const WireMessage& m) {
    const Result<VehicleMessage> message = DecodeVehicleMessage(m, channels_);
    if (Refuses(message)) {
      return;
    }
    static constexpr const char* kSources[] = {"none", "gps", "vision"};
    const auto& e = std::get<PositionEstimate>(*message);
    Add("estimates.csv", Row(e.time)
                             << kSources[static_cast<int>(e.source)] << static_cast<int>(e.healthy)
                             << e.approval_id << e.p_WB << e.v_WB << e.sigma_p_m << e.sigma_v_mps);
  }
  void TakeRefused(const WireMessage& m) {
    const Result<RefusedDatagram> refused = DecodeRefused(m);
    if (!Refuses(refused)) {
      std::string hex;
      for (const std::uint8_t byte : refused->head) {
        hex += "0123456789abcdef"[byte >> 4];
        hex += "0123456789abcdef"[byte & 15];
      }
      Add("refused.csv", Row(m.time) << refused->time.us << refused->sender << refused->channel
                                     << refused->reason << std::uint64_t{refused->bytes}
                                     << refused->like_it << hex);
    }
  }
  void TakeTruth(const WireMessage& m) {
    const Result<Truth> truth = DecodeTruth(m);
    if (!Refuses(truth)) {
      const EulerAngles a = EulerFromRotation(truth->X_WB.R);
      Add("truth.csv", Row(truth->time) << truth->X_WB.p << truth->v_WB << a.roll_rad << a.pitch_rad
                                        << a.yaw_rad);
    }
  }
  void TakeDecision(const WireMessage& m) {
    const Result<EngineCommand> command = DecodeCommand(m);
    if (Refuses(command)) {
      return;
    }
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
    } else if (const auto* look = std::get_if<LookAtSite>(&command->action)) {
      site = std::to_string(look->site_id);
      sequence = std::to_string(look->snapshot_sequence);
      value = look->stop_height_m;
    } else if (const auto* turn = std::get_if<TurnApproach>(&command->action)) {
      site = std::to_string(turn->site_id);
      value = turn->side;
    } else if (const auto* refuse = std::get_if<RefuseSite>(&command->action)) {
      site = std::to_string(refuse->site_id);
    } else if (const auto* alarm = std::get_if<AcknowledgeAlarm>(&command->action)) {
      name = alarm->alarm;
    } else if (const auto* bookmark = std::get_if<AddBookmark>(&command->action)) {
      text = bookmark->note;
    } else if (const auto* lost = std::get_if<CommandLost>(&command->action)) {
      text = lost->why;
    } else if (const auto* to = std::get_if<FlyTo>(&command->action)) {
      value = to->heading_rad;
      text = WithNumbers("%.3f north, %.3f east,", to->p_WB.x(), to->p_WB.y()) +
             WithNumbers(" %.3f down, m", to->p_WB.z());
    } else if (const auto* area = std::get_if<SetFlyArea>(&command->action)) {
      value = area->area.ceiling_m;
      for (const Eigen::Vector2d& corner : area->area.corners_W) {
        text += (text.empty() ? "" : "; ") +
                WithNumbers("%.3f north, %.3f east", corner.x(), corner.y());
      }
      text += ", m";
    }
    Add("decisions.csv", Row(m.time) << kOrigins[static_cast<int>(command->origin)]
                                     << NameOf(command->action) << name << value << site << sequence
                                     << text);
  }
  void TakeProposal(const WireMessage& m) {
    const Result<SiteProposal> proposal = DecodeProposal(m);
    if (Refuses(proposal)) {
      return;
    }
    const SiteTableMap map{proposal->time, proposal->map_time, proposal->map_hash,
                           proposal->settings_hash, proposal->grid};
    int rank = 0;
    for (const LandingSite& site : proposal->selection.sites) {
      CsvRow row = BeginSiteRow(map);
      AppendSite(row, ++rank, site);
      Add("sites.csv", row);
    }
    if (rank == 0) {
      CsvRow row = BeginSiteRow(map);
      AppendNoSite(row, proposal->selection.none_reason);
      Add("sites.csv", row);
    }
  }
  void TakeSettings(const WireMessage& m) {
    const Result<Settings> settings = DecodeSettings(m);
    if (!Refuses(settings)) {
      for (const SettingInfo& info : SettingTable()) {
        Add("settings.csv", Row(m.time) << info.name << GetSetting(*settings, info.name));
      }
    }
  }
  void TakeEvent(const WireMessage& m) {
    const Result<Event> event = DecodeEvent(m);
    if (!Refuses(event)) {
      Add("events.csv", Row(event->time)
                            << kKinds[static_cast<std::size_t>(event->kind)] << event->text);
    }
  }
  void TakeStatus(const WireMessage& m) {
    const Result<FlightRecordSample> s = DecodeStationStatus(m);
    if (!Refuses(s)) {
      Add("status.csv", Row(s->time)
                            << s->sequence << MissionStateName(s->state) << s->settings_hash
                            << s->decision_hash << s->best_site << s->best_safe_distance_m
                            << s->height_above_site_m << s->distance_to_site_m << s->height_m
                            << s->alarms << static_cast<int>(s->vision_in_force));
    }
  }

  ChannelNames channels_;
  std::map<std::string, Table> tables_;
  std::uint64_t undecodable_ = 0;
};

}  // namespace

Result<ExportedLog> ExportCsv(const std::filesystem::path& log, const std::filesystem::path& folder,
                              const ChannelNames& channels) {
  const Result<LogFile> file = LogFile::Open(log);
  if (!file) {
    return file.error();
  }
  const Result<LogIndex> index = BuildIndex(*file);
  if (!index) {
    return index.error();
  }
  if (const Status made = MakeFolder(folder); !made) {
    return UnavailableError("--out: " + made.error().message);
  }
  Exporter exporter(channels);
  ExportedLog exported;
  for (const LogEntry& entry : index->entries) {
    const std::string& channel = index->channels[entry.channel];
    if (channel == channels.camera_left || channel == channels.camera_right) {
      continue;
    }
    const Result<WireMessage> message = ReadEvent(*file, entry, index->channels);
    if (message) {
      exporter.Take(*message);
    } else {
      ++exported.left_out;
    }
  }
  auto tables = exporter.Write(folder);
  if (!tables) {
    return tables.error();
  }
  exported.left_out += exporter.undecodable();
  exported.tables = std::move(*tables);
  return exported;
}

}  // namespace palace
