#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>

#include "engine/core/text.h"
#include "engine/model/approach_side.h"
#include "engine/wire/convert.h"
#include "engine/wire/wire_fields.h"
#include "engine/wire/wire_pack.h"

namespace palace {
namespace {

/// Kinds of EventKind up to kVehicle are themselves; then alarms with their level, lowest first;
/// then kinds that came later, so that no number of an old log changes its meaning.
constexpr int kFirstAlarmLevel = static_cast<int>(EventKind::kVehicle) + 1;
constexpr int kFaultOnWire = kFirstAlarmLevel + static_cast<int>(AlarmLevel::kWarning) + 1;
constexpr int kLastKind = kFaultOnWire;

int WireKind(const Event& event) {
  if (event.level) {
    return kFirstAlarmLevel + static_cast<int>(*event.level);
  }
  return event.kind == EventKind::kFault ? kFaultOnWire : static_cast<int>(event.kind);
}

/// Puts an action's fields into the message; one overload an action.
struct ActionToWire {
  site_decision_t& m;

  void operator()(const SetSetting& a) const {
    m.kind = site_decision_t::SET_SETTING;
    m.name = a.name;
    m.value = a.value;
  }
  void operator()(const ApplySettings&) const { m.kind = site_decision_t::APPLY; }
  void operator()(const DiscardSettings&) const { m.kind = site_decision_t::DISCARD; }
  void operator()(const SelectSite& a) const { Site(site_decision_t::SELECT, a.site_id); }
  void operator()(const DisarmSite&) const { m.kind = site_decision_t::DISARM; }
  void operator()(const ApproveSite& a) const {
    Site(site_decision_t::APPROVE, a.site_id);
    m.snapshot_sequence = WireId(a.snapshot_sequence);
  }
  void operator()(const LookAtSite& a) const {
    Site(site_decision_t::LOOK, a.site_id);
    m.snapshot_sequence = WireId(a.snapshot_sequence);
    m.value = a.stop_height_m;
  }
  void operator()(const TurnApproach& a) const {
    Site(site_decision_t::TURN_APPROACH, a.site_id);
    m.value = a.side;
  }
  void operator()(const RefuseSite& a) const { Site(site_decision_t::REFUSE, a.site_id); }
  void operator()(const HoldHere&) const { m.kind = site_decision_t::HOLD; }
  void operator()(const WaveOff&) const { m.kind = site_decision_t::WAVE_OFF; }
  void operator()(const AcknowledgeAlarm& a) const {
    m.kind = site_decision_t::ACKNOWLEDGE_ALARM;
    m.name = a.alarm;
  }
  void operator()(const AcknowledgeWaveOff&) const {
    m.kind = site_decision_t::ACKNOWLEDGE_WAVE_OFF;
  }
  void operator()(const AddBookmark& a) const {
    m.kind = site_decision_t::BOOKMARK;
    m.text = a.note;
  }
  void operator()(const AskForCommand& a) const {
    m.kind = a.take_over ? site_decision_t::TAKE_OVER : site_decision_t::ASK_FOR_COMMAND;
  }
  void operator()(const ReleaseCommand&) const { m.kind = site_decision_t::RELEASE_COMMAND; }
  void operator()(const CommandLost& a) const {
    m.kind = site_decision_t::COMMAND_LOST;
    m.text = a.why;
  }
  void operator()(const FlyTo& a) const {
    m.kind = site_decision_t::FLY_TO;
    m.value = a.heading_rad;
    Pack(a.p_WB, m.pos);
  }
  void operator()(const SetFlyArea& a) const {
    m.kind = site_decision_t::SET_AREA;
    m.value = a.area.ceiling_m;
    for (const Eigen::Vector2d& corner : a.area.corners_W) {
      m.corner_north.push_back(corner.x());
      m.corner_east.push_back(corner.y());
    }
    m.corner_count = static_cast<std::int32_t>(a.area.corners_W.size());
  }
  void operator()(const ClearFlyArea&) const { m.kind = site_decision_t::CLEAR_AREA; }

