// The track view: on a left picture, where each tracker has the site, with what it states to err,
// where it searches, and what they agree on. Drawn is what the snapshot holds of that very picture.
//
// A feature stands in brackets, dashed while it is LOST and only expected there. Where a tracker
// has the site is a dot in a circle of 3 sigma, dashed while coasted; one that drifts is tied to
// the consensus, a cross in its own circle, by a dashed line.
#pragma once

#include <string>

#include "engine/model/snapshot.h"
#include "gui/widgets/map/projection.h"

namespace palace {

/// "track_view" in the panel's head after its title.
void OfferTrackView(std::string_view title, const Rect& panel, bool& shown, UiFrame& ui);
/// Nothing of another picture, nor while no site is tracked.
void DrawTrackMarks(const EngineSnapshot& snap, const PictureView& view, UiFrame& ui);
/// Item "track_legend": the marks that are drawn, in a corner where it hides no letter; in a small
/// picture not at all. Call before the plate of the verdict, which then stands elsewhere.
void DrawTrackLegend(const EngineSnapshot& snap, const Rect& image, UiFrame& ui);
/// Coherences beside the features, after all else on the picture: where they would hide words they
/// are left out.
void DrawCoherences(const EngineSnapshot& snap, const PictureView& view, UiFrame& ui);
/// The fact at the lower right: who is in force, its coherence, what they agree on; or why nothing
/// is drawn. No wider than that.
inline float RoomForTrackFact(const Rect& image) { return 0.6f * image.w; }  // beside the scale
std::string TrackFact(const EngineSnapshot& snap, float width, const Style& style);

}  // namespace palace
