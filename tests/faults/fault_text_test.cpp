// One text form of a fault, both ways, and the words that people read.
#include "engine/faults/fault_text.h"

#include <gmock/gmock.h>

#include <string>

#include <gtest/gtest.h>

#include "engine/core/random.h"

namespace palace {
namespace {

struct Form {
  const char* text;
  Fault fault;
  const char* words;
};

class Forms : public testing::TestWithParam<Form> {};

TEST_P(Forms, AreReadWrittenAndSaid) {
  const Result<Fault> fault = ParseFault(GetParam().text);
  ASSERT_TRUE(fault) << fault.error().message;
  EXPECT_EQ(*fault, GetParam().fault);
  EXPECT_EQ(FaultText(*fault), GetParam().text);
  EXPECT_EQ(FaultWords(*fault), GetParam().words);
}

using K = FaultKind;
using C = ChannelId;
INSTANTIATE_TEST_SUITE_P(
    Table, Forms,
    testing::Values(
        Form{"gps_jump=3:20-30", {K::kGpsJump, {}, 3, 20, 30}, "GPS jump 3 m"},
        Form{"missing@GPS:12-", {K::kMissing, C::kGps, NAN, 12}, "missing on GPS"},
        Form{"camera_black@CAMERA_LEFT:5-8",
             {K::kCameraBlack, C::kCameraLeft, NAN, 5, 8},
             "camera black on camera left"},
        Form{"attitude_nan", {K::kAttitudeNan}, "attitude not known"},
        Form{"camera_dirt", {K::kCameraDirt}, "camera dirt 10 % on both cameras"},
        Form{"missing", {K::kMissing}, "missing on every channel"},
        Form{"laser_spikes=-1e-05", {K::kLaserSpikes, {}, -1e-5}, "laser spikes -1e-05 m"},
        Form{"imu_gyro_bias=1.5:0.1-0.30000000000000004",
             {K::kImuGyroBias, {}, 1.5, 0.1, 0.1 + 0.2},
             "IMU gyro bias 1.5°/s"},
        Form{"lost=30@VEHICLE_POSE:1e-05-",
             {K::kLost, C::kVehiclePose, 30, 1e-5},
             "lost 30 % on vehicle pose"}),
    [](const auto& row) { return "Row" + std::to_string(row.index); });

TEST(FaultText, GivesEveryFaultBackToTheBit) {
  RandomStream random(11);
  for (int i = 0; i < 2000; ++i) {
    const FaultKindRow& row =
        FaultKindTable()[static_cast<std::size_t>(random.Index(static_cast<int>(kFaultKindCount)))];
    Fault fault{.kind = row.kind};
    if (!std::isnan(row.default_value) && random.Index(4) > 0) {
      fault.value = random.Uniform(row.least, row.most);
    }
    const std::vector<ChannelId> channels = ChannelsOf(row.kind);
    if (!channels.empty() && random.Index(2) > 0) {
      fault.channel =
          channels[static_cast<std::size_t>(random.Index(static_cast<int>(channels.size())))];
    }
    fault.from_s = random.Index(3) > 0 ? random.Uniform(0, 600) : 0;
    if (random.Index(2) > 0) {
      fault.to_s = fault.from_s + random.Uniform(1e-3, 600);
    }
    const Result<Fault> back = ParseFault(FaultText(fault));
    ASSERT_TRUE(back) << FaultText(fault) << ": " << back.error().message;
    EXPECT_EQ(*back, fault) << FaultText(fault);
  }
}

struct Mistake {
  const char* text;
  const char* why;
};
class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, AreUsageErrorsThatSayWhatMayStandThere) {
  const Result<Fault> fault = ParseFault(GetParam().text);
  ASSERT_FALSE(fault) << GetParam().text;
  EXPECT_EQ(fault.error().code, ErrorCode::kUsage);
  EXPECT_THAT(fault.error().message, testing::HasSubstr(GetParam().why));
}

INSTANTIATE_TEST_SUITE_P(
    Table, Mistakes,
    testing::Values(Mistake{"", "there is no kind"}, Mistake{"gps_jmp=3", "palacectl faults"},
                    Mistake{"gps_jump=", "no number"}, Mistake{"gps_jump=three", "no number"},
                    Mistake{"gps_jump=nan", "no number"}, Mistake{"gps_jump=3m", "no number"},
                    Mistake{"lost=300", "allowed 0 to 100 %"},
                    Mistake{"missing@gps", "CAMERA_LEFT"}, Mistake{"missing@", "no channel"},
                    Mistake{"gps_jump@GPS", "cannot strike"}, Mistake{"missing:", "from-to"},
                    Mistake{"missing:5", "from-to"}, Mistake{"missing:5-3", "after its beginning"},
                    Mistake{"missing:5-8x", "from-to"}, Mistake{"missing:-3", "from-to"},
                    Mistake{"missing:1-inf", "from-to"}, Mistake{"missing@GPS=3", "no channel"}),
    [](const auto& row) { return "Row" + std::to_string(row.index); });

}  // namespace
}  // namespace palace
