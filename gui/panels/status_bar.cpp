#include <algorithm>
#include <cmath>

#include "engine/core/hash.h"
#include "engine/core/text.h"
#include "engine/model/mission/alarm_text.h"
#include "engine/model/mission/approve_offer.h"
#include "gui/panels/arrival.h"
#include "gui/panels/frame_bar.h"
#include "gui/panels/session_words.h"
#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

/// "Left 30.0 Hz, right no picture for 3.2 s, 4 lost"
std::string CamerasText(const std::vector<CameraCounters>& cameras) {
  std::string text;
  std::uint64_t lost = 0;
  for (const CameraCounters& camera : cameras) {
    const std::string side = camera.name.substr(camera.name.rfind(' ') + 1);
    text += (text.empty() ? "Camera " : ", ") + side + " ";
    text += !camera.problem.empty() ? "lost " + AgeText(camera.age_s)
                                    : Fixed(camera.rate_hz, 1) + " Hz";
    lost += camera.unpaired + camera.device_dropped;
  }
  return text + ", " + std::to_string(lost) + " pictures lost";
}

std::string LinkText(const EngineSnapshot& snap, bool narrow, double silent_s) {
  std::uint64_t lost = 0;
  for (const ChannelHealth& channel : snap.sensors->channels) {
    lost += channel.lost;
  }
  const ChannelHealth* pose = FindChannel(snap.sensors->channels, ChannelId::kVehiclePose);
  if (FollowsRecord(snap.session->role)) {
    return snap.session->source.name;
  }
  if (!snap.session->source.cameras.empty()) {
    return CamerasText(snap.session->source.cameras);
  }
  if (!snap.session->can_transmit) {
    return WhyNoLink(snap);
  }
  const char* name =
      snap.session->source.kind == SourceKind::kSimulation ? "Simulated link " : "Link ";
  std::string text = name + AgeText(pose != nullptr ? pose->age_s + silent_s : NAN);
  if (!narrow && snap.session->source.kind != SourceKind::kSimulation) {
    text += ", " + std::to_string(lost) + " lost";
  }
  return text;
}

/// After a jump into a record what is seen is worked out again from there; the flight itself knew
/// more. Empty while it was seen from its start.
std::string BegunAnewText(const EngineSnapshot& snap, bool narrow) {
  return SeenFromStart(snap.session->role) ? ""
         : narrow                          ? "Begun anew at the jump"
                                           : "Map, trackers and filters begun anew at the jump";
}

constexpr const char* kWhyBegunAnew =
    "From the place jumped to, map, trackers and filters are worked out again from the recorded "
    "pictures: what the flight itself knew by then, of ground seen before, is not in them.";

/// Pictures that came and were not looked at, because newer ones had come; empty while there are
/// none.
std::string ReplacedText(const EngineSnapshot& snap) {
  const std::uint64_t replaced = snap.session->losses.pairs_replaced;
  return replaced == 0
             ? ""
             : std::to_string(replaced) + (replaced == 1 ? " pair" : " pairs") + " overtaken";
}

std::string RecordingText(const EngineSnapshot& snap, bool narrow) {
  if (!snap.session->recording) {
    const std::string why = snap.session->record.problem;
    return FollowsRecord(snap.session->role) ? ""
                                             : "Not recording" + (why.empty() ? "" : ": " + why);
  }
  // Not finite: the recorder does not know its rate yet.
  const RecordState& record = snap.session->record;
  const std::string left =
      (record.pictures_every != 1 ? ", " + ThinningWords(record.pictures_every) : "") +
      (std::isfinite(record.minutes_left) ? ", " + Fixed(record.minutes_left, 0) + " min left"
                                          : std::string());
  return narrow ? "Recording" + left
                : "Recording " + LengthText(snap.session->source.position_s) + left;
}

std::string ChannelsText(const EngineSnapshot& snap, double silent_s) {
  using State = ChannelHealth::State;
  int fine = 0, faulty = 0, late = 0, never = 0;
  for (const ChannelHealth& channel : snap.sensors->channels) {
    const Arrival arrival = ArrivalOf(snap, channel.id, silent_s);
    const bool fresh = arrival.state == State::kFresh;
    ++(arrival.fine() ? fine : fresh ? faulty : arrival.state == State::kNever ? never : late);
  }
  const auto some = [](int count, const char* what) {
    return count > 0 ? ", " + std::to_string(count) + what : std::string();
  };
  // Diagnose names each: what repeats its picture comes in time, and shows nothing new.
  return "Channels: " + std::to_string(fine) + " fresh" + some(faulty, " wrong or lossy") +
         some(late, " late or stale") + some(never, " never heard");
}

