// What may be done in a session, role by role.
#include "engine/model/mission/session_role.h"

#include <string>

#include <gtest/gtest.h>

namespace palace {
namespace {

struct Row {
  SourceKind kind;
  bool jumped;
  const char* may;  ///< select, sign, send, follow a record, start anew after a jump
  const char* why;
  bool pictures_only;
};

TEST(SessionRole, AnswersForEverySource) {
  const Row rows[] = {
      {SourceKind::kNone, false, "--S--", "No data", false},
      {SourceKind::kLive, false, "sgS--", "", false},
      {SourceKind::kSimulation, false, "sgS--", "", false},
      {SourceKind::kReplay, false, "---ra", "No link in replay", false},
      {SourceKind::kReplay, true, "---ra", "No link in replay", false},
      {SourceKind::kImages, false, "----a", "No vehicle, pictures only", true},
      {SourceKind::kCameras, false, "----a", "No vehicle, cameras only", true},
      {SourceKind::kVideo, false, "----a", "No vehicle in a video", true},
  };
  for (const Row& row : rows) {
    const SessionRole role = RoleOf(row.kind, row.jumped);
    std::string may = "-----";
    may[0] = MaySelect(role) ? 's' : '-';
    may[1] = MaySign(role) ? 'g' : '-';
    may[2] = MaySend(role) ? 'S' : '-';
    may[3] = FollowsRecord(role) ? 'r' : '-';
    may[4] = StartsAnewAfterJump(role) ? 'a' : '-';
    EXPECT_EQ(may, row.may) << static_cast<int>(row.kind);
    EXPECT_STREQ(WhyNoVehicle(row.kind), row.why);
    EXPECT_EQ(HasPicturesOnly(role), row.pictures_only);
    EXPECT_EQ(SeenFromStart(role), !row.jumped);
    EXPECT_TRUE(MaySelect(role) == (*row.why == '\0')) << row.why;
  }
}

// A jump is a matter of records alone: live time that leaps is still live.
TEST(SessionRole, OnlyAReplayJumps) {
  EXPECT_EQ(RoleOf(SourceKind::kLive, true), SessionRole::kLive);
  EXPECT_EQ(RoleOf(SourceKind::kSimulation, true), SessionRole::kSimulated);
  EXPECT_EQ(RoleOf(SourceKind::kReplay, true), SessionRole::kReplayedAfterJump);
}

}  // namespace
}  // namespace palace
