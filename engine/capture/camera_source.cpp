#include "engine/capture/camera_source.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "engine/capture/frame_pairing.h"
#include "engine/capture/pair_bundle.h"
#include "engine/capture/side_by_side.h"
#include "engine/core/log.h"

namespace palace {
namespace {

constexpr double kUsualRate_hz = 30;  // where neither RIG.toml nor the camera says

}  // namespace

/// What the cameras' threads and the source have in common. Owned by all of them.
struct CameraSource::Shared {
  Shared(RigCameras of_rig, const CameraSourceOptions& options, double rate)
      : cameras(std::move(of_rig)),
        now_s(options.now_s),
        start(options.start),
        start_s(now_s()),
        rate_hz(rate),
        pairing(cameras.ToleranceAt(rate)),
        counters(cameras.requests.size()),
        newest_s(cameras.requests.size(), NAN),
        blocked(cameras.requests.size(), true) {}

  Timestamp TimeOf(double monotonic_s) const { return AddSeconds(start, monotonic_s - start_s); }

  const RigCameras cameras;
  const std::function<double()> now_s;
  const Timestamp start;
  const double start_s;
  const double rate_hz;

  std::mutex mutex;
  std::condition_variable_any changed;
  bool stopping = false;
  FramePairing pairing;
  std::optional<PicturePair> newest;
  std::uint64_t pairs_replaced = 0;
  std::vector<CameraCounters> counters;
  std::vector<double> newest_s;
  std::vector<bool> blocked;  ///< a thread that has not ended
  Timestamp last_time;
};

Result<std::unique_ptr<CameraSource>> CameraSource::Open(RigCameras cameras,
                                                         CameraSourceOptions options) {
  std::vector<std::unique_ptr<CameraFeed>> feeds;
  double rate_hz = cameras.file.capture->rate_hz.value_or(0);
  const auto rules = std::make_shared<const RigCameras>(cameras);
  for (std::size_t i = 0; i < cameras.requests.size(); ++i) {
    feeds.push_back(std::make_unique<CameraFeed>(
        cameras.NameOfCamera(i), cameras.requests[i], options.open,
        [rules, i](const ImageU8& picture) { return rules->Check(i, picture); }, options.pauses));
    if (const ::palace::Status started = feeds.back()->Start(); !started) {
      return started.error();
    }
    rate_hz = rate_hz > 0 ? rate_hz : feeds.back()->rate_hz();
  }
  rate_hz = rate_hz > 0 ? rate_hz : kUsualRate_hz;
  std::optional<VehiclePose> pose = cameras.file.pose;
  const auto shared = std::make_shared<Shared>(std::move(cameras), options, rate_hz);
  std::unique_ptr<CameraSource> source(
      new CameraSource(shared, std::move(pose), std::move(options)));
  for (std::size_t i = 0; i < feeds.size(); ++i) {
    source->threads_.emplace_back(
        [shared, i, feed = std::move(feeds[i])] { Grab(shared, *feed, i); });
  }
  return source;
}

CameraSource::CameraSource(std::shared_ptr<Shared> shared, std::optional<VehiclePose> pose,
                           CameraSourceOptions options)
    : shared_(std::move(shared)),
      rig_([&] {
        auto rig = std::make_shared<StereoRig>(shared_->cameras.file.rig);
        rig->rate_hz = shared_->rate_hz;
        return rig;
      }()),
      pose_(std::move(pose)),
      options_(std::move(options)) {}

CameraSource::~CameraSource() {
  std::vector<bool> blocked;
  {
    std::unique_lock lock(shared_->mutex);
    shared_->stopping = true;
    shared_->changed.notify_all();
    const auto ended = [&] {
      return std::none_of(shared_->blocked.begin(), shared_->blocked.end(),
                          [](bool b) { return b; });
    };
    shared_->changed.wait_for(lock, std::chrono::duration<double>(options_.stop_within_s), ended);
    blocked = shared_->blocked;
  }
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    // What a thread that is left behind touches is shared with it.
    blocked[i] ? threads_[i].detach() : threads_[i].join();
  }
}