/// "2 faults injected: GPS jump 3 m, laser stuck"; empty while none acts.
std::string FaultsText(const std::vector<std::string>& faults) {
  return faults.empty() ? ""
                        : std::to_string(faults.size()) +
                              (faults.size() == 1 ? " fault injected: " : " faults injected: ") +
                              Joined(faults);
}

/// A person who flies a simulated fault must not take it for one of the station's own. Its width.
float DrawFaultChip(UiFrame& ui, const std::string& text, float x, float y, float room) {
  const Style& s = ui.style;
  // Half a name misleads: where not all fit, their number alone.
  const bool fits = TextWidth(s.caption, text) <= room - s.Px(16);
  const std::string words = fits ? text : text.substr(0, text.find(':'));
  const Rect chip{x, y - s.Px(10), TextWidth(s.caption, words) + s.Px(16), s.Px(20)};
  FillRect(Canvas(), chip, s.palette.hover, s.Fine(3));
  DrawText(ui, s.caption, s.palette.text1, x + s.Px(8), y, words);
  ui.items.Add("status/Faults", chip, true, text);
  return chip.w;
}

}  // namespace

void DrawStatusBarPanel(const EngineSnapshot& snap, const FrameLayout& layout,
                        const FrameState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const Rect& bar = layout.status_bar;
  const bool narrow = layout.narrow;
  FillRect(Canvas(), bar, p.panel);
  ui.items.Add("panel/Status bar", bar, true, "");
  const float y = bar.centre().y;
  const float gap = s.Px(24);
  float right = bar.right() - s.Px(12);
  right -= DrawText(ui, s.mono, p.text2, right, y, ClockText(snap.time) + " " + ClockName(snap),
                    Align::kRight);
  const std::size_t sites =
      snap.terrain->applied ? snap.terrain->applied->selection.sites.size() : 0;
  std::vector<std::string> group = {CommandText(snap, narrow)};
  if (narrow) {
    group.push_back(ChannelsText(snap, ui.silent_s));
    std::swap(group[0], group[1]);
  } else {
    group.push_back(sites == 1 ? "1 site" : std::to_string(sites) + " sites");
    group.push_back(AlarmCountWords(snap.flight->mission.alarms));
    if (snap.session->source.kind == SourceKind::kSimulation && IsPlaying(snap)) {
      group.push_back(Fixed(snap.session->source.speed_reached, 1) + "× real time");
    }
  }
  for (auto item = group.rbegin(); item != group.rend(); ++item) {
    if (!item->empty()) {
      right -= gap + DrawText(ui, s.caption, p.text2, right - gap, y, *item, Align::kRight);
    }
  }
  const std::string limits = state.preset_name + " · " + ShortHash(snap.session->settings_hash);
  std::vector<std::string> left = {WhyScreenOld(ui.silent_s),
                                   LinkText(snap, narrow, ui.silent_s),
                                   BegunAnewText(snap, narrow),
                                   ReplacedText(snap),
                                   RecordingText(snap, narrow),
                                   narrow ? limits : "Limits " + limits,
                                   state.text_note};
  if (!narrow) {
    left.push_back(state.frame_ms > 0 ? "Frame " + Fixed(state.frame_ms, 0) + " ms" : "");
  }
  float x = bar.x + s.Px(12);
  if (const std::string faults = FaultsText(snap.session->injected_faults); !faults.empty()) {
    x += DrawFaultChip(ui, faults, x, y, (right - gap - x) / 2) + gap;
  }
  const std::string begun = BegunAnewText(snap, narrow);
  for (const std::string& item : left) {
    if (item.empty() || x + TextWidth(s.caption, item) >= right - gap) {
      continue;
    }
    const Rect told{x, bar.y, DrawText(ui, s.caption, p.text2, x, y, item), bar.h};
    if (item == begun && Interact(ui, "begun_anew", told, kPassive).hovered) {
      DrawTooltip(ui, kWhyBegunAnew);
    }
    x += told.w + gap;
  }
}

void DrawFrameBar(const EngineSnapshot& snap, const FrameLayout& layout, FrameState& state,
                  UiFrame& ui) {
  ui.tab.group = kFrameTabs;
  DrawTopBarPanel(snap, layout, state, ui);
  DrawAlarmStripPanel(snap, layout.alarm_strip, state, ui);
  DrawWaveOffPanel(snap, layout.wave_off, state, ui);
  DrawStatusBarPanel(snap, layout, state, ui);
  ui.tab.group = kDecisionTabs;
}

}  // namespace palace
