// FaultedSource: a source round a source, with faults between.
//
//   bundle -> CameraFaults, VehicleFaults -> encoded messages -> LinkFaults -> LiveBundles
//
// What comes out has gone the whole way of a vehicle on a bus, through the decoders and counters of
// a live station, and in lockstep: time advances only in Next(), so a seed and a list of faults
// give one flight to the bit, and what is recorded behind it replays without it. Without faults
// bundles come out equal to the bit. A bus that has nothing whole for 0.2 s of flight gives a
// bundle without pictures, as a live source does. The station's clock is the true time of flight,
// so that a step of the vehicle's shows.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/faults/camera_faults.h"
#include "engine/faults/fault.h"
#include "engine/faults/link_faults.h"
#include "engine/faults/vehicle_faults.h"
#include "engine/runtime/source.h"
#include "engine/runtime/vehicle_link.h"
#include "engine/wire/live_bundles.h"

namespace palace {

class FaultedSource final : public Source, public VehicleLink {
 public:
  /// `link` may be null: then nothing is sent.
  FaultedSource(std::shared_ptr<Source> source, std::shared_ptr<VehicleLink> link,
                std::uint64_t seed);

  /// From the thread that calls Next(). Refused as CheckFault says.
  ::palace::Status Add(const Fault& fault);
  /// Seconds of true flight since the first bundle; that of the newest bundle taken.
  double now_s() const { return now_s_; }

  Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token stop) override;
  bool IsLockstep() const override { return source_->IsLockstep(); }
  SourceStatus Status() const override { return source_->Status(); }
  Losses Lost() const override;
  void Control(const PlaybackControl& control) override { source_->Control(control); }
  ::palace::Status Change(const SimulationChange& change) override {
    return source_->Change(change);
  }

  /// Sealed here: the vehicle seals and checks on its own clock.
  bool Send(const VehicleMessage& message) override;
  void Hear(const FrameBundle& bundle) override;
  AuthorityStatus Authority() const override;
  void Announce(const EngineSnapshot& snapshot) override;
  std::uint64_t Unsent() const override { return link_ ? link_->Unsent() : 0; }

 private:
  void Take(const FrameBundle& bundle);

  const std::shared_ptr<Source> source_;
  const std::shared_ptr<VehicleLink> link_;
  std::vector<Fault> faults_;
  CameraFaults pictures_;
  VehicleFaults vehicle_;
  LinkFaults messages_;
  LiveBundles bundles_;
  std::optional<Timestamp> start_;
  double now_s_ = 0;
  double delivered_s_ = 0;
  mutable std::mutex mutex_;  ///< guards what other threads read
  Losses losses_;
  std::int64_t clock_offset_us_ = 0;
};

}  // namespace palace
