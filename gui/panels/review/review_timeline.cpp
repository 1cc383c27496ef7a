// Timeline of Review: what the lanes hold, transport buttons.
#include <algorithm>
#include <cmath>

#include "gui/panels/review/review.h"
#include "gui/panels/session_words.h"
#include "gui/widgets/button.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

/// Samples farther apart have something between them that nobody saw or judged.
constexpr double kGap_s = 1;

std::string Letter(const std::string& letter) { return letter.empty() ? "none" : letter; }

/// Extends the last segment while the value stays, else starts the next.
void Append(std::vector<LaneSegment>& segments, double t, const std::string& text, int shade,
            bool dashed) {
  if (!segments.empty() && t - segments.back().to_s <= kGap_s) {
    segments.back().to_s = t;
    if (segments.back().text == text) {
      return;
    }
  }
  segments.push_back({t, t, text, shade, false, dashed});
}

int ShadeOf(MissionState state) {
  return state >= MissionState::kDescending ? 2 : (state >= MissionState::kArmed ? 1 : 0);
}

const std::vector<HistorySample>& HistoryOf(const EngineSnapshot& snap) {
  static const std::vector<HistorySample> none;
  return snap.flight->history ? *snap.flight->history : none;
}

const std::vector<RedecidedSample>& RedecidedOf(const EngineSnapshot& snap) {
  static const std::vector<RedecidedSample> none;
  return snap.terrain->redecided ? *snap.terrain->redecided : none;
}

Lane StateLane(const EngineSnapshot& snap, const FlightRecord* record) {
  Lane lane{"State", {}, {}};
  if (record != nullptr && !record->samples.empty()) {
    for (const FlightRecordSample& sample : record->samples) {
      Append(lane.segments, FlightSeconds(snap, record, sample.time),
             MissionStateWord(sample.state), ShadeOf(sample.state), false);
    }
  } else {
    for (const HistorySample& sample : HistoryOf(snap)) {
      Append(lane.segments, FlightSeconds(snap, record, sample.time),
             MissionStateWord(sample.state), ShadeOf(sample.state), false);
    }
  }
  return lane;
}

/// Best site of each sample, a stretch a letter.
template <typename Sample>
Lane SiteLane(const char* name, const EngineSnapshot& snap, const FlightRecord* record,
              const std::vector<Sample>& samples, std::string Sample::*letter) {
  Lane lane{name, {}, {}};
  for (const Sample& sample : samples) {
    Append(lane.segments, FlightSeconds(snap, record, sample.time), Letter(sample.*letter), 1,
           (sample.*letter).empty());
  }
  return lane;
}

/// What the flight chose: by its record; without one, as it was seen here.
Lane FlightLane(const EngineSnapshot& snap, const FlightRecord* record) {
  if (record != nullptr && !record->samples.empty()) {
    return SiteLane("Recorded site", snap, record, record->samples, &FlightRecordSample::best_site);
  }
  if (snap.terrain->redecided) {
    return SiteLane("Best site", snap, record, *snap.terrain->redecided,
                    &RedecidedSample::recorded);
  }
  return SiteLane("Best site", snap, record, HistoryOf(snap), &HistorySample::best_site);
}

const std::vector<Event>& EventsOf(const EngineSnapshot& snap, const FlightRecord* record) {
  static const std::vector<Event> none;
  if (record != nullptr && !record->events.empty()) {
    return record->events;
  }
  return snap.session->events ? *snap.session->events : none;
}

/// "GPS horizontal error 2.6 m": a mark has room for the first clause only, whole words.
std::string MarkWords(const std::string& text) {
  constexpr std::size_t kMost = 32;
  std::size_t stop = text.size();
  for (const char* end : {", ", ". ", ": "}) {
    stop = std::min(stop, text.find(end));
  }
  if (stop <= kMost) {
    return text.substr(0, stop);
  }
  return text.substr(0, text.rfind(' ', kMost));
}

Lane AlarmLane(const EngineSnapshot& snap, const FlightRecord* record, const Palette& p) {
  Lane lane{"Alarms", {}, {}};
  for (const Event& event : EventsOf(snap, record)) {
    if (event.kind == EventKind::kAlarm) {
      lane.marks.push_back({FlightSeconds(snap, record, event.time), Icon::kCaution, p.caution,
                            MarkWords(event.text)});
    }
  }
  return lane;
}

Lane MarkLane(const EngineSnapshot& snap, const FlightRecord* record, const Palette& p) {
  Lane lane{"Limits and marks", {}, {}};
  for (const Event& event : EventsOf(snap, record)) {
    const double t = FlightSeconds(snap, record, event.time);
    if (event.kind == EventKind::kSetting) {
      lane.marks.push_back({t, Icon::kScreen, p.text2, MarkWords(event.text)});
    } else if (event.kind == EventKind::kBookmark) {
      lane.marks.push_back({t, Icon::kFlag, p.text1, MarkWords(event.text)});
    } else if (event.kind == EventKind::kDecision) {
      lane.marks.push_back({t, Icon::kDone, p.text1, MarkWords(event.text)});
    }
  }
  return lane;
}

