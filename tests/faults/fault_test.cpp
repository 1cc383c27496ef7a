#include "engine/faults/fault.h"

#include <gmock/gmock.h>

#include <set>

#include <gtest/gtest.h>

namespace palace {
namespace {

TEST(FaultTable, NamesEveryKindOnceInItsOrder) {
  std::set<std::string> names;
  ASSERT_EQ(FaultKindTable().size(), kFaultKindCount);
  for (std::size_t i = 0; i < kFaultKindCount; ++i) {
    const FaultKindRow& row = FaultKindTable()[i];
    EXPECT_EQ(static_cast<std::size_t>(row.kind), i) << row.name;
    names.insert(row.name);
    EXPECT_EQ(std::isnan(row.default_value), *row.unit == '\0') << row.name;
    EXPECT_TRUE(CheckFault({.kind = row.kind})) << row.name;
  }
  EXPECT_EQ(names.size(), kFaultKindCount);
}

struct Refused {
  const char* name;
  Fault fault;
  const char* why;
};

class RefusedFaults : public testing::TestWithParam<Refused> {};

TEST_P(RefusedFaults, AreRefusedWithTheLimit) {
  const Status status = CheckFault(GetParam().fault);
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message, testing::HasSubstr(GetParam().why));
}

INSTANTIATE_TEST_SUITE_P(
    Table, RefusedFaults,
    testing::Values(
        Refused{"Share", {.kind = FaultKind::kLost, .value = 130}, "allowed 0 to 100 %"},
        Refused{"NoValue", {.kind = FaultKind::kCameraBlack, .value = 3}, "takes no value"},
        Refused{"Channel",
                {.kind = FaultKind::kCameraFrozen, .channel = ChannelId::kGps},
                "cannot strike GPS"},
        Refused{"OwnChannel",
                {.kind = FaultKind::kMissing, .channel = ChannelId::kPositionEstimate},
                "cannot strike"},
        Refused{"Interval", {.from_s = 4, .to_s = 4}, "4.000 s to 4.000 s"},
        Refused{"Before", {.from_s = -1}, "begin at 0 s"}),
    [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace palace
