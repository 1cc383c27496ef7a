#include "engine/capture/euroc/euroc_folder.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "engine/camera/camera_pair.h"
#include "engine/camera/files/camera_files.h"
#include "engine/capture/euroc/euroc_tables.h"
#include "engine/capture/playback_turns.h"
#include "engine/core/text.h"
#include "engine/model/rig_limits.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kPairTolerance_ns = 1'000'000;
constexpr const char* kStates = "state_groundtruth_estimate0";

bool Exists(const fs::path& path) {
  std::error_code code;
  return fs::exists(path, code);
}

bool IsFolder(const fs::path& path) {
  std::error_code code;
  return fs::is_directory(path, code);
}

Timestamp DataTime(std::int64_t time_ns, std::int64_t first_ns) {
  const std::int64_t since_ns = time_ns - first_ns;  // both are 0 or more
  const std::int64_t half = since_ns < 0 ? -500 : 500;
  return {kRecordedStart.us + (since_ns / 1000) + (since_ns % 1000 + half) / 1000};
}

/// The places of the two cameras in I, and the rig but its mount.
Result<RigidTransform> ReadRig(const fs::path& folder, StereoRig& rig) {
  const fs::path left_file = folder / "cam0/sensor.yaml", right_file = folder / "cam1/sensor.yaml";
  const auto left = ReadCameraFile(left_file, {StereoSide::kLeft, {}});
  if (!left) {
    return left.error();
  }
  const auto right = ReadCameraFile(right_file, {StereoSide::kRight, {}});
  if (!right) {
    return right.error();
  }
  for (const auto& [model, file] : {std::pair(&*left, &left_file), {&*right, &right_file}}) {
    if (!model->pose_is_known || !HasSize(*model)) {
      return InvalidError(file->string() +
                          ": tells no place or size of the camera; an EuRoC sensor.yaml has T_BS "
                          "and resolution");
    }
  }
  SetCameras(rig, {InUnit(*left, 1), InUnit(*right, 1)});
  if (const std::string why = WhyNoRig(rig); !why.empty()) {
    return InvalidError(left_file.string() + ", " + right_file.string() + ": " + why);
  }
  return RigidTransform{RotationOf(*left).transpose(), CentreOf(*left)};
}

/// Pictures of both cameras, in order of time, and what found no place in a pair.
struct Pairs {
  std::vector<std::int64_t> times_ns;
  std::vector<ImagePair> pairs;
  int alone = 0;
  int missing = 0;
};

Pairs PairsOf(const fs::path& folder, const std::vector<EurocPicture>& left,
              const std::vector<EurocPicture>& right) {
  Pairs found;
  std::size_t k = 0, used = 0;
  for (const EurocPicture& picture : left) {
    while (k < right.size() && right[k].time_ns < picture.time_ns - kPairTolerance_ns) {
      ++k;
    }
    if (k == right.size() || right[k].time_ns > picture.time_ns + kPairTolerance_ns) {
      ++found.alone;
      continue;
    }
    const ImagePair pair{
        folder / "cam0/data" / picture.file, folder / "cam1/data" / right[k].file, {}, {}};
    ++k;
    ++used;
    if (!Exists(pair.left) || !Exists(pair.right)) {
      ++found.missing;
      continue;
    }
    found.times_ns.push_back(picture.time_ns);
    found.pairs.push_back(pair);
  }
  found.alone += static_cast<int>(right.size() - used);
  return found;
}

std::string LeftOutText(const Pairs& found, int unposed) {
  std::vector<std::string> words;
  const auto tell = [&](int count, const std::string& what) {
    if (count > 0) {
      words.push_back(std::to_string(count) + what);
    }
  };
  tell(found.alone, found.alone == 1 ? " picture has no partner within 1 ms"
                                     : " pictures have no partner within 1 ms");
  tell(found.missing,
       found.missing == 1 ? " pair is named but not there" : " pairs are named but not there");
  tell(unposed, std::string(unposed == 1 ? " pair has" : " pairs have") +
                    " no pose: not between two rows of the ground truth at most 0.1 s apart");
  return words.empty() ? "" : "left out: " + Joined(words);
}

Result<std::vector<EurocState>> StatesOf(const fs::path& folder) {
  const fs::path file = folder / kStates / "data.csv";
  return Exists(file) ? ReadEurocStates(file) : std::vector<EurocState>{};
}

VehiclePose PoseOf(const EurocMount& mount, const EurocState& state, Timestamp time) {
  VehiclePose pose;
  pose.time = time;
  pose.X_WB = mount.BodyPose(state.X_RI);
  pose.v_WB = WorldFromEuroc() * state.v_RI;
  return pose;
}

