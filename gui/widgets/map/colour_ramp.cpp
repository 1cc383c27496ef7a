#include "gui/widgets/map/colour_ramp.h"

namespace palace {

const std::vector<ImU32>& RampStops(Ramp ramp) {
  static const std::vector<ImU32> stops[] = {
      {Rgb(0x440154), Rgb(0x482878), Rgb(0x3E4989), Rgb(0x31688E), Rgb(0x26828E), Rgb(0x1F9E89),
       Rgb(0x35B779), Rgb(0x6ECE58), Rgb(0xB5DE2B), Rgb(0xFDE725)},
      {Rgb(0x00224E), Rgb(0x123570), Rgb(0x3B496C), Rgb(0x575D6D), Rgb(0x707173), Rgb(0x8A8678),
       Rgb(0xA59C74), Rgb(0xC3B369), Rgb(0xE1CC55), Rgb(0xFEE838)},
      {Rgb(0x000004), Rgb(0x180F3D), Rgb(0x440F76), Rgb(0x721F81), Rgb(0x9E2F7F), Rgb(0xCD4071),
       Rgb(0xF1605D), Rgb(0xFD9668), Rgb(0xFECA8D), Rgb(0xFCFDBF)},
      {Rgb(0x000004), Rgb(0x1B0C41), Rgb(0x4A0C6B), Rgb(0x781C6D), Rgb(0xA52C60), Rgb(0xCF4446),
       Rgb(0xED6925), Rgb(0xFB9B06), Rgb(0xF7D13D), Rgb(0xFCFFA4)},
      {Rgb(0xDCE9F7), Rgb(0x9CC3EA), Rgb(0x5B97D6), Rgb(0x2F67AE), Rgb(0x173D7A), Rgb(0x0A2250)}};
  return stops[static_cast<int>(ramp)];
}

void DrawRampBar(ImDrawList* dl, const Rect& r, Ramp ramp) {
  const std::vector<ImU32>& stops = RampStops(ramp);
  const float part = r.w / static_cast<float>(stops.size() - 1);
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const float x = r.x + part * static_cast<float>(i);
    dl->AddRectFilledMultiColor({x, r.y}, {x + part, r.bottom()}, stops[i], stops[i + 1],
                                stops[i + 1], stops[i]);
  }
}

}  // namespace palace