 private:
  void Site(std::int8_t kind, std::uint64_t id) const {
    m.kind = kind;
    m.site_id = WireId(id);
  }
};

Result<CommandAction> SideFromWire(double value, std::uint64_t site_id) {
  for (int side = kStraightApproach; IsApproachSide(side); ++side) {
    if (value == side) {
      return CommandAction(TurnApproach{site_id, side});
    }
  }
  return InvalidError(WithNumbers("side of an approach %g is not one of -1..7", value));
}

Result<CommandAction> AreaFromWire(const site_decision_t& m) {
  FlyArea area;
  for (std::size_t k = 0; k < m.corner_north.size(); ++k) {
    area.corners_W.emplace_back(m.corner_north[k], m.corner_east[k]);
  }
  area.ceiling_m = m.value;
  if (std::string why = WhyNoArea(area); !why.empty()) {
    return InvalidError("area: " + why);
  }
  return CommandAction(SetFlyArea{std::move(area)});
}

Result<CommandAction> ActionFromWire(const site_decision_t& m) {
  const std::uint64_t site = IdFromWire(m.site_id);
  switch (m.kind) {
    case site_decision_t::SET_SETTING:
      return CommandAction(SetSetting{m.name, m.value});
    case site_decision_t::APPLY:
      return CommandAction(ApplySettings{});
    case site_decision_t::DISCARD:
      return CommandAction(DiscardSettings{});
    case site_decision_t::SELECT:
      return CommandAction(SelectSite{site});
    case site_decision_t::DISARM:
      return CommandAction(DisarmSite{});
    case site_decision_t::APPROVE:
      return CommandAction(ApproveSite{site, IdFromWire(m.snapshot_sequence)});
    case site_decision_t::LOOK:
      return CommandAction(LookAtSite{site, IdFromWire(m.snapshot_sequence), m.value});
    case site_decision_t::TURN_APPROACH:
      return SideFromWire(m.value, site);
    case site_decision_t::REFUSE:
      return CommandAction(RefuseSite{site});
    case site_decision_t::HOLD:
      return CommandAction(HoldHere{});
    case site_decision_t::WAVE_OFF:
      return CommandAction(WaveOff{});
    case site_decision_t::ACKNOWLEDGE_ALARM:
      return CommandAction(AcknowledgeAlarm{m.name});
    case site_decision_t::ACKNOWLEDGE_WAVE_OFF:
      return CommandAction(AcknowledgeWaveOff{});
    case site_decision_t::BOOKMARK:
      return CommandAction(AddBookmark{m.text});
    case site_decision_t::ASK_FOR_COMMAND:
    case site_decision_t::TAKE_OVER:
      return CommandAction(AskForCommand{m.kind == site_decision_t::TAKE_OVER});
    case site_decision_t::RELEASE_COMMAND:
      return CommandAction(ReleaseCommand{});
    case site_decision_t::COMMAND_LOST:
      return CommandAction(CommandLost{m.text});
    case site_decision_t::FLY_TO:
      return CommandAction(FlyTo{Unpack(m.pos), m.value});
    case site_decision_t::SET_AREA:
      return AreaFromWire(m);
    case site_decision_t::CLEAR_AREA:
      return CommandAction(ClearFlyArea{});
    default:
      return InvalidError("decision kind " + std::to_string(m.kind) + " is not one of 0..20");
  }
}

}  // namespace

WireMessage EncodeCommand(const EngineCommand& command, Timestamp now,
                          const ChannelNames& channels) {
  site_decision_t m{};
  m.utime = now.us;
  m.origin = static_cast<std::int8_t>(command.origin);
  std::visit(ActionToWire{m}, command.action);
  return MakeMessage(channels.site_decision, now, m);
}

Result<EngineCommand> DecodeCommand(const WireMessage& message) {
  return DecodeAnd<site_decision_t>(message, [](const site_decision_t& m) -> Result<EngineCommand> {
    if (m.origin < 0 || m.origin > 3) {
      return InvalidError("decision origin " + std::to_string(m.origin) + " is not one of 0..3");
    }
    Result<CommandAction> action = ActionFromWire(m);
    if (!action) {
      return action.error();
    }
    return EngineCommand{static_cast<CommandOrigin>(m.origin), std::move(*action)};
  });
}

WireMessage EncodeEvent(const Event& event, const ChannelNames& channels) {
  event_t m{};
  m.utime = event.time.us;
  m.kind = static_cast<std::int8_t>(WireKind(event));
  m.text = event.text;
  return MakeMessage(channels.event, event.time, m);
}

Result<Event> DecodeEvent(const WireMessage& message) {
  return DecodeAnd<event_t>(message, [](const event_t& m) -> Result<Event> {
    if (m.kind < 0 || m.kind > kLastKind) {
      return InvalidError("event kind " + std::to_string(m.kind) + " is not one of 0.." +
                          std::to_string(kLastKind));
    }
    Event event{{m.utime}, static_cast<EventKind>(m.kind), m.text};
    if (m.kind == kFaultOnWire) {
      event.kind = EventKind::kFault;
    } else if (m.kind >= kFirstAlarmLevel) {
      event.kind = EventKind::kAlarm;
      event.level = static_cast<AlarmLevel>(m.kind - kFirstAlarmLevel);
    }
    return event;
  });
}

WireMessage EncodeSettings(const Settings& settings, Timestamp now, const ChannelNames& channels) {
  slad_settings_t m{};
  m.utime = now.us;
  m.settings_hash = WireId(HashOf(settings));
  for (const SettingInfo& info : SettingTable()) {
    slad_setting_t row{};
    row.name = info.name;
    row.value = GetSetting(settings, info.name);
    m.rows.push_back(row);
  }
  m.count = static_cast<std::int32_t>(m.rows.size());
  return MakeMessage(channels.slad_settings, now, m);
}

Result<Settings> DecodeSettings(const WireMessage& message) {
  return DecodeAnd<slad_settings_t>(message, [](const slad_settings_t& m) -> Result<Settings> {
    Settings settings;
    for (const slad_setting_t& row : m.rows) {
      const Status set = SetSettingValue(settings, row.name, row.value);
      if (!set) {
        return set.error();
      }
    }
    return settings;
  });
}

}  // namespace palace
