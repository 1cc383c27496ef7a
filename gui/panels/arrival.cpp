#include "gui/panels/arrival.h"

#include <algorithm>
#include <vector>

#include "engine/model/channel_age.h"
#include "engine/model/mission/picture_faults.h"
#include "engine/model/mission/wave_off_offer.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

/// What is wrong with what arrives in time: a camera's pictures, a GPS that jumped.
std::string WrongWith(const EngineSnapshot& snap, ChannelId channel) {
  const PictureFaults pictures = JudgePictures(snap.terrain->stereo_quality, snap.session->role);
  const bool left = channel == ChannelId::kCameraLeft, right = channel == ChannelId::kCameraRight;
  const std::vector<Alarm>& alarms = snap.flight->mission.alarms;
  if (channel == ChannelId::kGps && std::any_of(alarms.begin(), alarms.end(), [](const Alarm& a) {
        return a.kind == AlarmId::kGpsJump && a.active;
      })) {
    return "Off the prediction";
  }
  const bool frozen = (left && pictures.left_frozen) || (right && pictures.right_frozen);
  const bool blank = (left && pictures.left_blank) || (right && pictures.right_blank);
  return blank ? "Shows nothing" : frozen ? "Repeats its picture" : "";
}

/// The engine's reason, where nothing is wrong with a camera, which is told over its own picture.
std::string WhyPairOld(const EngineSnapshot& snap) {
  if (!WrongWith(snap, ChannelId::kCameraLeft).empty() ||
      !WrongWith(snap, ChannelId::kCameraRight).empty()) {
    return {};
  }
  for (const GuardResult& guard : snap.flight->mission.guards) {
    if (guard.id == GuardId::kCameras && !guard.pass) {
      return guard.reason;
    }
  }
  return {};
}

Arrival ReadAt(const EngineSnapshot& snap, const ChannelHealth& now) {
  return {AgeText(now.age_s),
          Fixed(now.rate_hz, 1) + " Hz",
          now.age_s,
          now.state,
          WrongWith(snap, now.id),
          LosesMuch(now) ? Fixed(100 * now.lost_share, 0) + " % lost" : ""};
}

/// Null while nothing was ever heard of it.
const ChannelHealth* HeardOf(const EngineSnapshot& snap, ChannelId channel) {
  const ChannelHealth* health = FindChannel(snap.sensors->channels, channel);
  return health != nullptr && health->state != ChannelHealth::State::kNever ? health : nullptr;
}

}  // namespace

Arrival ArrivalOf(const EngineSnapshot& snap, ChannelId channel, double silent_s) {
  const ChannelHealth* health = HeardOf(snap, channel);
  return health != nullptr ? ReadAt(snap, After(*health, silent_s)) : Arrival{};
}

Arrival ArrivalOf(const EngineSnapshot& snap, ChannelId channel, double silent_s, double age_s) {
  const ChannelHealth* health = HeardOf(snap, channel);
  if (health == nullptr) {
    return {};
  }
  ChannelHealth then = *health;
  then.age_s = age_s;
  then.state = StateAt(age_s, then.expected_hz);
  return ReadAt(snap, After(then, silent_s));
}

std::string Heard(const std::string& words, double age_s) {
  return IsWordOld(age_s) ? words + ", heard " + AgeText(age_s) + " ago" : words;
}

void DrawStale(UiFrame& ui, const Rect& image, const EngineSnapshot& snap, const Arrival& arrival) {
  const std::string words = arrival.state == ChannelHealth::State::kStale
                                ? Fixed(arrival.age_s, 1) + " s old"
                            : !arrival.wrong.empty() ? arrival.wrong
                                                     : WhyPairOld(snap);
  if (!words.empty()) {
    StaleVeil(ui.style, Canvas(), image);
    TextPlate(ui, image, Corner::kTopRight, words);
  }
}

std::string LaserPlate(const EngineSnapshot& snap, double silent_s) {
  const bool fresh =
      ArrivalOf(snap, ChannelId::kLaserRange, silent_s).state == ChannelHealth::State::kFresh;
  return fresh && snap.sensors->laser && std::isfinite(snap.sensors->laser->range_m)
             ? "Laser " + Fixed(snap.sensors->laser->range_m, 1) + " m"
             : std::string();
}

}  // namespace palace
