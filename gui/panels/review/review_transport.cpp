// Timeline of Review: transport buttons, the way out, the clock, and the strip below them.
#include <cmath>
#include <filesystem>

#include "gui/panels/review/review.h"
#include "gui/panels/session_words.h"
#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

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
                bool enabled, const char* why_not = "This source cannot jump in time",
                const char* hint = "") {
  const Style& s = ui.style;
  ButtonLook look;
  look.active = active;
  look.enabled = enabled;
  look.reason = why_not;
  look.hint = hint;
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

/// Out of the review; returns where it ends.
float DrawWayOut(UiFrame& ui, float x, float y, const EngineSnapshot& snap) {
  if (!FollowsRecord(snap.session->role) || ui.after_review.label.empty()) {
    return x;
  }
  const Style& s = ui.style;
  const Rect box{x, y, TextWidth(s.body, ui.after_review.label) + s.Px(32), s.Px(32)};
  ButtonLook look;
  look.hint = ui.after_review.hint;
  if (DrawButton(ui, "end_review", box, ui.after_review.label, look)) {
    ui.intents.push_back(UiAction(NextFlight{NextFlight::Kind::kFlyAgain}));
  }
  return box.right() + s.Px(8);
}

/// Draws the buttons; returns where they end.
float DrawTransport(UiFrame& ui, const Rect& row, const EngineSnapshot& snap, double duration_s,
                    const LoopRange& loop) {
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
  if (IconButton(ui, "loop_on", next(36), Icon::kLoop, loop.on(), seek,
                 "This source cannot jump in time",
                 "Plays a stretch again and again; I and O set its ends, L turns it on or off")) {
    ui.intents.push_back(UiAction(ToggleLoop{}));
  }
  if (IconButton(ui, "bookmark", next(36), Icon::kFlag, false, snap.session->recording,
                 "Nothing is recorded here that a bookmark could be in")) {
    ui.intents.push_back(CommandAction(AddBookmark{}));
  }
  x = DrawPart(ui, {x, y, s.Px(104), s.Px(32)}, snap.session->source);
  return DrawWayOut(ui, x, y, snap);
}

/// "1.9 GB", "6.4 MB".
std::string FileSize(std::uint64_t bytes) {
  const double mb = static_cast<double>(bytes) * 1e-6;
  return mb < 1000 ? Fixed(mb, 1) + " MB" : Fixed(mb / 1000, 1) + " GB";
}

/// What the log is, the most telling last: where room is short the first go.
std::vector<std::string> LogWords(const SourceStatus& source, const FlightRecord* record) {
  const std::filesystem::path path(source.name);
  std::vector<std::string> words = {(path.parent_path().filename() / path.filename()).string()};
  if (record != nullptr && record->file_bytes > 0) {
    words.push_back(FileSize(record->file_bytes));
  }
  if (record != nullptr) {
    const std::size_t gaps = record->gaps.size();
    words.push_back((source.damage.empty() ? "whole" : "damaged") +
                    (gaps == 0   ? std::string()
                     : gaps == 1 ? ", 1 gap"
                                 : ", " + std::to_string(gaps) + " gaps"));
  }
  return words;
}

/// Right-aligned; returns where what lies left of it ends. Of a log that is damaged (`damage`: what
/// is wrong) it is a caution.
float DrawLogWord(UiFrame& ui, const Rect& row, float right, const std::string& word,
                  const std::string& damage) {
  const Style& s = ui.style;
  const float width = TextWidth(s.body, word) + (damage.empty() ? 0 : s.Px(20));
  const Rect box{right - width, row.y, width, row.h};
  DrawText(ui, s.body, damage.empty() ? s.palette.text2 : s.palette.text1, right, row.centre().y,
           word, Align::kRight);
  if (!damage.empty()) {
    DrawIcon(Canvas(), Icon::kCaution, {box.x + s.Px(7), row.centre().y}, s.Px(12),
             s.palette.caution);
    if (Interact(ui, "log_damage", box, kPassive).hovered) {
      DrawTooltip(ui, damage, &box);
    }
  }
  return box.x - s.Px(16);
}

void DrawClock(UiFrame& ui, const Rect& row, float x, const EngineSnapshot& snap, double duration_s,
               const FlightRecord* record) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const float middle = row.centre().y;
  x += s.Px(8);
  x += DrawText(ui, s.replay_time, p.text1, x, middle,
                TimeLabel(snap.session->source.position_s, true)) +
       s.Px(20);
  std::vector<std::string> words = LogWords(snap.session->source, record);
  float right = row.right();
  if (record != nullptr) {
    right = DrawLogWord(ui, row, right, words.back(), snap.session->source.damage);
    words.pop_back();
  }
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
  for (const auto& [font, text] : facts) {
    const float width = TextWidth(font, text);
    if (x + width > right) {
      return;
    }
    DrawText(ui, font, p.text2, x, middle, text);
    x += width + s.Px(28);
  }
  while (!words.empty() && right - TextWidth(s.body, words.back()) > x) {
    right = DrawLogWord(ui, row, right, words.back(), {});
    words.pop_back();
  }
}

}  // namespace

void DrawReviewTimeline(const EngineSnapshot& snap, const FlightRecord* record, const Rect& rect,
                        ReviewState& state, UiFrame& ui) {
  const TimelineView& view = state.digest.timeline;
  const Style& s = ui.style;
  DrawPanelBackground(ui, rect, "Timeline");
  const float pad = s.Px(12);
  const Rect row{rect.x + pad, rect.y, rect.w - 2 * pad, s.Px(48)};
  state.timeline.loop_s = state.loop.Shown(view.duration_s);
  state.timeline.loops = state.loop.on();
  const float x = DrawTransport(ui, row, snap, view.duration_s, state.loop);
  DrawClock(ui, row, x, snap, view.duration_s, record);
  DrawTimeline(ui, {row.x, row.bottom(), row.w, rect.bottom() - s.Px(6) - row.bottom()}, view,
               state.timeline);
}

}  // namespace palace
