// Review: a recorded flight, what it decided, and what other limits would have decided.
//
// What the flight decided is read from its record alone. What other limits decide is what the
// engine judged under them (TerrainPart::redecided): map for map beside the flight's own limits, so
// that nothing differs where no limit was moved; what was not judged stays empty. Without a record
// (a foreign log, a flight still running) there is what was seen so far.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/flight_record.h"
#include "engine/model/snapshot.h"
#include "gui/panels/fly_state.h"
#include "gui/panels/review/loop_range.h"
#include "gui/panels/review/redecide_run.h"
#include "gui/panels/review/review_layout.h"
#include "gui/panels/review/run_in.h"
#include "gui/panels/terrain_views.h"
#include "gui/widgets/slider_row.h"
#include "gui/widgets/timeline_strip.h"

namespace palace {

/// A stretch of time in which the re-decided best site is another one.
struct ReviewDifference {
  double at_s = 0;
  double to_s = 0;
  std::string recorded;  ///< letter, empty: none
  std::string now;
};

/// The plots of Review: height, and clear radius of the best site; recorded and re-decided.
struct ReviewPlots {
  PlotView height, clear_radius;
};

/// Maps of the recorded flight, and how many of them were judged again under the reviewer's limits.
struct RedecidedShare {
  std::size_t judged = 0;
  std::size_t maps = 0;  ///< 0: the record tells of none
};

/// What is read out of the whole record and the whole replay so far, once a snapshot.
struct ReviewDigest {
  struct Key {
    std::uint64_t sequence = 0;
    std::shared_ptr<const std::vector<HistorySample>> history;
    std::shared_ptr<const std::vector<RedecidedSample>> redecided;
    const FlightRecord* record = nullptr;
    bool all_lanes = false;
    bool operator==(const Key&) const = default;
  };
  std::optional<Key> key;  ///< what it was read out of
  std::vector<ReviewDifference> differences;
  RedecidedShare redecided;
  TimelineView timeline;
  ReviewPlots plots;
  /// Cells of the re-decided map that bear the lander in one of the two maps only; empty without
  /// both.
  Grid<std::uint8_t> changed_cells;
};

struct ReviewState {
  OverlayCache overlay;
  SliderState fields;
  TimelineState timeline;
  PlotHover plots;
  MapProbe probe;
  RedecideRun redecide;
  LoopRange loop;
  RunIn run_in;
  ReviewDigest digest;
  ReviewPicture picture = ReviewPicture::kView3d;  ///< narrow windows
  bool track_view = false;                         ///< every tracker on the left picture
};

/// Seconds since the start of the flight.
double FlightSeconds(const EngineSnapshot& snap, const FlightRecord* record, Timestamp time);
/// Limits that the reviewer set otherwise than the flight had them at this time; 0 outside replays.
int LimitsMoved(const EngineSnapshot& snap);
/// "Recorded", or "As opened" for a log that tells no limits.
const char* FlightWord(const FlightRecord* record);
/// After a jump the flight's figures are those that its record tells: the maps here are rebuilt, of
/// fewer frames than it remembered, and differ from those it had.
bool IsOfRecordAlone(const EngineSnapshot& snap, const FlightRecord* record);
/// Where limits moved by the reviewer chose another best site, of what was judged under them.
std::vector<ReviewDifference> FindDifferences(const EngineSnapshot& snap,
                                              const FlightRecord* record);
RedecidedShare ShareRedecided(const EngineSnapshot& snap, const FlightRecord* record);
/// Lanes, silhouette and differences of the timeline. `all`: six lanes, else State and Differs.
TimelineView MakeTimeline(const EngineSnapshot& snap, const FlightRecord* record,
                          const std::vector<ReviewDifference>& differences, const Palette& palette,
                          bool all);
/// `kept`, read anew when the snapshot is another one.
const ReviewDigest& DigestOf(const EngineSnapshot& snap, const FlightRecord* record,
                             const Palette& palette, bool all, ReviewDigest& kept);

void DrawReviewWorkspace(const EngineSnapshot& snap, const FlightRecord* record, const Rect& body,
                         ReviewState& state, UiFrame& ui);

/// Appends what one of those who follow the replay asks for.
void Ask(UiFrame& ui, const Intents& intents);
void DrawReviewTimeline(const EngineSnapshot& snap, const FlightRecord* record, const Rect& rect,
                        ReviewState& state, UiFrame& ui);
ReviewPlots MakeReviewPlots(const EngineSnapshot& snap, const FlightRecord* record,
                            const Palette& palette);
void DrawReviewPlots(const ReviewPlots& plots, const Rect& rect, PlotHover& hover, UiFrame& ui);
Grid<std::uint8_t> ChangedCells(const EngineSnapshot& snap);
/// Seconds of the whole flight, or of what was replayed of it where nobody knows.
double DurationOf(const EngineSnapshot& snap, const FlightRecord* record);
/// Three square maps of side `w` from the left of `row`.
void DrawReviewMaps(const EngineSnapshot& snap, const ReviewDigest& digest, const Rect& row,
                    float w, MapProbe& probe, UiFrame& ui);
void DrawRedecidePanel(const EngineSnapshot& snap, const FlightRecord* record, const Rect& rect,
                       ReviewState& state, UiFrame& ui);
void DrawDecisionPanel(const EngineSnapshot& snap, const FlightRecord* record, const Rect& rect,
                       UiFrame& ui);
/// Why the list of differences is empty, and what to do.
std::string WhyNoDifference(const EngineSnapshot& snap, const RedecidedShare& redecided);
void DrawDifferencesPanel(const EngineSnapshot& snap, const Rect& rect, ReviewState& state,
                          UiFrame& ui);

}  // namespace palace
