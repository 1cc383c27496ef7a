// Marks of landing sites on pictures and maps: ring to scale, letters, dashed ghosts.
#pragma once

#include <string_view>
#include <vector>

#include "engine/model/mission/mission_status.h"
#include "gui/widgets/draw.h"

namespace palace {

enum class RingKind { kProposed, kCommanded, kGhost };

/// How the letter of a site that is not the selected one looks.
struct LetterLook {
  bool highlighted = false;
  bool refused = false;  ///< struck through
  float radius = 11;
};

/// Ring along projected points (white 2 px on black 4 px) with a cross at its centre. A ghost is
/// dashed and has no cross.
void DrawRing(const Style& style, ImDrawList* dl, const std::vector<ImVec2>& ring, ImVec2 centre,
              RingKind kind);
/// The same for a map seen from above.
void DrawRing(const Style& style, ImDrawList* dl, ImVec2 centre, float radius, RingKind kind);
/// Half the width of the mark of `letter`, px: of a disc, or of the wider one that "A2" needs.
float LetterHalfWidth(const Style& style, std::string_view letter, float radius);
/// Black disc with white rim and letter: a site that is not the selected one.
void DrawLetterDisc(UiFrame& ui, ImVec2 centre, std::string_view letter, const LetterLook& look);
/// The letter of a site as a control, before what lies below it: true when it is clicked. Hovered
/// it says what a click does, or why it does nothing. `where`: "picture", "map/slope".
struct LetterAnswer {
  bool hovered = false;
  bool clicked = false;
};
LetterAnswer OfferLetter(UiFrame& ui, std::string_view where, ImVec2 centre,
                         const LandingSite& site, const MissionStatus& mission);
/// Corner brackets of a tracked feature, 20 x 20 units.
void DrawBrackets(const Style& style, ImDrawList* dl, ImVec2 centre, ImU32 colour);
/// 1 px white square on 3 px black: a search window.
void DrawSearchWindow(const Style& style, ImDrawList* dl, ImVec2 centre, float side);
/// Scale bar on its plate at the bottom left: a round length of at most a quarter of the picture.
void DrawScaleBar(UiFrame& ui, const Rect& image, float pixels_per_metre);

}  // namespace palace
