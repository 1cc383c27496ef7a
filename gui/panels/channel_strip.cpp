#include "engine/model/channel_age.h"
#include "gui/panels/arrival.h"
#include "gui/panels/fly_panels.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/number_text.h"

namespace palace {

void DrawChannelStripPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  DrawPanelBackground(ui, rect, "Channels");
  if (snap.sensors->channels.empty()) {
    DrawText(ui, s.body, p.text2, rect.x + s.Px(12), rect.centre().y, "No channel heard yet.");
    return;
  }
  const float pitch = (rect.w - s.Px(24)) / static_cast<float>(snap.sensors->channels.size());
  float x = rect.x + s.Px(10);
  for (const ChannelHealth& published : snap.sensors->channels) {
    const ChannelHealth channel = After(published, ui.silent_s);
    using State = ChannelHealth::State;
    const Arrival arrival = ArrivalOf(snap, channel.id, ui.silent_s);
    const std::string& wrong = arrival.wrong.empty() ? arrival.lost : arrival.wrong;
    const bool fine = arrival.fine();
    Icon icon = Icon::kNormal;
    ImU32 colour = p.text3;
    if (channel.state == State::kNever) {
      icon = Icon::kOff;
    } else if (channel.state == State::kStale) {
      icon = Icon::kStale;
      colour = p.caution;
    } else if (!fine) {
      icon = Icon::kCaution;
      colour = p.caution;
    }
    const float first = rect.y + s.Px(23);
    const float second = rect.y + s.Px(46);
    DrawIcon(Canvas(), icon, {x + s.Px(8), first}, s.Px(12), colour);
    const float text_x = x + s.Px(22);
    ImFont* name_font = fine ? s.body : s.medium;
    ImFont* fact_font = fine ? s.caption : s.medium;
    const ImU32 ink = fine ? p.text2 : p.text1;
    DrawText(ui, name_font, ink, text_x, first,
             FitWords(name_font, ChannelName(channel.id), pitch - s.Px(26)));
    std::string facts = "never";
    if (channel.state == State::kFresh && !wrong.empty()) {
      facts = wrong;
    } else if (channel.state != State::kNever) {
      facts = AgeText(channel.age_s) + "   " +
              Fixed(channel.rate_hz, channel.rate_hz < 100 ? 1 : 0) + " Hz";
    }
    // A note that does not fit goes whole: half of "± 0.06 m" says nothing.
    const bool noted = channel.state != State::kNever && !channel.note.empty();
    const std::string noted_facts = noted ? facts + "   " + channel.note : facts;
    const float room = pitch - s.Px(26);
    const bool fits = TextWidth(fact_font, noted_facts) <= room;
    DrawText(ui, fact_font, ink, text_x, second,
             fits ? noted_facts : WholeWords(fact_font, facts, room));
    ui.items.Add(std::string("channel/") + ChannelName(channel.id), {x, rect.y, pitch, rect.h},
                 true, noted_facts);
    x += pitch;
  }
}

}  // namespace palace
