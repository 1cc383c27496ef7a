// How an alarm looks and answers, in the strip and in the list below it.
#pragma once

#include <string>

#include "gui/panels/frame_bar.h"
#include "gui/widgets/icons.h"

namespace palace {

struct AlarmLook {
  Icon icon;
  ImU32 colour, fill;
  const char* word;
};
AlarmLook LookOf(const Palette& palette, AlarmLevel level);

/// Put aside by the operator, and standing as it stood then.
bool IsShelved(const FrameState& state, const Alarm& alarm);
/// A warning or caution that nobody acknowledged yet, whether it stands or is over.
bool WaitsForAnswer(const Alarm& alarm);
/// "Ended, worst 0.62 m: ", "In the flight: " and the text, with how often it came.
std::string AlarmWords(const Alarm& alarm, bool of_record);

/// The list below the strip: every alarm in full, with its own "acknowledge/gps_error".
void DrawAlarmList(const EngineSnapshot& snap, const FrameLayout& layout, FrameState& state,
                   UiFrame& ui);

}  // namespace palace
