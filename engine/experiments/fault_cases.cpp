#include "engine/experiments/fault_cases.h"

#include <algorithm>
#include <array>

namespace palace {
namespace {

using A = AlarmId;
using C = ChannelId;
using K = FaultKind;

constexpr auto kLeft = C::kCameraLeft, kRight = C::kCameraRight;

std::vector<FaultCase> CameraCases() {
  const std::vector<A> frozen = {A::kCameraFrozen};
  const std::vector<A> dark = {A::kCameraBlank, A::kExposure};
  const auto on = [](K kind, std::optional<C> camera = {}, double value = NAN) {
    return std::vector<Fault>{{kind, camera, value}};
  };
  std::vector<FaultCase> cases = {
      {"both cameras frozen", "F01", on(K::kCameraFrozen), frozen},
      {"left camera frozen", "F01", on(K::kCameraFrozen, kLeft), frozen},
      {"right camera frozen", "F01", on(K::kCameraFrozen, kRight), frozen},
      {"both frozen but one pixel", "F01", on(K::kCameraFrozenPixel), frozen},
      // Behind noise only motion tells: the ground must shift by 12 px.
      {"both frozen with 1 grey level of noise", "F01", on(K::kCameraFrozenNoise), frozen, 4},
      {"left camera black", "F02", on(K::kCameraBlack, kLeft), dark},
      {"right camera black", "F02", on(K::kCameraBlack, kRight), dark},
      {"both cameras black", "F02", on(K::kCameraBlack), dark},
      {"right camera dark with noise", "F02", on(K::kCameraDark, kRight), dark},
      {"both cameras overexposed", "F02", on(K::kCameraOverexposed), dark},
      {"cameras swapped", "F04", on(K::kCamerasSwapped), {A::kCamerasSwapped}},
      {"left camera missing", "F05", on(K::kMissing, kLeft), {A::kCameraLeft}},
      {"right camera missing", "F05", on(K::kMissing, kRight), {A::kCameraRight}},
      {"left camera late by 0.3 s", "F03", on(K::kCameraLate, kLeft, 0.3), {A::kImageTime}, 2},
      {"right camera late by 0.3 s", "F03", on(K::kCameraLate, kRight, 0.3), {A::kImageTime}, 2},
      {"left camera repeats 30 % of its pictures",
       "F05",
       on(K::kCameraRepeated, kLeft, 30),
       {A::kImageTime, A::kCameraFrozen},
       5,
       true,
       DescentMust::kEither},
      // What is covered or washed out is unknown ground; the rest is as good as ever.
      {"dirt on 10 % of the left lens",
       "F02",
       on(K::kCameraDirt, kLeft, 10),
       {},
       1,
       false,
       DescentMust::kLand,
       true,
       true},
      {"glare of 120 grey levels",
       "F02",
       on(K::kCameraGlare, {}, 120),
       {A::kExposure},
       1,
       false,
       DescentMust::kLand,
       true,
       true},
      {"both cameras late by 0.1 s", "F06", on(K::kCameraLate, {}, 0.1), {A::kImageTime}, 2},
      {"both cameras late by 0.3 s", "F06", on(K::kCameraLate, {}, 0.3), {A::kImageTime}, 2},
      {"both cameras late by 0.5 s", "F06", on(K::kCameraLate, {}, 0.5), {A::kImageTime}, 2},
  };
  for (FaultCase& row : cases) {
    row.of_cameras = true;
    row.besides = {A::kHeightMismatch};  // "check the cameras"
  }
  return cases;
}

std::vector<FaultCase> AttitudeCases() {
  std::vector<FaultCase> cases = {
      {"attitude not a number",
       "F10",
       {{K::kAttitudeNan}},
       {A::kAttitudeInvalid, A::kPose, A::kUndecodable}},
      {"attitude missing", "F10", {{K::kMissing, C::kVehiclePose}}, {A::kPose}, 1.2},
      {"attitude late by 0.3 s", "F10", {{K::kAttitudeLate, {}, 0.3}}, {A::kPose}},
  };
  // Three degrees are a third of the slope limit: ground judged with them is not judged.
  cases.push_back(
      {"attitude rolled by 3 deg", "F11", {{K::kAttitudeBias, {}, 3}}, {A::kGravity}, 5});
  constexpr double kOld_s = 0.2, kAhead_s = 0.5;
  struct Shift {
    const char* name;
    double s;
  };
  for (const Shift shift : {Shift{"attitude shifted by -0.05 s", -0.05},
                            {"attitude shifted by 0.05 s", 0.05},
                            {"attitude shifted by -0.1 s", -0.1},
                            {"attitude shifted by 0.1 s", 0.1},
                            {"attitude shifted by -0.3 s", -0.3},
                            {"attitude shifted by 0.3 s", 0.3},
                            {"attitude shifted by 0.5 s", 0.5}}) {
    // Stamped long ago they are old, too; stamped ahead of the vehicle's clock they are refused.
    std::vector<A> cause = {A::kImageTime};
    if (shift.s <= -kOld_s || shift.s >= kAhead_s) {
      cause.push_back(A::kPose);
    }
    if (shift.s >= kAhead_s) {
      cause.push_back(A::kStampsRefused);
    }
    cases.push_back({shift.name, "F06", {{K::kAttitudeShifted, {}, shift.s}}, cause, 2});
  }
  return cases;
}

std::vector<FaultCase> SensorCases() {
  const auto lands = DescentMust::kLand;
  return {
      {"laser missing", "F07", {{K::kMissing, C::kLaserRange}}, {A::kLaserLost}, 1, true, lands},
      {"laser stuck", "F09", {{K::kLaserStuck}}, {A::kLaserStuck}, 1.5, true, lands},
      {"laser without return", "F07", {{K::kLaserNoReturn}}, {A::kLaserLost}, 1, true, lands},
      {"laser halved", "F09", {{K::kLaserScaled, {}, 0.5}}, {A::kLaserWrong}, 1, true, lands},
      {"laser doubled", "F09", {{K::kLaserScaled, {}, 2}}, {A::kLaserWrong}, 1, true, lands},
      {"laser spikes", "F08", {{K::kLaserSpikes}}, {}, 5, false, lands, false, true},
      {"GPS jumps by 8 m", "F12", {{K::kGpsJump, {}, 8}}, {A::kGpsJump}, 1, true, lands},
      {"GPS drifts at 0.5 m/s", "F12", {{K::kGpsDrift, {}, 0.5}}, {A::kGpsJump}, 2, true, lands},
      {"GPS missing", "F13", {{K::kMissing, C::kGps}}, {A::kGpsLost}, 2.5, true, lands},
      {"GPS in a canyon of 3 m",
       "F12",
       {{K::kGpsCanyon, {}, 3}},
       {A::kGpsJump, A::kGpsLost},
       5,
       true,
       lands},
      // The filter has more to go by: nobody need be told as long as it stays right.
      {"gyro biased by 2 deg/s",
       "F11",
       {{K::kImuGyroBias, {}, 2}},
       {},
       5,
       false,
       lands,
       false,
       true},
      {"accelerometer biased by 0.15 m/s2",
       "F11",
       {{K::kImuAccelBias, {}, 0.15}},
       {},
       5,
       false,
       lands,
       false,
       true},
      // Gravity cannot tell it from an attitude that is 2.9 deg off.
      {"accelerometer biased by 0.5 m/s2", "F11", {{K::kImuAccelBias, {}, 0.5}}, {A::kGravity}, 5},
  };
}

std::vector<FaultCase> VehicleCases() {
  return {
      {"status missing", "F18", {{K::kMissing, C::kVehicleStatus}}, {A::kLink}, 1.5},
      {"silence",
       "F18",
       {{K::kMissing}},
       {A::kLink, A::kPose, A::kCameraLeft, A::kCameraRight},
       1.5},
      {"clock steps by 5 s", "F14", {{K::kClockStep, {}, 5}}, {A::kClock}},
      {"clock steps by -5 s", "F14", {{K::kClockStep, {}, -5}}, {A::kClock}},
      {"clock steps by a day", "F14", {{K::kClockStep, {}, 86400}}, {A::kClock}},
      {"clock gains 1 %",  // the station's clock follows it: ages stay true
       "F14",
       {{K::kClockDrift, {}, 0.01}},
       {A::kClock},
       10,
       false,
       DescentMust::kLand,
       false,
       true},
      {"another boot id", "F16", {{K::kNewBoot}}, {A::kReboot}},
      {"restart of vehicle and clock", "F16", {{K::kRestart}}, {A::kReboot, A::kClock}, 1.5},
  };
}

std::vector<FaultCase> LinkCases() {
  // A pair wants both of its pictures, so that losses are seen there, too.
  const std::vector<A> of_loss = {A::kMessageLoss, A::kPairing, A::kCameraLeft, A::kCameraRight};
  const auto lands = DescentMust::kLand, either = DescentMust::kEither;
  return {
      {"1 % of messages lost", "F21", {{K::kLost, {}, 1}}, {}, 5, false, lands, false, true},
      {"10 % of messages lost", "F21", {{K::kLost, {}, 10}}, of_loss, 5, false, either},
      {"30 % of messages lost", "F21", {{K::kLost, {}, 30}}, of_loss, 5, false, either},
      // The limit is 50 %: half may or may not be beyond it.
      {"50 % of messages lost", "F21", {{K::kLost, {}, 50}}, of_loss, 5, false, either},
      {"60 % of messages lost", "F21", {{K::kLost, {}, 60}}, of_loss, 5, true, either},
      {"5 % of messages corrupted",
       "F25",
       {{K::kCorrupted, {}, 5}},
       {A::kUndecodable},
       5,
       false,
       either,
       false,
       false,
       true},
      {"20 % of messages reordered",
       "F22",
       {{K::kReordered, {}, 20}},
       {A::kMessageLoss},  // what comes after newer ones is not used
       5,
       false,
       either,
       false,
       true},
      {"20 % of messages twice",
       "F23",
       {{K::kDuplicated, {}, 20}},
       {},
       5,
       false,
       lands,
       false,
       true},
  };
}

}  // namespace

std::span<const FaultCase> FaultCases() {
  static const std::vector<FaultCase> kCases = [] {
    std::vector<FaultCase> all;
    for (std::vector<FaultCase>& part :
         std::array{CameraCases(), AttitudeCases(), SensorCases(), VehicleCases(), LinkCases()}) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }();
  return kCases;
}

bool IsConsequence(AlarmId id) {
  constexpr AlarmId kConsequences[] = {A::kHold,
                                       A::kWaveOff,
                                       A::kNoSite,
                                       A::kSiteDegraded,
                                       A::kVisionLost,
                                       A::kOffPath,
                                       A::kOldGround,
                                       A::kOffCentre,
                                       A::kCoherenceLow,
                                       A::kTrackersApart,
                                       A::kVisionResidual,
                                       A::kDescentRate,
                                       A::kApprovalUnanswered,
                                       A::kApprovalRefused,
                                       A::kRowError};
  return std::find(std::begin(kConsequences), std::end(kConsequences), id) !=
         std::end(kConsequences);
}

}  // namespace palace
