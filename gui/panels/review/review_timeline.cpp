// Timeline of Review: what the lanes hold.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "engine/core/frames.h"
#include "gui/panels/alarm_look.h"
#include "gui/panels/review/review.h"

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

/// The site of each moment of the flight: the one selected or flown to, before that the best.
Lane RecordedLane(const EngineSnapshot& snap, const FlightRecord& record) {
  Lane lane{"Recorded site", {}, {}};
  for (const FlightRecordSample& sample : record.samples) {
    const LandingSite* chosen = record.ArmedAt(sample);
    const std::string& letter = chosen != nullptr ? chosen->letter : sample.best_site;
    Append(lane.segments, FlightSeconds(snap, &record, sample.time), Letter(letter),
           chosen != nullptr ? 2 : 1, letter.empty());
  }
  return lane;
}

/// What the flight chose: by its record; without one, as it was seen here.
Lane FlightLane(const EngineSnapshot& snap, const FlightRecord* record) {
  if (record != nullptr && !record->samples.empty()) {
    return RecordedLane(snap, *record);
  }
  if (snap.terrain->redecided) {
    return SiteLane("Best site", snap, record, *snap.terrain->redecided,
                    &RedecidedSample::recorded);
  }
  return SiteLane("Best site", snap, record, HistoryOf(snap), &HistorySample::best_site);
}

/// Broken where nothing was sampled.
template <typename Sample, typename Height>
std::vector<ImVec2> SilhouetteOf(const EngineSnapshot& snap, const FlightRecord* record,
                                 const std::vector<Sample>& samples, Height height) {
  std::vector<ImVec2> points;
  for (const Sample& sample : samples) {
    const auto t = static_cast<float>(FlightSeconds(snap, record, sample.time));
    if (!points.empty() && static_cast<double>(t - points.back().x) > kGap_s) {
      points.push_back({t, NAN});
    }
    points.push_back({t, static_cast<float>(height(sample))});
  }
  return points;
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
    if (event.kind != EventKind::kAlarm) {
      continue;
    }
    // Without a level: an answer to an alarm, or a note on the record.
    LaneMark mark{FlightSeconds(snap, record, event.time), Icon::kNormal, p.text2,
                  MarkWords(event.text), event.text};
    if (event.level) {
      const AlarmLook look = LookOf(p, *event.level);
      mark.icon = look.icon;
      mark.colour = look.colour;
      mark.hint = std::string(look.word) + " " + event.text;
      mark.weight = 1 + static_cast<int>(*event.level);
    }
    lane.marks.push_back(std::move(mark));
  }
  return lane;
}

/// "GPS jump 3 m ended": what a mark says of a fault.
std::string FaultWords(const std::string& text) {
  const std::string_view began = kFaultBegan, ended = kFaultEnded;
  if (text.starts_with(began)) {
    return MarkWords(text.substr(began.size()));
  }
  return text.starts_with(ended) ? MarkWords(text.substr(ended.size())) + " ended" : text;
}

/// Why it began; empty of any other event.
std::string WhyWavedOff(const Event& event) {
  const std::string entered = std::string(MissionStateName(MissionState::kAborting)) + ": ";
  return event.kind == EventKind::kState && event.text.starts_with(entered)
             ? event.text.substr(entered.size())
             : std::string();
}

Lane MarkLane(const EngineSnapshot& snap, const FlightRecord* record, const Palette& p) {
  Lane lane{"Limits and marks", {}, {}};
  for (const Event& event : EventsOf(snap, record)) {
    const double t = FlightSeconds(snap, record, event.time);
    if (event.kind == EventKind::kSetting) {
      lane.marks.push_back({t, Icon::kScreen, p.text2, MarkWords(event.text), event.text});
    } else if (event.kind == EventKind::kBookmark) {
      lane.marks.push_back({t, Icon::kFlag, p.text1, MarkWords(event.text), event.text});
    } else if (event.kind == EventKind::kFault) {
      lane.marks.push_back({t, Icon::kFlag, p.text1, FaultWords(event.text), event.text});
    } else if (event.kind == EventKind::kDecision) {
      lane.marks.push_back({t, Icon::kDone, p.text1, MarkWords(event.text), event.text});
    } else if (const std::string why = WhyWavedOff(event); !why.empty()) {
      lane.marks.push_back({t, Icon::kFlag, p.text1, "Wave-off", "Wave-off: " + why, 1});
    }
  }
  return lane;
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

RedecidedShare ShareRedecided(const EngineSnapshot& snap, const FlightRecord* record) {
  const std::vector<RedecidedSample>& redecided = RedecidedOf(snap);
  if (record == nullptr || record->proposals.empty()) {
    return {redecided.size(), 0};
  }
  RedecidedShare share;
  Timestamp last{-1};
  for (const RecordedProposal& proposal : record->proposals) {
    if (proposal.map_time == last) {
      continue;  // a limit that moved in the flight judged the same map again
    }
    last = proposal.map_time;
    ++share.maps;
    const auto at =
        std::lower_bound(redecided.begin(), redecided.end(), last,
                         [](const RedecidedSample& s, Timestamp time) { return s.time < time; });
    share.judged += at != redecided.end() && at->time == last ? 1U : 0U;
  }
  return share;
}

const ReviewDigest& DigestOf(const EngineSnapshot& snap, const FlightRecord* record,
                             const Palette& palette, bool all, ReviewDigest& kept) {
  const ReviewDigest::Key key{snap.sequence, snap.flight->history, snap.terrain->redecided, record,
                              all};
  if (kept.key != key) {
    kept.key = key;
    kept.differences = FindDifferences(snap, record);
    kept.redecided = ShareRedecided(snap, record);
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
  // Where two lanes have room, what happened has the second while nothing can differ.
  if (log && (all || LimitsMoved(snap) > 0)) {
    view.lanes.push_back(std::move(differs));
  }
  Lane alarms = AlarmLane(snap, record, palette), marks = MarkLane(snap, record, palette);
  if (all) {
    view.lanes.push_back(std::move(alarms));
    view.lanes.push_back(std::move(marks));
  } else {
    // One lane for both, the last: a low window drops it.
    alarms.name = "Alarms and marks";
    alarms.marks.insert(alarms.marks.end(), marks.marks.begin(), marks.marks.end());
    view.lanes.push_back(std::move(alarms));
  }
  // Above the origin, for it is known with a site and without.
  view.height = record != nullptr && !record->samples.empty()
                    ? SilhouetteOf(snap, record, record->samples,
                                   [](const FlightRecordSample& sample) { return sample.height_m; })
                    : SilhouetteOf(snap, record, HistoryOf(snap), [](const HistorySample& sample) {
                        return HeightFromDown(sample.estimate_p_WB.z());
                      });
  return view;
}

}  // namespace palace
