#include <algorithm>
#include <cmath>

#include "engine/model/mission/alarm_text.h"
#include "gui/panels/alarm_look.h"
#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"

namespace palace {

AlarmLook LookOf(const Palette& p, AlarmLevel level) {
  switch (level) {
    case AlarmLevel::kWarning:
      return {Icon::kWarning, p.warning, p.warning_fill, "WARNING"};
    case AlarmLevel::kCaution:
      return {Icon::kCaution, p.caution, p.caution_fill, "CAUTION"};
    case AlarmLevel::kAdvisory:
      break;
  }
  return {Icon::kAdvisory, p.advisory, p.advisory_fill, "ADVISORY"};
}

namespace {

bool IsSame(const ShelvedAlarm& shelved, const Alarm& alarm) {
  return alarm.active && alarm.kind == shelved.kind && alarm.level <= shelved.level &&
         alarm.since == shelved.since;
}

}  // namespace

bool IsShelved(const FrameState& state, const Alarm& alarm) {
  return std::any_of(state.shelved.begin(), state.shelved.end(),
                     [&](const ShelvedAlarm& shelved) { return IsSame(shelved, alarm); });
}

bool WaitsForAnswer(const Alarm& alarm) {
  return !alarm.acknowledged && alarm.level != AlarmLevel::kAdvisory;
}

std::string AlarmWords(const Alarm& alarm, bool of_record) {
  const std::string worst = alarm.worst.empty() ? "" : "worst " + alarm.worst;
  // Without a figure the words are of the newest; the ones before it may have had another cause.
  const bool is_last = !alarm.active && worst.empty() && alarm.count > 1;
  const std::string ended = is_last         ? "Ended, last of " + std::to_string(alarm.count) + ": "
                            : worst.empty() ? "Ended: "
                                            : "Ended, " + worst + ": ";
  // While it stands the worst is worth words only where it is not the figure that is told.
  const bool had_worse = alarm.active && !worst.empty() &&
                         AlarmSubject(alarm.text).find(alarm.worst) == std::string::npos;
  return (of_record ? "In the flight: " : "") +
         (alarm.active ? alarm.text : ended + AlarmFinding(alarm.text)) +
         (had_worse ? " At " + worst + "." : "") +
         (alarm.count > 1 && !is_last ? " ×" + std::to_string(alarm.count) : "");
}

namespace {

/// What ended, worsened or was raised anew is not what was shelved.
void ForgetEnded(const std::vector<Alarm>& alarms, FrameState& state) {
  std::erase_if(state.shelved, [&](const ShelvedAlarm& shelved) {
    return std::none_of(alarms.begin(), alarms.end(),
                        [&](const Alarm& alarm) { return IsSame(shelved, alarm); });
  });
}

/// Says how many are shelved, and brings them back; returns the left edge.
float DrawShelf(FrameState& state, float right, float y, UiFrame& ui) {
  const Style& s = ui.style;
  if (state.shelved.empty()) {
    return right;
  }
  ButtonLook look;
  look.flat = true;
  const std::string words = std::to_string(state.shelved.size()) + " shelved";
  const float width = TextWidth(s.body, words) + s.Px(24);
  const Rect button{right - s.Px(12) - width, y - s.Px(12), width, s.Px(24)};
  if (DrawButton(ui, "unshelve", button, words, look)) {
    state.shelved.clear();
  }
  return button.x + s.Px(12);
}

/// How many alarms there are, with the shape of the worst that stands or waits for an answer; where
/// the sentence beside it is the only one, `alone` in its place. Drawn right-aligned. Returns the
/// left edge.
float DrawCount(const std::vector<Alarm>& all, const char* alone, float right, float y,
                UiFrame& ui) {
  const Style& s = ui.style;
  const bool counts = all.size() > 1;
  float x = right - s.Px(27);
  x -= DrawText(ui, s.body, s.palette.text2, x, y, counts ? AlarmCountWords(all) : alone,
                Align::kRight);
  if (counts) {
    // What is over and waits for an answer counts too: it may still block an approval.
    AlarmLevel worst = all.front().level;
    for (const Alarm& alarm : all) {
      worst = WaitsForAnswer(alarm) ? std::max(worst, alarm.level) : worst;
    }
    const AlarmLook look = LookOf(s.palette, worst);
    x -= s.Px(16);
    DrawIcon(Canvas(), look.icon, {x, y}, s.Px(14), look.colour);
    x -= s.Px(6);
  }
  return x;
}

constexpr float kShelve = 72, kAcknowledge = 112;

/// Shelve of the first alarm, and Acknowledge of the first that waits for an answer: that may stand
/// behind one that needs none, and is named then. Both end where they always end, and nothing else
/// comes there while a caution or a warning is told: a pointer on its way meets what it was sent
/// for, or nothing. Returns the left edge. An alarm of a recorded flight is past answering.
float DrawAnswers(const std::vector<const Alarm*>& alarms, FrameState& state, const Rect& strip,
                  UiFrame& ui) {
  const Style& s = ui.style;
  const Alarm& first = *alarms.front();
  const float y = strip.centre().y, right = strip.right() - s.Px(20);
  ButtonLook look;
  look.flat = true;
  // What is over goes by its acknowledgement; there is nothing to put aside.
  const bool shelves = first.active && first.level != AlarmLevel::kAdvisory;
  const Rect shelve{right - s.Px(kShelve), y - s.Px(12), s.Px(kShelve), s.Px(24)};
  if (shelves && DrawButton(ui, "shelve", shelve, "Shelve", look)) {
    state.shelved.push_back({first.kind, first.level, first.since});
  }
  const auto waits = std::find_if(alarms.begin(), alarms.end(),
                                  [](const Alarm* alarm) { return WaitsForAnswer(*alarm); });
  if (waits == alarms.end()) {
    return shelve.x - s.Px(8 + kAcknowledge);
  }
  const Alarm& asked = **waits;
  constexpr float kMostNamed = 300;
  std::string words = "Acknowledge";
  if (&asked != &first) {
    words += ": " + FitWords(s.body, AlarmSubject(asked.text), s.Px(kMostNamed));
  }
  const float width = std::max(s.Px(kAcknowledge), TextWidth(s.body, words) + s.Px(24));
  const Rect acknowledge{shelve.x - s.Px(8) - width, y - s.Px(12), width, s.Px(24)};
  if (DrawButton(ui, "acknowledge", acknowledge, words, look)) {
    ui.intents.push_back(CommandAction(AcknowledgeAlarm{asked.id}));
  }
  if (&asked != &first && Interact(ui, "acknowledge", acknowledge, kPassive).hovered) {
    DrawTooltip(ui, asked.text);  // the button names it in a few words
  }
  return acknowledge.x;
}

/// An advisory asks for no answer.
bool AsksForAnswers(const std::vector<const Alarm*>& alarms) {
  return std::any_of(alarms.begin(), alarms.end(),
                     [](const Alarm* alarm) { return alarm->level != AlarmLevel::kAdvisory; });
}

/// Where the sentence of an alarm begins, from the strip's left edge.
float SentenceAt(const Style& s, const AlarmLook& look) {
  return s.Px(50) + TextWidth(s.medium, look.word);
}

/// Whole clauses, but where these would leave most of the room empty: then as many words as fit.
std::string FitSentence(const ImFont* font, const std::string& text, float room) {
  constexpr float kLeastFilled = 0.6F;
  const std::string clauses = FitClauses(font, text, room);
  return TextWidth(font, clauses) >= kLeastFilled * room ? clauses : FitWords(font, text, room);
}

/// True when the words had no room: what to do stands last in them.
bool DrawFirst(const Alarm& alarm, bool of_record, const Rect& rect, float text_right,
               UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const AlarmLook look = LookOf(p, alarm.level);
  const float y = rect.centre().y;
  const bool blink = alarm.level == AlarmLevel::kWarning && !alarm.acknowledged && alarm.active &&
                     std::fmod(ui.ui_time_s, 1.0) >= 0.5;
  if (!alarm.active) {
    StrokeRect(Canvas(), rect, look.colour, s.Fine(1));
  } else if (!blink) {
    FillRect(Canvas(), {rect.x, rect.y, s.Px(4), rect.h}, look.colour);
  }
  if (!blink) {
    DrawIcon(Canvas(), look.icon, {rect.x + s.Px(25), y}, s.Px(14), look.colour);
  }
  DrawText(ui, s.medium, p.text1, rect.x + s.Px(40), y, look.word);
  const float x = rect.x + SentenceAt(s, look);
  const std::string text = AlarmWords(alarm, of_record);
  const std::string shown = FitSentence(s.body, text, text_right - x - s.Px(16));
  DrawText(ui, s.body, p.text1, x, y, shown);
  return shown != text;
}

}  // namespace

void DrawAlarmStripPanel(const EngineSnapshot& snap, const Rect& rect, FrameState& state,
                         UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  ForgetEnded(snap.flight->mission.alarms, state);
  std::vector<const Alarm*> alarms;
  for (const Alarm& alarm : snap.flight->mission.alarms) {
    if (!IsShelved(state, alarm)) {
      alarms.push_back(&alarm);
    }
  }
  const bool quiet = alarms.empty();
  const bool filled = !quiet && !alarms.front()->acknowledged && alarms.front()->active;
  FillRect(Canvas(), rect, filled ? LookOf(p, alarms.front()->level).fill : p.panel);
  ui.items.Add("panel/Alarm strip", rect, true, "");
  const float y = rect.centre().y;
  if (quiet) {
    const bool shelved = !state.shelved.empty();
    const int stood = snap.flight->mission.alarms_in_record;
    const std::string words = shelved ? "No alarm but what is shelved"
                              : stood > 0
                                  ? "In the flight: " + std::to_string(stood) +
                                        (stood == 1 ? " alarm" : " alarms") + ", told in its events"
                                  : "No alarms";
    DrawShelf(state, rect.right(), y, ui);
    DrawIcon(Canvas(), shelved ? Icon::kOff : Icon::kNormal, {rect.x + s.Px(25), y}, s.Px(14),
             p.text3);
    DrawText(ui, s.medium, p.text1, rect.x + s.Px(40), y, words);
    ui.items.Add("alarm", rect, true, words);
    return;
  }
  const std::vector<Alarm>& all = snap.flight->mission.alarms;
  const bool of_record = FollowsRecord(snap.session->role);
  const Alarm& first = *alarms.front();
  float right = rect.right();
  if (!of_record && AsksForAnswers(alarms)) {
    right = DrawAnswers(alarms, state, rect, ui);
  }
  right = DrawShelf(state, right, y, ui);
  // That there is nothing worse is worth less than what there is.
  const char* none = "No cautions";
  const float wanted = SentenceAt(s, LookOf(p, first.level)) +
                       TextWidth(s.body, AlarmWords(first, of_record)) + s.Px(16);
  const bool fits = wanted + s.Px(27) + TextWidth(s.body, none) <= right - rect.x;
  if (first.level != AlarmLevel::kAdvisory || !state.shelved.empty() || !fits) {
    none = "";
  }
  const float count_right = right;
  right = DrawCount(all, none, right, y, ui);
  if (all.size() > 1 && Interact(ui, "alarm_count", {right, rect.y, count_right - right, rect.h},
                                 kNoTab, AlarmCountWords(all))
                            .clicked) {
    state.history_open = !state.history_open;
  }
  const bool cut = DrawFirst(*alarms.front(), of_record, rect, right, ui);
  const Rect words{rect.x, rect.y, right - rect.x, rect.h};
  const Interaction in = Interact(ui, "alarm", words, 0, alarms.front()->text);
  if (in.clicked) {
    state.history_open = !state.history_open;
  }
  if (in.hovered && cut && !state.history_open) {
    DrawTooltip(ui, AlarmWords(*alarms.front(), of_record));
  }
}

void DrawFrameOverlay(const EngineSnapshot& snap, const FrameLayout& layout, FrameState& state,
                      UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  if (FollowsRecord(snap.session->role)) {
    StrokeRect(Canvas(), layout.window, p.replay, s.Fine(4));
  }
  DrawAlarmList(snap, layout, state, ui);
}

}  // namespace palace