void Playback(UiFrame& ui, PlaybackControl::Kind kind, double value = 0) {
  ui.intents.push_back(PlaybackControl{kind, value});
}

double NextSpeed(double speed) {
  const double steps[] = {0.25, 0.5, 1, 2, 5, 20};
  for (const double step : steps) {
    if (speed > 0 && step > speed * 1.01) {
      return step;
    }
  }
  return speed > 0 ? 0 : steps[0];
}

bool IconButton(UiFrame& ui, const char* name, const Rect& rect, Icon icon, bool active,
                bool enabled, const char* why_not = "This source cannot jump in time") {
  const Style& s = ui.style;
  ButtonLook look;
  look.active = active;
  look.enabled = enabled;
  look.reason = why_not;
  const bool clicked = DrawButton(ui, name, rect, "", look);
  const ImU32 colour = !enabled ? s.palette.text3 : (active ? s.palette.on_white : s.palette.text1);
  DrawIcon(Canvas(), icon, rect.centre(), s.Px(20), colour);
  return clicked;
}

/// Of a log in which the vehicle restarted the part, and the way to the next; returns where it
/// ends.
float DrawPart(UiFrame& ui, const Rect& box, const SourceStatus& source) {
  if (source.parts <= 1) {
    return box.x;
  }
  const std::string words =
      "Part " + std::to_string(source.part) + " of " + std::to_string(source.parts);
  ButtonLook look;
  look.hint = "The vehicle's clock began anew, and with it a part of the log: opens the next";
  if (DrawButton(ui, "part", box, words, look)) {
    ui.intents.push_back(UiAction(
        NextFlight{NextFlight::Kind::kReview, source.name, source.part % source.parts + 1}));
  }
  return box.right() + ui.style.Px(8);
}

/// Draws the buttons; returns where they end.
float DrawTransport(UiFrame& ui, const Rect& row, const EngineSnapshot& snap, double duration_s) {
  using Kind = PlaybackControl::Kind;
  const Style& s = ui.style;
  const bool seek = snap.session->source.can_seek;
  const float y = std::round(row.centre().y - s.Px(16));
  float x = row.x;
  const auto next = [&](float width) {
    const Rect box{x, y, s.Px(width), s.Px(32)};
    x = box.right() + s.Px(8);
    return box;
  };
  if (IconButton(ui, "to_start", next(36), Icon::kStepBack, false, seek)) {
    Playback(ui, Kind::kSeek, 0);
  }
  if (IconButton(ui, "step_back", next(36), Icon::kFrameBack, false, seek)) {
    Playback(ui, Kind::kStepBack);
  }
  const bool can_pause = CanBePaused(snap), playing = IsPlaying(snap);
  constexpr const char* kAlive = "A live source cannot be paused";
  if (IconButton(ui, "play", next(36), playing ? Icon::kPause : Icon::kPlay, playing && can_pause,
                 can_pause, kAlive)) {
    Playback(ui, playing ? Kind::kPause : Kind::kPlay);
  }
  if (IconButton(ui, "step_forward", next(36), Icon::kFrameForward, false, can_pause, kAlive)) {
    Playback(ui, Kind::kStepForward);
  }
  if (IconButton(ui, "to_end", next(36), Icon::kStepForward, false, seek)) {
    Playback(ui, Kind::kSeek, duration_s);
  }
  x += s.Px(4);
  const std::string speed =
      snap.session->source.speed > 0
          ? Fixed(snap.session->source.speed, snap.session->source.speed < 1 ? 2 : 1) + "×"
          : std::string("Fastest");
  ButtonLook speed_look;
  speed_look.enabled = can_pause;
  speed_look.reason = kAlive;
  if (DrawButton(ui, "speed", next(68), speed, speed_look)) {
    Playback(ui, Kind::kSpeed, NextSpeed(snap.session->source.speed));
  }
  if (IconButton(ui, "bookmark", next(36), Icon::kFlag, false, snap.session->recording,
                 "Nothing is recorded here that a bookmark could be in")) {
    ui.intents.push_back(CommandAction(AddBookmark{}));
  }
  return DrawPart(ui, {x, y, s.Px(104), s.Px(32)}, snap.session->source);
}

void DrawClock(UiFrame& ui, const Rect& row, float x, const EngineSnapshot& snap,
               double duration_s) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const float middle = row.centre().y;
  x += s.Px(8);
  x += DrawText(ui, s.replay_time, p.text1, x, middle,
                TimeLabel(snap.session->source.position_s, true)) +
       s.Px(20);
  std::vector<std::pair<ImFont*, std::string>> facts;
  if (snap.session->source.can_seek && snap.session->source.duration_s) {
    facts.emplace_back(s.body, "of " + TimeLabel(duration_s, true));
  }
  if (snap.session->source.frame_count > 0) {
    facts.emplace_back(
        s.body, "Frame " + Fixed(static_cast<double>(snap.session->source.frame_index), 0) +
                    " of " + Fixed(static_cast<double>(snap.session->source.frame_count), 0));
  }
  facts.emplace_back(s.mono, ClockText(snap.time) + " " + ClockName(snap));
  const std::string name =
      snap.session->source.name.substr(snap.session->source.name.find_last_of('/') + 1);
  const float name_x = row.right() - TextWidth(s.body, name);
  for (const auto& [font, text] : facts) {
    const float width = TextWidth(font, text);
    if (x + width > row.right()) {
      return;
    }
    DrawText(ui, font, p.text2, x, middle, text);
    x += width + s.Px(28);
  }
  if (name_x > x) {
    DrawText(ui, s.body, p.text2, row.right(), middle, name, Align::kRight);
  }
}

}  // namespace

