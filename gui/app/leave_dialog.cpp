#include "gui/app/leave_dialog.h"

#include <algorithm>

#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"

namespace palace {

LeaveAnswer DrawLeaveDialog(const Rect& body, const std::string& what_the_vehicle_does,
                            UiFrame& ui) {
  const Style& s = ui.style;
  const float width = std::min(s.Px(560), body.w);
  const auto lines = WrapText(s.body, what_the_vehicle_does, width - s.Px(40));
  const float height = s.Px(132) + s.Px(20) * static_cast<float>(lines.size());
  const Rect box{body.centre().x - width / 2, body.centre().y - height / 2, width, height};
  BeginOverlay("##leave", box);
  ImDrawList* dl = Canvas();
  FillRect(dl, box, s.palette.control, s.Fine(4));
  StrokeRect(dl, box, s.palette.white_mark, 2, s.Fine(4));
  const float x = box.x + s.Px(20);
  DrawText(ui, s.section, s.palette.text1, x, box.y + s.Px(28), "Leave a vehicle in the air?");
  float y = box.y + s.Px(60);
  for (const std::string& line : lines) {
    DrawText(ui, s.body, s.palette.text1, x, y, line);
    y += s.Px(20);
  }
  const float gap = s.Px(12), each = (width - s.Px(40) - 2 * gap) / 3;
  const auto button = [&](int place) {
    return Rect{x + static_cast<float>(place) * (each + gap), box.bottom() - s.Px(48), each,
                s.Px(32)};
  };
  // None looks like the one that Enter presses: nothing is pressed by a key that was meant for the
  // flight.
  const bool waves_off = DrawButton(ui, "leave/wave_off", button(0), "Wave off, then stay");
  if (waves_off) {
    ui.intents.push_back(CommandAction(WaveOff{}));
  }
  const bool stays = DrawButton(ui, "leave/stay", button(1), "Stay") || waves_off;
  const bool leaves = DrawButton(ui, "leave/leave", button(2), "Leave all the same");
  EndOverlay();
  ui.items.Add("leave", box, true, what_the_vehicle_does);
  return leaves ? LeaveAnswer::kLeave : stays ? LeaveAnswer::kStay : LeaveAnswer::kNone;
}

}  // namespace palace
