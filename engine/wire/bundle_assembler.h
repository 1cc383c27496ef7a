// BundleAssembler: messages of a vehicle, a log or a foreign sender become frame bundles.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/frame_bundle.h"
#include "engine/wire/channels.h"
#include "engine/wire/wire_message.h"

namespace palace {

/// What went by since the start. Nothing is lost silently.
struct AssemblerReport {
  std::uint64_t messages = 0;
  std::uint64_t undecodable = 0;  ///< of a known channel, refused by the decoder
  std::map<std::string, std::uint64_t> undecodable_of{};    ///< the same by channel
  std::map<std::string, std::uint64_t> other_version_of{};  ///< those of another type hash
  std::uint64_t other_channels = 0;                         ///< not ours; skipped
  std::uint64_t pictures_unpaired = 0;   ///< no partner within the pairing window, or late
  std::uint64_t pairs_without_rig = 0;   ///< foreign stream: dropped because no rig came yet
  std::uint64_t bundles_lost = 0;        ///< gaps in the sequence of closed bundles
  std::uint64_t samples_lost = 0;        ///< announced by CAMERA_RIG, never arrived
  std::uint64_t samples_overflowed = 0;  ///< the oldest, of more than wait in one bundle
  std::uint64_t repeated = 0;            ///< a stamp that did not advance (only when dropped)
  std::map<std::string, std::uint64_t> stamps_refused{};  ///< by channel: AssemblerOptions::accepts
};

struct AssemblerOptions {
  double pair_window_s = 0.005;  ///< largest difference of the stamps of a pair
  bool drop_repeated = false;    ///< live: a message whose utime does not advance is not news
  /// Live: whether a stamp on this channel can be, asked before anything else is; null: any can.
  std::function<bool(const std::string& channel, Timestamp stamp)> accepts{};
};

/// The pose carried to `time` at constant velocity and turn rate.
VehiclePose CarryPose(VehiclePose pose, Timestamp time);

/// Two kinds of stream. Closed: CAMERA_RIG with bundle_end comes last in each bundle; the bundle is
/// rebuilt to the bit. Open (foreign senders): the pair of pictures closes the bundle, its time is
/// the newest stamp seen, and the pose at exposure is the nearest pose within 0.1 s, carried over
/// the difference at constant rate. Once a rig is known, only its sender may bring another.
class BundleAssembler {
 public:
  explicit BundleAssembler(ChannelNames channels = {}, AssemblerOptions options = {});

  /// Any bytes are fine. Returns the bundles the message completed: none or one.
  std::vector<std::shared_ptr<const FrameBundle>> Push(const WireMessage& message);
  /// What is pending without pictures, as a bundle at `now`; for a live source that must not stay
  /// silent while cameras are.
  std::shared_ptr<const FrameBundle> TakePending(Timestamp now);
  /// Forgets what is pending after a jump in time; keeps the rig.
  void Reset();

  const AssemblerReport& report() const { return report_; }
  /// Why the last message was refused; empty when it was not.
  const std::string& problem() const { return problem_; }
  /// Null before the first CAMERA_RIG.
  const std::shared_ptr<const StereoRig>& rig() const { return rig_; }
  /// Newest utime of any vehicle message; nothing before the first.
  std::optional<Timestamp> newest() const { return newest_; }

 private:
  using Bundles = std::vector<std::shared_ptr<const FrameBundle>>;

  Status Take(const WireMessage& message, Bundles& done);
  Status TakePicture(const WireMessage& message, bool is_left, Bundles& done);
  Status TakeRig(const WireMessage& message, Bundles& done);
  Status TakeSample(const WireMessage& message);
  bool IsNews(const std::string& channel, Timestamp time);
  void ClosePair(Bundles& done);
  /// Notes that this camera's picture found no partner, and forgets it.
  void DropAlone(bool is_left);

  ChannelNames channels_;
  AssemblerOptions options_;
  AssemblerReport report_;
  std::string problem_;
  std::shared_ptr<const StereoRig> rig_;
  std::string rig_sender_{};
  bool closed_stream_ = false;
  std::optional<std::uint64_t> last_sequence_;
  std::uint64_t next_sequence_ = 0;
  FrameBundle pending_;
  std::optional<TimedPicture> left_;
  std::optional<TimedPicture> right_;
  std::optional<VehiclePose> last_pose_;
  std::optional<Timestamp> newest_;
  std::map<std::string, Timestamp> newest_of_;
};

}  // namespace palace
