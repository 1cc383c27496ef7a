// Drawing primitives of the station on ImGui draw lists. Text is recorded in the item record as
// "text", so that tests can prove that no text leaves its panel or touches another.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <imgui.h>

#include "gui/widgets/style.h"
#include "gui/widgets/ui_frame.h"

namespace palace {

/// Draw list of the canvas, or of the overlay being drawn.
inline ImDrawList* Canvas() { return ImGui::GetWindowDrawList(); }

// ---- text -------------------------------------------------------------------------------------
enum class Align { kLeft, kRight, kCentre };

float TextWidth(const ImFont* font, std::string_view text);
/// Draws one line whose vertical middle is centre_y; x is its left edge, right edge or middle.
/// Returns its width in pixels.
float DrawText(UiFrame& ui, ImFont* font, ImU32 colour, float x, float centre_y,
               std::string_view text, Align align = Align::kLeft);
/// A value in Medium and its unit in caption and text 2, 4 px apart. Returns the width.
float DrawValueUnit(UiFrame& ui, ImFont* value_font, float x, float centre_y,
                    std::string_view value, std::string_view unit, Align align = Align::kLeft);
/// Lines no wider than `width`, broken at spaces.
std::vector<std::string> WrapText(const ImFont* font, std::string_view text, float width);
/// The same in `most` lines, at least one: where that is less than all, the last ends with "…", after
/// a whole clause where one fits.
std::vector<std::string> WrapText(const ImFont* font, std::string_view text, float width,
                                  std::size_t most);
/// The longest start of `text` made of whole words that fits; the text is never cut inside a word.
/// Of lists, whose start is whole without the rest.
std::string_view WholeWords(const ImFont* font, std::string_view text, float width);
/// The same with "…" after what was cut.
std::string FitWords(const ImFont* font, std::string_view text, float width);
/// The same, cut after a whole clause where one fits: half a sentence misleads.
std::string FitClauses(const ImFont* font, std::string_view text, float width);

// ---- shapes -----------------------------------------------------------------------------------
void FillRect(ImDrawList* dl, const Rect& rect, ImU32 colour, float rounding = 0);
void StrokeRect(ImDrawList* dl, const Rect& rect, ImU32 colour, float width = 1,
                float rounding = 0);
void DashedLine(ImDrawList* dl, ImVec2 a, ImVec2 b, ImU32 colour, float width, float on, float off);
void DashedPolyline(ImDrawList* dl, const std::vector<ImVec2>& points, ImU32 colour, float width,
                    float on, float off);
void DashedRect(ImDrawList* dl, const Rect& rect, ImU32 colour, float width, float on, float off);
/// 45-degree lines (rising to the right) over the rectangle, fixed in screen pixels.
void Hatch(ImDrawList* dl, const Rect& rect, ImU32 colour, float width, float spacing);
/// 45-degree stripes of two colours, `stripe` pixels wide each (measured across).
void Stripes(ImDrawList* dl, const Rect& rect, ImU32 a, ImU32 b, float stripe);
/// What an unknown rectangle looks like: never a colour of a map.
void UnknownFill(const Style& style, ImDrawList* dl, const Rect& rect);
/// What a picture that is too old looks like on top of itself.
void StaleVeil(const Style& style, ImDrawList* dl, const Rect& rect);

// ---- small parts --------------------------------------------------------------------------------
enum class Corner { kTopLeft, kTopRight, kBottomLeft, kBottomRight };
/// Dark plate for text over a picture, sized by its content. Returns its rectangle.
Rect PlateAt(const Style& style, ImDrawList* dl, const Rect& within, Corner corner, float width,
             float height);
/// One line of text on a plate in a corner of a picture, 8 units from its edges.
Rect TextPlate(UiFrame& ui, const Rect& within, Corner corner, std::string_view text);
/// Half the size of the plate below, px: of a square, or wider where "A2" needs it.
ImVec2 LetterPlateHalf(const Style& style, std::string_view letter, float side = 20);
/// Letter of a site on its 20-unit square plate; selected: white with a dark letter.
void LetterPlate(UiFrame& ui, ImVec2 centre, std::string_view letter, bool selected,
                 float side = 20);
/// The white PREVIEW chip, 84 x 24, its top left corner at `pos`.
/// Returns where it stands.
Rect PreviewChip(UiFrame& ui, ImVec2 pos, const char* words = "PREVIEW");
/// White focus ring, 2 px, 2 px outside.
void FocusRing(const Style& style, ImDrawList* dl, const Rect& rect);

}  // namespace palace
