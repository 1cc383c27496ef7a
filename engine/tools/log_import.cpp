#include "engine/tools/log_import.h"

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "engine/capture/euroc/euroc_folder.h"
#include "engine/capture/pair_bundle.h"
#include "engine/capture/picture_size.h"
#include "engine/journal/log_index.h"
#include "engine/journal/log_writer.h"
#include "engine/wire/channels.h"
#include "engine/wire/convert.h"

namespace palace {
namespace {

struct ImportOptions {
  std::string folder;
  std::string out;
  std::string channels_file;
};

struct Imported {
  std::uint64_t pairs = 0;
  std::uint64_t imu_samples = 0;
  std::uint64_t events = 0;
  std::string left_out;
};

/// Samples of the time up to a pair, each once; those before the first pair are passed over.
template <typename Sample>
class Feed {
 public:
  explicit Feed(std::vector<Sample> samples) : samples_(std::move(samples)) {}

  std::vector<Sample> Until(Timestamp time, bool is_first) {
    std::vector<Sample> taken;
    for (; next_ < samples_.size() && samples_[next_].time <= time; ++next_) {
      if (!is_first || samples_[next_].time == time) {
        taken.push_back(samples_[next_]);
      }
    }
    return taken;
  }

 private:
  std::vector<Sample> samples_;
  std::size_t next_ = 0;
};

/// One bundle a pair, with what was measured since the one before.
Status WriteBundles(const EurocFolder& euroc, const ChannelNames& channels, LogWriter& log,
                    Imported& told) {
  auto imu = LoadEurocImu(euroc);
  if (!imu) {
    return imu.error();
  }
  auto poses = LoadEurocPoses(euroc);
  if (!poses) {
    return poses.error();
  }
  Feed<ImuSample> imu_feed(std::move(imu).value());
  Feed<VehiclePose> pose_feed(std::move(poses).value());
  const auto rig = std::make_shared<const StereoRig>(euroc.rig.rig);
  for (const ImagePair& pair : euroc.sequence.pairs) {
    auto frame = ReadStereoPair(pair.left, pair.right);
    if (!frame) {
      return frame.error();
    }
    for (const auto& [picture, camera, path] :
         {std::tuple(&frame->left, &rig->left, &pair.left),
          std::tuple(&frame->right, &rig->right, &pair.right)}) {
      if (const Status good = CheckPictureSize(*picture, camera->pinhole, path->string(),
                                               "correct resolution in sensor.yaml");
          !good) {
        return good;
      }
    }
    frame->time = pair.time;
    auto bundle = BundleOf(rig, pair.pose, std::make_shared<const StereoFrame>(std::move(*frame)));
    bundle->sequence = ++told.pairs;
    const bool is_first = told.pairs == 1;
    bundle->imu = imu_feed.Until(pair.time, is_first);
    told.imu_samples += bundle->imu.size();
    if (auto between = pose_feed.Until(pair.time, is_first);
        !between.empty() && between.back().time == pair.time) {
      bundle->poses = std::move(between);
    } else if (pair.pose) {
      bundle->poses = std::move(between);
      bundle->poses.push_back(*pair.pose);
    }
    for (const WireMessage& message : EncodeBundle(*bundle, channels)) {
      if (const Status written = log.Write(message); !written) {
        return written;
      }
    }
    if (const Status flushed = log.Flush(); !flushed) {
      return flushed;
    }
  }
  return Ok();
}

Result<Imported> Import(const ImportOptions& options) {
  const Result<ChannelNames> channels = options.channels_file.empty()
                                            ? Result<ChannelNames>(ChannelNames())
                                            : LoadChannels(options.channels_file);
  if (!channels) {
    return channels.error();
  }
  const auto euroc = LoadEurocFolder(options.folder);
  if (!euroc) {
    return euroc.error();
  }
  auto log = LogWriter::Create(options.out);
  if (!log) {
    return log.error();
  }
  Imported told;
  told.left_out = euroc->left_out;
  Status done = WriteBundles(*euroc, *channels, *log, told);
  const Status closed = log->Close();
  told.events = log->events();
  if (done && !closed) {
    done = closed;
  }
  if (!done) {  // half a recording would pass for a whole one
    std::error_code ignored;
    std::filesystem::remove(SidecarPath(options.out), ignored);
    std::filesystem::remove(options.out, ignored);
    return done.error();
  }
  return told;
}

}  // namespace

void AddLogImport(CLI::App& log, int& exit_code) {
  CLI::App* verb = log.add_subcommand(
      "import",
      "Write a folder in EuRoC's layout as a new log: stereo pairs, ground truth as poses, IMU. "
      "Exit 3 where something was left out");
  const auto options = std::make_shared<ImportOptions>();
  verb->add_option("DIR", options->folder, "The folder that holds mav0, or mav0 itself")
      ->required();
  verb->add_option("--out", options->out, "The new log")->required();
  verb->add_option("--channels", options->channels_file, "Channel names (TOML)");
  verb->callback([options, &exit_code] {
    const Result<Imported> imported = Import(*options);
    if (!imported) {
      std::cerr << "palacectl log: " << imported.error().message << "\n";
      exit_code = imported.error().code == ErrorCode::kUsage ? 2 : 1;
      return;
    }
    std::printf("%s: %llu pairs, %llu IMU samples, %llu events\n", options->out.c_str(),
                static_cast<unsigned long long>(imported->pairs),
                static_cast<unsigned long long>(imported->imu_samples),
                static_cast<unsigned long long>(imported->events));
    if (!imported->left_out.empty()) {
      std::printf("%s\n", imported->left_out.c_str());
    }
    exit_code = imported->left_out.empty() ? 0 : 3;
  });
}

}  // namespace palace