double FlightSeconds(const EngineSnapshot& snap, const FlightRecord* record, Timestamp time) {
  if (record != nullptr && record->start_s > 0) {
    return static_cast<double>(time.us) * 1e-6 - record->start_s;
  }
  return SecondsBetween(snap.session->source.start, time);
}

double DurationOf(const EngineSnapshot& snap, const FlightRecord* record) {
  // What cannot jump has no end that is known yet: a simulation's is only its limit.
  if (snap.session->source.can_seek && snap.session->source.duration_s) {
    return *snap.session->source.duration_s;
  }
  return record != nullptr && record->duration_s > 0 ? record->duration_s
                                                     : snap.session->source.position_s;
}

std::vector<ReviewDifference> FindDifferences(const EngineSnapshot& snap,
                                              const FlightRecord* record) {
  std::vector<ReviewDifference> found;
  bool open = false;
  for (const RedecidedSample& sample : RedecidedOf(snap)) {
    const double t = FlightSeconds(snap, record, sample.time);
    open = open && t - found.back().to_s <= kGap_s && found.back().recorded == sample.recorded &&
           found.back().now == sample.best_site;
    if (!sample.differs) {
      open = false;
    } else if (open) {
      found.back().to_s = t;
    } else {
      found.push_back({t, t, sample.recorded, sample.best_site});
      open = true;
    }
  }
  return found;
}

const ReviewDigest& DigestOf(const EngineSnapshot& snap, const FlightRecord* record,
                             const Palette& palette, bool all, ReviewDigest& kept) {
  const ReviewDigest::Key key{snap.sequence, snap.flight->history, snap.terrain->redecided, record,
                              all};
  if (kept.key != key) {
    kept.key = key;
    kept.differences = FindDifferences(snap, record);
    kept.timeline = MakeTimeline(snap, record, kept.differences, palette, all);
    kept.plots = MakeReviewPlots(snap, record, palette);
    kept.changed_cells = ChangedCells(snap);
  }
  return kept;
}

TimelineView MakeTimeline(const EngineSnapshot& snap, const FlightRecord* record,
                          const std::vector<ReviewDifference>& differences, const Palette& palette,
                          bool all) {
  TimelineView view;
  view.duration_s = DurationOf(snap, record);
  view.position_s = snap.session->source.position_s;
  view.can_seek = snap.session->source.can_seek;
  Lane differs{"Differs", {}, {}};
  for (const ReviewDifference& d : differences) {
    differs.segments.push_back({d.at_s, d.to_s, "", 0, true, false});
    view.differences_s.push_back(d.at_s);
  }
  for (const RecordGap& gap : record != nullptr ? record->gaps : std::vector<RecordGap>()) {
    view.gaps_s.emplace_back(gap.from_s, gap.to_s);
  }
  const bool log = FollowsRecord(snap.session->role);
  view.lanes.push_back(StateLane(snap, record));
  if (all || !log) {
    view.lanes.push_back(FlightLane(snap, record));
  }
  if (all && log) {
    view.lanes.push_back(
        SiteLane("Re-decided site", snap, record, RedecidedOf(snap), &RedecidedSample::best_site));
  }
  if (log) {
    view.lanes.push_back(std::move(differs));
  }
  if (all) {
    view.lanes.push_back(AlarmLane(snap, record, palette));
    view.lanes.push_back(MarkLane(snap, record, palette));
  }
  if (record != nullptr && !record->samples.empty()) {
    for (const FlightRecordSample& sample : record->samples) {
      view.height.push_back({static_cast<float>(FlightSeconds(snap, record, sample.time)),
                             static_cast<float>(sample.height_m)});
    }
  } else {
    for (const HistorySample& sample : HistoryOf(snap)) {
      view.height.push_back({static_cast<float>(FlightSeconds(snap, record, sample.time)),
                             static_cast<float>(sample.height_above_site_m)});
    }
  }
  return view;
}

void DrawReviewTimeline(const EngineSnapshot& snap, const TimelineView& view, const Rect& rect,
                        ReviewState& state, UiFrame& ui) {
  const Style& s = ui.style;
  DrawPanelBackground(ui, rect, "Timeline");
  const float pad = s.Px(12);
  const Rect row{rect.x + pad, rect.y, rect.w - 2 * pad, s.Px(48)};
  const float x = DrawTransport(ui, row, snap, view.duration_s);
  DrawClock(ui, row, x, snap, view.duration_s);
  DrawTimeline(ui, {row.x, row.bottom(), row.w, rect.bottom() - s.Px(6) - row.bottom()}, view,
               state.timeline);
}

}  // namespace palace