void CameraSource::Grab(const std::shared_ptr<Shared>& shared, CameraFeed& feed,
                        std::size_t index) {
  const bool both = shared->cameras.side_by_side();
  std::string problem;
  std::unique_lock lock(shared->mutex);
  while (!shared->stopping) {
    lock.unlock();
    CameraFeed::Outcome outcome = feed.Step(shared->now_s());
    if (problem != feed.counters().problem) {
      problem = feed.counters().problem;
      problem.empty() ? LogInfo(feed.counters().name + ": the camera is back")
                      : LogWarning(feed.counters().name + " lost: " + problem);
    }
    std::optional<PicturePair> halves;
    if (outcome.picture && both) {
      auto [left, right] = SplitSideBySide(outcome.picture->grey);
      const Timestamp time = shared->TimeOf(outcome.picture->time_s);
      halves = PicturePair{{time, std::move(left)}, {time, std::move(right)}};
    }
    lock.lock();
    shared->counters[index] = feed.counters();
    shared->newest_s[index] = feed.newest_s();
    if (outcome.picture && !both) {
      const auto side = index == 0 ? FramePairing::kLeft : FramePairing::kRight;
      halves = shared->pairing.Add(
          side, {shared->TimeOf(outcome.picture->time_s), std::move(outcome.picture->grey)});
    }
    if (halves) {
      shared->pairs_replaced += shared->newest ? 1 : 0;
      shared->newest = std::move(halves);
      shared->changed.notify_all();
    }
    if (outcome.pause_s > 0) {
      shared->changed.wait_for(lock, std::chrono::duration<double>(outcome.pause_s),
                               [&] { return shared->stopping; });
    }
  }
  shared->blocked[index] = false;
  shared->changed.notify_all();
}

Result<std::shared_ptr<const FrameBundle>> CameraSource::Next(std::stop_token stop) {
  std::optional<PicturePair> pair;
  Timestamp now;
  int overtaken = 0;
  {
    std::unique_lock lock(shared_->mutex);
    shared_->changed.wait_for(lock, stop, std::chrono::duration<double>(options_.heartbeat_s),
                              [&] { return shared_->newest.has_value(); });
    if (stop.stop_requested()) {
      return Error{ErrorCode::kEnd, shared_->cameras.rig_toml + ": stopped"};
    }
    pair = std::exchange(shared_->newest, std::nullopt);
    overtaken = static_cast<int>(shared_->pairs_replaced - overtaken_told_);
    overtaken_told_ = shared_->pairs_replaced;
    now = shared_->TimeOf(shared_->now_s());
    shared_->last_time = now;
  }
  std::shared_ptr<FrameBundle> bundle;
  if (pair) {
    bundle =
        BundleOf(rig_, pose_,
                 std::make_shared<const StereoFrame>(StereoFrame{
                     pair->left.time, std::move(pair->left.grey), std::move(pair->right.grey)}));
  } else {
    bundle = std::make_shared<FrameBundle>();
    bundle->rig = rig_;
  }
  bundle->sequence = ++sequence_;
  bundle->time = now;
  for (const ChannelId camera : {ChannelId::kCameraLeft, ChannelId::kCameraRight}) {
    bundle->arrival.overtaken[static_cast<std::size_t>(camera)] = overtaken;
  }
  return std::shared_ptr<const FrameBundle>(std::move(bundle));
}

SourceStatus CameraSource::Status() const {
  SourceStatus status;
  status.kind = SourceKind::kCameras;
  status.name = shared_->cameras.rig_toml;
  status.start = shared_->start;
  const std::lock_guard lock(shared_->mutex);
  const double now_s = shared_->now_s();
  status.position_s = std::max(0.0, SecondsBetween(shared_->start, shared_->last_time));
  status.cameras = shared_->counters;
  for (std::size_t i = 0; i < status.cameras.size(); ++i) {
    CameraCounters& camera = status.cameras[i];
    camera.name = shared_->cameras.NameOfCamera(i);
    camera.age_s = now_s - shared_->newest_s[i];
    camera.unpaired =
        shared_->pairing.unpaired(i == 0 ? FramePairing::kLeft : FramePairing::kRight);
  }
  status.frame_index = status.cameras.front().frames;
  return status;
}

Losses CameraSource::Lost() const {
  const std::lock_guard lock(shared_->mutex);
  Losses losses;
  losses.pairs_replaced = shared_->pairs_replaced;
  losses.pictures_unpaired = shared_->pairing.unpaired(FramePairing::kLeft) +
                             shared_->pairing.unpaired(FramePairing::kRight);
  return losses;
}

}  // namespace palace
