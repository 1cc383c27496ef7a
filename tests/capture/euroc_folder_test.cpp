// Folders in EuRoC's layout: frames, pairs, poses, what is left out and what is refused.
#include "engine/capture/euroc/euroc_folder.h"

#include <sys/stat.h>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/camera/camera_pair.h"
#include "engine/camera/rectification.h"
#include "engine/capture/euroc/euroc_tables.h"
#include "engine/capture/image_folder_source.h"
#include "engine/capture/playback_turns.h"
#include "engine/core/random.h"
#include "engine/core/units.h"
#include "tests/capture/euroc_sample.h"

namespace palace {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d RandomRotation(RandomStream& random) {
  const double x = random.Normal(), y = random.Normal(), z = random.Normal(), w = random.Normal();
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

Vector3d RandomVector(RandomStream& random) {
  const double x = random.Uniform(-5, 5), y = random.Uniform(-5, 5), z = random.Uniform(-5, 5);
  return {x, y, z};
}

// ---- frames ----

TEST(EurocFrames, TheWorldIsTurnedByHand) {
  EXPECT_EQ(WorldFromEuroc() * Vector3d(1, 0, 0), Vector3d(0, 1, 0)) << "x of R is east";
  EXPECT_EQ(WorldFromEuroc() * Vector3d(0, 1, 0), Vector3d(1, 0, 0)) << "y is north";
  EXPECT_EQ(WorldFromEuroc() * Vector3d(0, 0, 1), Vector3d(0, 0, -1)) << "z is up";
  EXPECT_EQ(WorldFromEuroc().determinant(), 1);
  EXPECT_EQ(WorldFromEuroc() * WorldFromEuroc(), Matrix3d::Identity());
}

/// However the IMU sits, the camera stands and looks where the folder says.
TEST(EurocFrames, TheCameraStaysWhereItIs) {
  constexpr std::uint64_t kSeed = 16;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  for (int i = 0; i < 200; ++i) {
    const RigidTransform X_IC{RandomRotation(random), RandomVector(random)};
    const RigidTransform X_RI{RandomRotation(random), RandomVector(random)};
    const EurocMount mount = MountOf(X_IC, i % 3 == 0 ? std::nullopt : std::optional(X_RI));
    EXPECT_GE(mount.tilt_rad, -std::numbers::pi / 2);
    EXPECT_LE(mount.tilt_rad, 0);
    const RigidTransform X_BC{CameraRotationFromTilt(mount.tilt_rad), mount.position_body_m};
    const RigidTransform X_WC = mount.BodyPose(X_RI) * X_BC;
    const RigidTransform X_RC = X_RI * X_IC;
    EXPECT_LT((X_WC.R - WorldFromEuroc() * X_RC.R).norm(), 1e-12);
    EXPECT_LT((X_WC.p - WorldFromEuroc() * X_RC.p).norm(), 1e-12);
  }
}

/// Whatever the IMU's axes, the vehicle does not stand on its nose: of an upright camera that looks
/// down by any angle the first pose is level, with the camera's heading.
TEST(EurocFrames, TheBodyIsLevelWhereTheCameraIsUpright) {
  constexpr std::uint64_t kSeed = 17;
  SCOPED_TRACE(kSeed);
  RandomStream random(kSeed);
  for (int i = 0; i < 200; ++i) {
    const double heading = random.Uniform(-3, 3), tilt = -random.Uniform(0.01, 1.56);
    const Matrix3d R_WC = RotationFromEuler({0, 0, heading}) * CameraRotationFromTilt(tilt);
    const RigidTransform X_IC{RandomRotation(random), RandomVector(random)};
    const RigidTransform X_RI{WorldFromEuroc() * R_WC * X_IC.R.transpose(), RandomVector(random)};
    const EurocMount mount = MountOf(X_IC, X_RI);
    EXPECT_NEAR(mount.tilt_rad, tilt, 1e-9);
    const EulerAngles attitude = EulerFromRotation(mount.BodyPose(X_RI).R);
    EXPECT_NEAR(attitude.roll_rad, 0, 1e-9);
    EXPECT_NEAR(attitude.pitch_rad, 0, 1e-9);
    EXPECT_NEAR(attitude.yaw_rad, heading, 1e-9);
  }
}

TEST(EurocFrames, ABodyThatIsOursStays) {
  for (const double tilt_deg : {0.0, -45.0, -89.9, -90.0}) {
    const RigidTransform X_IC{CameraRotationFromTilt(Rad(tilt_deg)), {0.8, -0.5, 0.3}};
    const EurocMount mount = MountOf(X_IC, std::nullopt);
    EXPECT_NEAR(mount.tilt_rad, Rad(tilt_deg), 1e-12);
    EXPECT_EQ(mount.R_IB, Matrix3d::Identity());
    EXPECT_EQ(mount.position_body_m, X_IC.p);
  }
}

// ---- the folder ----

TEST(EurocFolder, GivesRigPairsAndPosesInOurFrames) {
  EurocSample sample;
  sample.Pictures("cam0", {0, 1, 2}, 10);
  sample.Pictures("cam1", {0, 1, 2}, 110);
  sample.States(0, 200);
  const auto folder = LoadEurocFolder(sample.folder());
  ASSERT_TRUE(folder.ok()) << folder.error().message;
  EXPECT_EQ(folder->left_out, "");
  const StereoRig& rig = folder->rig.rig;
  EXPECT_NEAR(rig.baseline_m, 0.11, 1e-12);
  EXPECT_NEAR(rig.rate_hz, 20, 1e-9);
  EXPECT_FALSE(rig.rectified);
  EXPECT_EQ(rig.left.pinhole.width, 32);
  EXPECT_TRUE(StereoRectifier::Make(rig).ok());
  ASSERT_EQ(folder->sequence.pairs.size(), 3u);
  const Matrix3d R_RI = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5).toRotationMatrix();
  for (int k = 0; k < 3; ++k) {
    const ImagePair& pair = folder->sequence.pairs[static_cast<std::size_t>(k)];
    EXPECT_EQ(pair.time, AddSeconds(kRecordedStart, 0.05 * k));
    ASSERT_TRUE(pair.pose.has_value());
    EXPECT_EQ(pair.pose->time, pair.time);
    EXPECT_LT((pair.pose->X_WB.p - Vector3d(2, 0.05 * k, -3)).norm(), 1e-12);
    EXPECT_LT((pair.pose->v_WB - Vector3d(0, 1, 0)).norm(), 1e-12) << "east";
    const RigidTransform X_WC = pair.pose->X_WB * rig.X_BC();
    const Vector3d axis_R = R_RI * Vector3d(0, 0, 1), right_R = R_RI * Vector3d(0, 1, 0);
    EXPECT_LT((X_WC.R.col(2) - Vector3d(axis_R.y(), axis_R.x(), -axis_R.z())).norm(), 1e-12);
    EXPECT_LT((X_WC.R.col(0) - Vector3d(right_R.y(), right_R.x(), -right_R.z())).norm(), 1e-12);
  }
}

TEST(EurocFolder, PosesAreThoseBetweenTheRowsAround) {
  std::vector<EurocState> states(3);
  states[0].time_ns = 1'000'000'000;
  states[1].time_ns = 1'100'000'000;
  states[2].time_ns = 1'200'000'001;
  states[1].X_RI = {Eigen::AngleAxisd(1, Vector3d::UnitZ()).toRotationMatrix(), {2, 4, 6}};
  const auto middle = StateAt(states, 1'025'000'000);
  ASSERT_TRUE(middle.has_value());
  EXPECT_LT((middle->X_RI.p - Vector3d(0.5, 1, 1.5)).norm(), 1e-12);
  EXPECT_LT((middle->X_RI.R - Eigen::AngleAxisd(0.25, Vector3d::UnitZ()).toRotationMatrix()).norm(),
            1e-12);
  EXPECT_EQ(StateAt(states, 1'100'000'000)->X_RI.p, Vector3d(2, 4, 6));
  EXPECT_TRUE(StateAt(states, 1'000'000'000).has_value());
  EXPECT_TRUE(StateAt(states, 1'200'000'001).has_value());
  EXPECT_FALSE(StateAt(states, 999'999'999).has_value());
  EXPECT_FALSE(StateAt(states, 1'200'000'002).has_value());
  EXPECT_FALSE(StateAt(states, 1'150'000'000).has_value()) << "a gap of 0.1 s and a nanosecond";
  EXPECT_FALSE(StateAt({}, 1).has_value());
}

TEST(EurocFolder, WhatIsLeftOutIsCountedAndSaid) {
  EurocSample sample;
  sample.Pictures("cam0", {0, 1, 2, 3, 5, 7, 8}, 10);
  sample.Pictures("cam1", {1, 2, 3, 4, 5, 6, 7, 8, 9}, 110);
  std::filesystem::remove(sample.folder() / "mav0/cam1/data" /
                          (std::to_string(EurocSample::Stamp(5)) + ".png"));
  sample.States(100, 360);  // pictures 2 to 7
  const auto folder = LoadEurocFolder(sample.folder() / "mav0");
  ASSERT_TRUE(folder.ok()) << folder.error().message;
  ASSERT_EQ(folder->sequence.pairs.size(), 3u) << "2, 3 and 7";
  EXPECT_EQ(folder->first_ns, EurocSample::Stamp(2));
  EXPECT_EQ(folder->sequence.pairs[2].time, AddSeconds(kRecordedStart, 0.25));
  EXPECT_EQ(folder->left_out,
            "left out: 4 pictures have no partner within 1 ms, 1 pair is named but not there, "
            "2 pairs have no pose: not between two rows of the ground truth at most 0.1 s apart");
}

TEST(EurocFolder, WithoutGroundTruthThereAreNoPoses) {
  EurocSample sample;
  sample.Pictures("cam0", {0, 1}, 10);
  sample.Pictures("cam1", {0, 1}, 110);
  const auto folder = LoadEurocFolder(sample.folder());
  ASSERT_TRUE(folder.ok()) << folder.error().message;
  EXPECT_EQ(folder->sequence.pairs.size(), 2u);
  EXPECT_FALSE(folder->sequence.pairs[0].pose.has_value());
  EXPECT_EQ(folder->left_out, "");
  EXPECT_EQ(LoadEurocImu(*folder)->size(), 0u);
}

TEST(EurocFolder, IdealParallelCamerasAreRectified) {
  EurocSample sample;
  const std::string no_lens = "0, 0, 0, 0";
  sample.Sensor("cam0", "0, -1, 0, 0.02,  1, 0, 0, -0.06,  0, 0, 1, 0.01,  0, 0, 0, 1", no_lens);
  sample.Sensor("cam1", "0, -1, 0, 0.02,  1, 0, 0, 0.05,  0, 0, 1, 0.01,  0, 0, 0, 1", no_lens);
  sample.Pictures("cam0", {0}, 10);
  sample.Pictures("cam1", {0}, 110);
  const auto folder = LoadEurocFolder(sample.folder());
  ASSERT_TRUE(folder.ok()) << folder.error().message;
  EXPECT_TRUE(folder->rig.rig.rectified);
  EXPECT_FALSE(folder->rig.rig.left.model.has_value());
  EXPECT_NEAR(folder->rig.rig.baseline_m, 0.11, 1e-12);
  EXPECT_EQ(folder->rig.rig.right.pinhole, (PinholeCamera{32, 32, 40, 40, 15.5, 15.5}));
}

TEST(EurocFolder, TheImuIsTurnedIntoTheBody) {
  EurocSample sample;
  sample.Pictures("cam0", {0}, 10);
  sample.Pictures("cam1", {0}, 110);
  sample.States(0, 100, "0.5,-0.5,0.5,-0.5");
  sample.Write("imu0/data.csv", "#t,w,w,w,a,a,a\n" +
                                    std::to_string(EurocSample::kStart_ns - 5'000'000) +
                                    ",0.1,0.2,0.3,9.8,0.5,0.25\n");
  const auto folder = LoadEurocFolder(sample.folder());
  ASSERT_TRUE(folder.ok()) << folder.error().message;
  const auto imu = LoadEurocImu(*folder);
  ASSERT_TRUE(imu.ok()) << imu.error().message;
  ASSERT_EQ(imu->size(), 1u);
  EXPECT_EQ((*imu)[0].time, AddSeconds(kRecordedStart, -0.005));
  // The same vectors in the world, by either body.
  const Matrix3d R_RI = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5).toRotationMatrix();
  const Matrix3d R_WB = folder->sequence.pairs[0].pose->X_WB.R;
  EXPECT_LT((R_WB * (*imu)[0].specific_force_B - WorldFromEuroc() * R_RI * Vector3d(9.8, 0.5, 0.25))
                .norm(),
            1e-12);
  EXPECT_LT(
      (R_WB * (*imu)[0].angular_rate_B - WorldFromEuroc() * R_RI * Vector3d(0.1, 0.2, 0.3)).norm(),
      1e-12);
  const auto poses = LoadEurocPoses(*folder);
  ASSERT_TRUE(poses.ok());
  EXPECT_EQ(poses->size(), 11u);
  EXPECT_EQ((*poses)[0].X_WB.p, folder->sequence.pairs[0].pose->X_WB.p);
}

TEST(EurocFolder, IsASourceOfPictures) {
  EurocSample sample;
  sample.Pictures("cam0", {0, 1, 3}, 10);
  sample.Pictures("cam1", {0, 1, 3}, 110);
  sample.States(0, 200);
  auto source = ImageFolderSource::Open(sample.folder(), false);
  ASSERT_TRUE(source.ok()) << source.error().message;
  (*source)->Control({PlaybackControl::Kind::kSpeed, 0});
  for (const int k : {0, 1, 3}) {
    const auto bundle = (*source)->Next({});
    ASSERT_TRUE(bundle.ok()) << bundle.error().message;
    EXPECT_EQ((*bundle)->stereo->left.at(3, 3), 10 + k);
    EXPECT_EQ((*bundle)->stereo->right.at(3, 3), 110 + k);
    EXPECT_EQ((*bundle)->time, AddSeconds(kRecordedStart, 0.05 * k));
    EXPECT_NEAR((*bundle)->pose_at_exposure->X_WB.p.y(), 0.05 * k, 1e-12);
  }
  EXPECT_EQ((*source)->Next({}).error().code, ErrorCode::kEnd);
}

// ---- what is refused ----

class BadEuroc : public testing::Test {
 protected:
  BadEuroc() {
    sample_.Pictures("cam0", {0, 1}, 10);
    sample_.Pictures("cam1", {0, 1}, 110);
    sample_.States(0, 100);
  }
  std::string Refusal() {
    const auto folder = LoadEurocFolder(sample_.folder());
    if (!folder.ok()) {
      return folder.error().message;
    }
    const auto imu = LoadEurocImu(*folder);
    return imu.ok() ? "" : imu.error().message;
  }
  EurocSample sample_;
};

TEST_F(BadEuroc, TablesAreRefusedByFileLineColumnAndLimit) {
  const std::string t = std::to_string(EurocSample::kStart_ns);
  const std::string later = std::to_string(EurocSample::kStart_ns + 1);
  const std::string states = "state_groundtruth_estimate0/data.csv";
  const std::string pose = ",0,0,0,1,0,0,0\n";
  const struct {
    const char* what;
    std::string file, text;
    const char* message;
  } rows[] = {
      {"no rows", "cam0/data.csv", "#timestamp [ns],filename\n", "cam0/data.csv: no row"},
      {"3 columns", "cam0/data.csv", "\n" + t + ",a.png,b\n",
       "cam0/data.csv:2: 3 columns; a row has 2"},
      {"1 column", "cam1/data.csv", t + "\n", "cam1/data.csv:1: 1 columns; a row has 2"},
      {"out of the folder", "cam0/data.csv", t + ",../../secret.png\n",
       "filename = ../../secret.png must be the name of a file"},
      {"hidden", "cam0/data.csv", t + ",.png\n", "must be the name of a file"},
      {"no name", "cam0/data.csv", t + ",\n", "filename =  must be"},
      {"stamp of letters", "cam0/data.csv", "now,a.png\n",
       "cam0/data.csv:1: timestamp = now must be whole nanoseconds from 0"},
      {"stamp in seconds", "cam0/data.csv", "1403636579.76,a.png\n", "whole nanoseconds"},
      {"negative stamp", "cam0/data.csv", "-5,a.png\n", "whole nanoseconds"},
      {"endless stamp", "cam0/data.csv", "99999999999999999999,a.png\n", "whole nanoseconds"},
      {"stamps fall", "cam0/data.csv", later + ",a.png\n# x\n" + t + ",b.png\n",
       "cam0/data.csv:3: timestamp = 1403636579763555584 does not come after the "
       "1403636579763555585 of line 1"},
      {"999 ns", states, t + pose + std::to_string(EurocSample::kStart_ns + 999) + pose,
       "rows stand in order of time, at least 1000 ns apart"},
      {"stamp twice", states, t + pose + t + pose, "does not come after"},
      {"9 columns", states, t + ",0,0,0,1,0,0,0,0\n", ":1: 9 columns; a row has 8 (pose), 11"},
      {"no number", states, t + ",0,x,0,1,0,0,0\n", ":1: p_RS_R_y = x is no finite number"},
      {"nan", states, t + ",0,0,nan,1,0,0,0\n", "p_RS_R_z = nan is no finite number"},
      {"far", states, t + ",1e7,0,0,1,0,0,0\n", "p_RS_R_x = 1e7 is outside -1000000 .. 1000000"},
      {"quaternion 0", states, t + ",0,0,0,0,0,0,0\n", "q_RS has length 0, it must be 1"},
      {"quaternion long", states, t + ",0,0,0,1,0.2,0,0\n", "q_RS has length 1.019803903"},
      {"quaternion term", states, t + ",0,0,0,1,0,0,7\n", "q_RS_z = 7 is outside -2 .. 2"},
      {"fast", states, t + ",0,0,0,1,0,0,0,0,1e5,0\n", "v_RS_R_y = 1e5 is outside -10000"},
      {"IMU columns", "imu0/data.csv", t + ",0,0,0,0,0\n",
       "imu0/data.csv:1: 6 columns; a row has 7"},
      {"IMU turn", "imu0/data.csv", t + ",0,0,2000,0,0,0\n", "w_RS_S_z = 2000 is outside -1000"},
      {"IMU force", "imu0/data.csv", t + ",0,0,0,inf,0,0\n", "a_RS_S_x = inf is no finite number"},
      {"no pose at all", states, "1000" + pose,
       "no pair of pictures; left out: 2 pairs have no pose"},
      {"cut sensor", "cam1/sensor.yaml", "sensor_type: camera\nT_BS:\n", "cam1/sensor.yaml"},
  };
  for (const auto& row : rows) {
    SCOPED_TRACE(row.what);
    std::ifstream before(sample_.folder() / "mav0" / row.file, std::ios::binary);
    const std::string kept{std::istreambuf_iterator<char>(before), {}};
    sample_.Write(row.file, row.text);
    const std::string refusal = Refusal();
    EXPECT_NE(refusal.find(row.message), std::string::npos) << refusal;
    EXPECT_NE(refusal.find(sample_.folder().string()), std::string::npos) << refusal;
    kept.empty() ? void(std::filesystem::remove(sample_.folder() / "mav0" / row.file))
                 : sample_.Write(row.file, kept);
  }
  EXPECT_EQ(Refusal(), "") << "all is as before";
}

TEST_F(BadEuroc, FoldersThatAreNoneAreSaidToBe) {
  EXPECT_NE(LoadEurocFolder("/nowhere").error().message.find("/nowhere: no such folder"),
            std::string::npos);
  const std::filesystem::path pipe = sample_.folder() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::filesystem::path& none :
       {pipe, std::filesystem::path("/dev/zero"), sample_.folder() / "mav0/cam0/sensor.yaml"}) {
    EXPECT_EQ(
        LoadEurocFolder(none).error().message,
        none.string() + ": is no folder; give one that holds mav0/cam0, as EuRoC data have it");
  }
  const auto source = ImageFolderSource::Open(sample_.folder().parent_path() / "..", false);
  ASSERT_FALSE(source.ok());
  EXPECT_NE(source.error().message.find("or the RIG.toml of the pictures"), std::string::npos);
  std::filesystem::remove(sample_.folder() / "mav0/cam1/sensor.yaml");
  EXPECT_NE(Refusal().find("cam1/sensor.yaml"), std::string::npos) << Refusal();
}

TEST_F(BadEuroc, CamerasThatAreNoPairAreRefused) {
  sample_.Sensor("cam1", "0, -1, 0, 0.02,  1, 0, 0, -0.06,  0, 0, 1, 0.01,  0, 0, 0, 1");
  EXPECT_NE(Refusal().find("a baseline of 0 m, outside 0.001 to 1000 m"), std::string::npos)
      << Refusal();
}

TEST_F(BadEuroc, APictureOfAnotherSizeIsNamed) {
  sample_.Sensor("cam0", "0, -1, 0, 0.02,  1, 0, 0, -0.06,  0, 0, 1, 0.01,  0, 0, 0, 1",
                 "-0.1, 0, 0, 0", 64);
  const auto source = ImageFolderSource::Open(sample_.folder(), false);
  ASSERT_FALSE(source.ok());
  EXPECT_NE(source.error().message.find("cam0/data/1403636579763555584.png"), std::string::npos)
      << source.error().message;
}

}  // namespace
}  // namespace palace
