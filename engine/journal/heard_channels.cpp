#include "engine/journal/heard_channels.h"

#include <algorithm>
#include <optional>

namespace palace {
namespace {

constexpr double kGap_s = 1;

/// The input that comes on each channel of the log.
std::vector<std::optional<ChannelId>> InputsOf(const LogIndex& index, const ChannelNames& names) {
  const std::pair<const std::string*, ChannelId> inputs[] = {
      {&names.camera_left, ChannelId::kCameraLeft},
      {&names.camera_right, ChannelId::kCameraRight},
      {&names.vehicle_pose, ChannelId::kVehiclePose},
      {&names.imu, ChannelId::kImu},
      {&names.gps, ChannelId::kGps},
      {&names.laser_range, ChannelId::kLaserRange},
      {&names.vehicle_status, ChannelId::kVehicleStatus},
      {&names.position_estimate, ChannelId::kPositionEstimate}};
  std::vector<std::optional<ChannelId>> of_channel(index.channels.size());
  for (std::size_t i = 0; i < index.channels.size(); ++i) {
    for (const auto& [name, id] : inputs) {
      if (index.channels[i] == *name) {
        of_channel[i] = id;
      }
    }
  }
  return of_channel;
}

}  // namespace

std::array<std::vector<Timestamp>, kChannelCount> FindHeard(const LogIndex& index,
                                                            const std::vector<BundleMark>& bundles,
                                                            const ChannelNames& channels) {
  const auto input_of = InputsOf(index, channels);
  std::array<std::vector<Timestamp>, kChannelCount> heard;
  for (std::size_t b = 0; b < bundles.size(); ++b) {
    for (std::size_t i = bundles[b].first; i < bundles[b].end; ++i) {
      const std::optional<ChannelId> input = input_of[index.entries[i].channel];
      const bool of_station = input == ChannelId::kPositionEstimate;  // told after its bundle
      if (!input || (of_station && b == 0)) {
        continue;
      }
      std::vector<Timestamp>& times = heard[static_cast<std::size_t>(*input)];
      const Timestamp time = bundles[of_station ? b - 1 : b].time;
      if (times.empty() || times.back() < time) {
        times.push_back(time);
      }
    }
  }
  return heard;
}

std::vector<RecordGap> FindGaps(const std::array<std::vector<Timestamp>, kChannelCount>& heard,
                                const std::vector<BundleMark>& bundles) {
  std::vector<Timestamp> times = {bundles.front().time, bundles.back().time};
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    if (static_cast<ChannelId>(i) != ChannelId::kPositionEstimate) {
      times.insert(times.end(), heard[i].begin(), heard[i].end());
    }
  }
  std::sort(times.begin(), times.end());
  std::vector<RecordGap> gaps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const RecordGap between{SecondsBetween(bundles.front().time, times[i - 1]),
                            SecondsBetween(bundles.front().time, times[i])};
    if (between.to_s - between.from_s > kGap_s) {
      gaps.push_back(between);
    }
  }
  return gaps;
}

}  // namespace palace