/// The pairs that have a pose, if there is a ground truth, in our frames.
void KeepPosed(const Pairs& pairs, const std::vector<EurocState>& states,
               const RigidTransform& X_IC, EurocFolder& found) {
  std::vector<std::optional<EurocState>> poses;
  for (const std::int64_t time_ns : pairs.times_ns) {
    poses.push_back(StateAt(states, time_ns));
  }
  const auto first =
      std::find_if(poses.begin(), poses.end(), [](const auto& pose) { return pose.has_value(); });
  found.mount = MountOf(
      X_IC, first == poses.end() ? std::nullopt : std::optional<RigidTransform>((*first)->X_RI));
  std::vector<ImagePair>& kept = found.sequence.pairs;
  int unposed = 0;
  for (std::size_t k = 0; k < pairs.pairs.size(); ++k) {
    if (!states.empty() && !poses[k]) {
      ++unposed;
      continue;
    }
    found.first_ns = kept.empty() ? pairs.times_ns[k] : found.first_ns;
    kept.push_back(pairs.pairs[k]);
    kept.back().time = DataTime(pairs.times_ns[k], found.first_ns);
    if (poses[k]) {
      kept.back().pose = PoseOf(found.mount, *poses[k], kept.back().time);
    }
  }
  found.left_out = LeftOutText(pairs, unposed);
}

double MeanRate(const std::vector<ImagePair>& pairs, double otherwise) {
  const double span_s = SecondsBetween(pairs.front().time, pairs.back().time);
  return span_s > 0 ? static_cast<double>(pairs.size() - 1) / span_s : otherwise;
}

}  // namespace

Result<EurocFolder> LoadEurocFolder(const fs::path& folder) {
  EurocFolder found;
  found.folder = Exists(folder / "mav0") ? folder / "mav0" : folder;
  if (!IsFolder(found.folder / "cam0")) {
    return UnavailableError(
        folder.string() +
        (IsFolder(folder) ? ": is a folder without mav0/cam0, as EuRoC data have it; give such a "
                            "folder, or the RIG.toml of the pictures"
         : Exists(folder) ? ": is no folder; give one that holds mav0/cam0, as EuRoC data have it"
                          : ": no such folder; check the name"));
  }
  const auto X_IC = ReadRig(found.folder, found.rig.rig);
  if (!X_IC) {
    return X_IC.error();
  }
  const auto left = ReadEurocPictures(found.folder / "cam0/data.csv");
  if (!left) {
    return left.error();
  }
  const auto right = ReadEurocPictures(found.folder / "cam1/data.csv");
  if (!right) {
    return right.error();
  }
  const auto states = StatesOf(found.folder);
  if (!states) {
    return states.error();
  }
  const Pairs pairs = PairsOf(found.folder, *left, *right);
  KeepPosed(pairs, *states, *X_IC, found);
  if (found.sequence.pairs.empty()) {
    return InvalidError(found.folder.string() + ": no pair of pictures; " + found.left_out);
  }
  StereoRig& rig = found.rig.rig;
  found.sequence.rate_hz = MeanRate(found.sequence.pairs, rig.rate_hz);
  rig.rate_hz =
      std::clamp(found.sequence.rate_hz, RigLimits::kLeastRate_hz, RigLimits::kMostRate_hz);
  rig.tilt_rad = found.mount.tilt_rad;
  rig.position_body_m = found.mount.position_body_m;
  found.rig.folder = found.folder;
  return found;
}

Result<std::vector<ImuSample>> LoadEurocImu(const EurocFolder& folder) {
  std::vector<ImuSample> samples;
  const fs::path file = folder.folder / "imu0/data.csv";
  if (!Exists(file)) {
    return samples;
  }
  const auto rows = ReadEurocInertials(file);
  if (!rows) {
    return rows.error();
  }
  const Eigen::Matrix3d R_BI = folder.mount.R_IB.transpose();
  for (const EurocInertial& row : *rows) {
    samples.push_back({DataTime(row.time_ns, folder.first_ns), R_BI * row.specific_force_I,
                       R_BI * row.angular_rate_I});
  }
  return samples;
}

Result<std::vector<VehiclePose>> LoadEurocPoses(const EurocFolder& folder) {
  const auto states = StatesOf(folder.folder);
  if (!states) {
    return states.error();
  }
  std::vector<VehiclePose> poses;
  for (const EurocState& state : *states) {
    poses.push_back(PoseOf(folder.mount, state, DataTime(state.time_ns, folder.first_ns)));
  }
  return poses;
}

}  // namespace palace
