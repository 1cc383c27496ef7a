// FaultedSource: a source round a source, with faults between.
//
//   bundle -> FaultInjector -> messages -> LiveBundles
//
// What comes out has gone the whole way of a vehicle on a bus, through the decoders and counters of
// a live station, and in lockstep: time advances only in Next(), so a seed and a list of faults
// give one flight to the bit, and what is recorded behind it replays without it. Until a fault is
// added the source's own bundles come out, untouched. A bus that has nothing whole for 0.2 s of
// flight gives a bundle without pictures, as a live source does. The station's clock is the true
// time of flight, so that a step of the vehicle's shows. What acts is told in
// FrameBundle::injected_faults.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "engine/faults/fault_injector.h"
#include "engine/runtime/source.h"
#include "engine/runtime/vehicle_link.h"
#include "engine/wire/live_bundles.h"

namespace palace {

class FaultedSource final : public Source, public VehicleLink {
 public:
  /// `link` may be null: then nothing is sent.
  FaultedSource(std::shared_ptr<Source> source, std::shared_ptr<VehicleLink> link,
                std::uint64_t seed);

  /// Add, AddFromNow, End and Faults of it may be called from any thread while this flies.
  FaultInjector& faults() { return injector_; }
  Result<int> Add(const Fault& fault) { return injector_.Add(fault); }
  double now_s() const { return injector_.now_s(); }

  Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token stop) override;
  bool IsLockstep() const override { return source_->IsLockstep(); }
  SourceStatus Status() const override { return source_->Status(); }
  Losses Lost() const override;
  void Control(const PlaybackControl& control) override { source_->Control(control); }
  ::palace::Status Change(const SimulationChange& change) override {
    return source_->Change(change);
  }

  bool Send(const VehicleMessage& message) override;
  void Seal(VehicleMessage& message) override;
  void Hear(const FrameBundle& bundle) override;
  AuthorityStatus Authority() const override;
  void Announce(const EngineSnapshot& snapshot) override;
  std::uint64_t Unsent() const override { return link_ ? link_->Unsent() : 0; }

 private:
  void Take(const FrameBundle& bundle);
  void HandOnUntouched(const FrameBundle& bundle);
  /// The vehicle takes estimates on its own clock: their stamps are moved, so sealed when sent.
  bool MovesClock(const VehicleMessage& message, std::int64_t& offset_us) const;

  const std::shared_ptr<Source> source_;
  const std::shared_ptr<VehicleLink> link_;
  FaultInjector injector_;
  LiveBundles bundles_;
  bool struck_ = false;  ///< bundles come from bundles_
  std::uint64_t sequence_ = 0;
  double delivered_s_ = 0;
  mutable std::mutex mutex_;  ///< guards what other threads read
  Losses losses_;
  std::int64_t clock_offset_us_ = 0;
};

}  // namespace palace
