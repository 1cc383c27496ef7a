// Alarms in few words: what one is about, and how many there are, wherever they are told.
#include "engine/model/mission/alarm_text.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

Alarm Of(AlarmLevel level, bool active = true, bool acknowledged = false) {
  Alarm alarm{AlarmId::kClock, level};
  alarm.active = active;
  alarm.acknowledged = acknowledged;
  return alarm;
}

TEST(AlarmSubject, IsWhatStandsBeforeLimitAndAdvice) {
  const std::pair<const char*, const char*> rows[] = {
      {"GPS horizontal error 2.6 m, limit 2.0 m. Landing on vision.", "GPS horizontal error 2.6 m"},
      {"Vehicle clock stepped ahead 2.0 s. What was selected is dropped.",
       "Vehicle clock stepped ahead 2.0 s"},
      {"A second sender is refused: udpm 3.", "A second sender is refused"},
      {"Attitude invalid.", "Attitude invalid"},
      {"", ""}};
  for (const auto& [text, subject] : rows) {
    EXPECT_EQ(AlarmSubject(text), subject);
  }
}

TEST(AlarmCount, CountsWhatStandsByLevelAnsweredOrNotAndWhatIsOverApart) {
  using Level = AlarmLevel;
  EXPECT_EQ(AlarmCountWords({}), "");
  EXPECT_EQ(AlarmCountWords({Of(Level::kCaution)}), "1 caution stands");
  EXPECT_EQ(AlarmCountWords({Of(Level::kWarning, false)}), "1 ended");
  EXPECT_EQ(AlarmFinding("Camera stale, 0.8 s, limit 0.5 s. Approve is blocked."),
            "Camera stale, 0.8 s, limit 0.5 s.");
  EXPECT_EQ(AlarmFinding("Camera stale"), "Camera stale");
  EXPECT_EQ(
      AlarmCountWords({Of(Level::kWarning), Of(Level::kCaution), Of(Level::kCaution, true, true),
                       Of(Level::kAdvisory), Of(Level::kWarning, false)}),
      "1 warning, 2 cautions, 1 advisory stand, 1 ended");
}

}  // namespace
}  // namespace palace
