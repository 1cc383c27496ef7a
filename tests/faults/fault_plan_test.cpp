// Plans of faults: a file is read whole or refused with file, line, key, value and limit.
#include "engine/faults/fault_plan.h"

#include <gmock/gmock.h>

#include <string>

#include <gtest/gtest.h>

namespace palace {
namespace {

using testing::HasSubstr;

TEST(FaultPlan, TheExampleIsAPlanAndSaysItselfAgain) {
  const std::string file = PALACE_SOURCE_DIR "/config/faults/urban.toml";
  const Result<FaultPlan> plan = ReadFaultPlan(file, {"missing@GPS:12-"});
  ASSERT_TRUE(plan) << plan.error().message;
  ASSERT_GE(plan->faults.size(), 4u);
  EXPECT_EQ(plan->faults.back(),
            (Fault{.kind = FaultKind::kMissing, .channel = ChannelId::kGps, .from_s = 12}));
  const Result<FaultPlan> again = ParseFaultPlan(FaultPlanText(*plan), "again");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->faults, plan->faults);
}

TEST(FaultPlan, WithoutFileAndTextThereIsNone) {
  EXPECT_TRUE(ReadFaultPlan("", {}).value().faults.empty());
}

TEST(FaultPlan, HasAHundredFaultsAtMost) {
  const std::vector<std::string> many(kMostFaults, "missing@GPS");
  EXPECT_TRUE(ReadFaultPlan("", many));
  std::vector<std::string> more = many;
  more.push_back("missing@GPS");
  const auto refused = ReadFaultPlan("", more);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("101 faults; a flight has 100 at most"));
}

TEST(FaultPlan, NamesEveryFaultThatIsWrong) {
  const Result<FaultPlan> plan = ParseFaultPlan(
      "[[fault]]\nkind = \"gps\"\n[[fault]]\nkind = \"missing\"\n"
      "[[fault]]\nkind = \"gps_jump\"\nvalue = 1e9",
      "plan.toml");
  ASSERT_FALSE(plan);
  EXPECT_THAT(plan.error().message, HasSubstr("plan.toml:2: fault.kind"));
  EXPECT_THAT(plan.error().message, HasSubstr("\nplan.toml:7: fault.value"));
}

TEST(FaultPlan, OfACommandLineIsAMatterOfUsage) {
  EXPECT_EQ(ReadFaultPlan("missing.toml", {}).error().code, ErrorCode::kUsage);
  EXPECT_EQ(ReadFaultPlan("", {"gps"}).error().code, ErrorCode::kUsage);
  const std::string other = PALACE_SOURCE_DIR "/config/vehicles/r50.toml";
  EXPECT_EQ(ReadFaultPlan(other, {}).error().code, ErrorCode::kUsage);
  // A file to be checked is what is wrong itself.
  EXPECT_EQ(LoadFaultPlan(other).error().code, ErrorCode::kInvalid);
}

struct Bad {
  const char* text;
  const char* says;
};
class BadPlans : public testing::TestWithParam<Bad> {};

TEST_P(BadPlans, AreRefusedWithFileLineKeyAndLimit) {
  const Result<FaultPlan> plan = ParseFaultPlan(GetParam().text, "plan.toml");
  ASSERT_FALSE(plan) << GetParam().text;
  EXPECT_THAT(plan.error().message, HasSubstr("plan.toml"));
  EXPECT_THAT(plan.error().message, HasSubstr(GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadPlans,
    testing::Values(
        Bad{"", "no [[fault]]"}, Bad{"fault = 3", "plan.toml:1: fault is unknown"},
        Bad{"[[faults]]\nkind = \"missing\"", "plan.toml:1: faults is unknown"},
        Bad{"[[fault]]", "fault.kind is missing"},
        Bad{"[[fault]]\nkind = \"gps\"", "plan.toml:2: fault.kind = \"gps\" is no kind"},
        Bad{"[[fault]]\nkind = \"gps_jump\"\nvalue = 1e9",
            "plan.toml:3: fault.value = 1000000000 is outside -100000 .. 100000"},
        Bad{"[[fault]]\nkind = \"missing\"\nvalue = 3", "takes none"},
        Bad{"[[fault]]\nkind = \"gps_jump\"\nvalue = \"3\"", "plan.toml:3: fault.value"},
        Bad{"[[fault]]\nkind = \"camera_black\"\nchannel = \"GPS\"",
            "strikes one of CAMERA_LEFT, CAMERA_RIGHT"},
        Bad{"[[fault]]\nkind = \"gps_jump\"\nchannel = \"GPS\"", "takes none"},
        Bad{"[[fault]]\nkind = \"missing\"\nfrom_s = 9\nto_s = 3",
            "plan.toml:4: fault.to_s = 3 lies not after from_s = 9"},
        Bad{"[[fault]]\nkind = \"missing\"\nfrom_s = -1", "plan.toml:3: fault.from_s"},
        Bad{"[[fault]]\nkind = \"missing\"\nuntil = 3", "unknown key fault.until"},
        Bad{"[[fault]\n", "plan.toml:1"}),
    [](const auto& row) { return "Row" + std::to_string(row.index); });

}  // namespace
}  // namespace palace
