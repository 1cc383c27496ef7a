#include "engine/faults/fault_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <utility>
#include <vector>

#include "engine/core/text.h"
#include "engine/wire/channels.h"

namespace palace {
namespace {

constexpr std::size_t kLongestText = 200;

const std::vector<std::pair<ChannelId, std::string>>& Names() {
  static const ChannelNames lcm;
  static const std::vector<std::pair<ChannelId, std::string>> kNames = {
      {ChannelId::kCameraLeft, lcm.camera_left},
      {ChannelId::kCameraRight, lcm.camera_right},
      {ChannelId::kVehiclePose, lcm.vehicle_pose},
      {ChannelId::kImu, lcm.imu},
      {ChannelId::kGps, lcm.gps},
      {ChannelId::kLaserRange, lcm.laser_range},
      {ChannelId::kVehicleStatus, lcm.vehicle_status}};
  return kNames;
}

/// A finite number at the front of `text`, which loses it.
std::optional<double> TakeNumber(std::string_view& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) {
    return std::nullopt;
  }
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// What stands at the front of `text` until one of `stops`; `text` loses it.
std::string_view TakeUntil(std::string_view& text, const char* stops) {
  const std::size_t end = std::min(text.size(), text.find_first_of(stops));
  const std::string_view taken = text.substr(0, end);
  text.remove_prefix(end);
  return taken;
}

bool TakeMark(std::string_view& text, char mark) {
  const bool there = !text.empty() && text.front() == mark;
  text.remove_prefix(there ? 1 : 0);
  return there;
}

/// "from-to" or "from-".
bool TakeTimes(std::string_view text, Fault& fault) {
  const std::optional<double> from = TakeNumber(text);
  if (!from || !TakeMark(text, '-')) {
    return false;
  }
  fault.from_s = *from;
  if (!text.empty()) {
    const std::optional<double> to = TakeNumber(text);
    if (!to || !text.empty()) {
      return false;
    }
    fault.to_s = *to;
  }
  return true;
}

}  // namespace

std::string ExactNumber(double value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string FaultChannelName(ChannelId id) {
  for (const auto& [channel, name] : Names()) {
    if (channel == id) {
      return name;
    }
  }
  return ChannelName(id);
}

std::optional<ChannelId> FindFaultChannel(std::string_view name) {
  for (const auto& [channel, known] : Names()) {
    if (known == name) {
      return channel;
    }
  }
  return std::nullopt;
}

std::optional<FaultKind> FindFaultKind(std::string_view name) {
  for (const FaultKindRow& row : FaultKindTable()) {
    if (name == row.name) {
      return row.kind;
    }
  }
  return std::nullopt;
}

Result<Fault> ParseFault(std::string_view text) {
  const auto wrong = [&](const std::string& what) {
    return UsageError("fault \"" + std::string(text.substr(0, kLongestText)) + "\": " + what);
  };
  std::string_view rest = text;
  const std::string name(TakeUntil(rest, "=@:").substr(0, kLongestText));
  const std::optional<FaultKind> kind = FindFaultKind(name);
  if (!kind) {
    return wrong("there is no kind \"" + name +
                 "\"; palacectl faults lists them. The form is kind[=value][@CHANNEL][:from-to]");
  }
  Fault fault{.kind = *kind};
  if (TakeMark(rest, '=')) {
    const std::optional<double> value = TakeNumber(rest);
    if (!value || (!rest.empty() && rest.front() != '@' && rest.front() != ':')) {
      return wrong("after = stands no number");
    }
    fault.value = *value;
  }
  if (TakeMark(rest, '@')) {
    const std::string channel(TakeUntil(rest, ":"));
    fault.channel = FindFaultChannel(channel);
    if (!fault.channel) {
      std::vector<std::string> known;
      for (const auto& each : Names()) {
        known.push_back(each.second);
      }
      return wrong("there is no channel \"" + channel + "\"; known: " + Joined(known));
    }
  }
  if (TakeMark(rest, ':') && !TakeTimes(rest, fault)) {
    return wrong("times are seconds of flight, from-to or from-, e.g. :20-30 or :12-");
  }
  if (const Status sound = CheckFault(fault); !sound) {
    return UsageError(sound.error().message);
  }
  return fault;
}

std::string FaultText(const Fault& fault) {
  std::string text = RowOf(fault.kind).name;
  text += std::isnan(fault.value) ? "" : "=" + ExactNumber(fault.value);
  text += fault.channel ? "@" + FaultChannelName(*fault.channel) : "";
  const bool ends = std::isfinite(fault.to_s);
  if (fault.from_s != 0 || ends) {
    text += ":" + ExactNumber(fault.from_s) + "-" + (ends ? ExactNumber(fault.to_s) : "");
  }
  return text;
}

std::string FaultKindWords(FaultKind kind) {
  if (kind == FaultKind::kAttitudeNan) {
    return "attitude not known";  // what its name says to a programmer alone
  }
  std::string words = RowOf(kind).name;
  for (char& c : words) {
    c = c == '_' ? ' ' : c;
  }
  for (const char* acronym : {"GPS", "IMU"}) {
    std::string small = acronym;
    std::transform(small.begin(), small.end(), small.begin(), ::tolower);
    if (words.starts_with(small + " ")) {
      words.replace(0, small.size(), acronym);
    }
  }
  return words;
}

std::string FaultWords(const Fault& fault) {
  const FaultKindRow& row = RowOf(fault.kind);
  std::string words = FaultKindWords(fault.kind);
  if (!std::isnan(row.default_value)) {
    const bool degrees = std::string_view(row.unit).starts_with("°");  // the sign follows its digit
    words += " " + NumberText(fault.ValueOrDefault()) + (degrees ? "" : " ") + row.unit;
  }
  if (fault.channel) {
    std::string channel = ChannelName(*fault.channel);
    const bool acronym = channel.size() > 1 && std::isupper(static_cast<unsigned char>(channel[1]));
    if (!acronym) {
      channel[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(channel[0])));
    }
    return words + " on " + channel;
  }
  return words + (fault.kind >= FaultKind::kMissing         ? " on every channel"
                  : fault.kind < FaultKind::kCamerasSwapped ? " on both cameras"
                                                            : "");
}

}  // namespace palace
