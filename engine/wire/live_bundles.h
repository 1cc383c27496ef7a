// LiveBundles: messages of a vehicle as they arrive, to bundles on the station's clock. What a live
// source does without a bus: no sockets, no clock of its own, every time is passed in.
//
// A bundle's time is the vehicle's clock as the station's monotonic one tells it (VehicleClock) at
// the moment the bundle is handed on: ages are the station's, and grow whether or not anything
// arrives. It runs back at a discontinuity only. Stamps that cannot be are refused and counted per
// channel. Newest wins: of bundles that wait, the older pictures are dropped and their samples
// joined to the newest. Sequence numbers are its own.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "engine/core/vehicle_clock.h"
#include "engine/model/frame_bundle.h"
#include "engine/model/mission/losses.h"
#include "engine/wire/bundle_assembler.h"

namespace palace {

class LiveBundles {
 public:
  /// `follow_simulation`: the clock of a vehicle that says it is simulated may run slow, as the
  /// computer does that simulates it.
  LiveBundles(ChannelNames channels, bool follow_simulation);
  LiveBundles(const LiveBundles&) = delete;
  LiveBundles& operator=(const LiveBundles&) = delete;

  /// A message that was taken at this station time.
  void Take(const WireMessage& message, double now_s);
  /// Why the last message was not decoded; empty when it was.
  const std::string& problem() const { return assembler_.problem(); }
  /// What the receiver counts: messages of ours that waited until newer ones pushed them out.
  void NoteOverflow(const BusTraffic& traffic);
  /// This machine did not run for so long until now; told with the next bundle.
  void Stalled(double seconds, double now_s) {
    stalled_s_ += seconds;
    clock_.Stalled(seconds, now_s);
  }
  bool ready() const { return ready_ != nullptr; }
  /// What is ready, as one bundle; without anything ready what is pending, without pictures.
  std::shared_ptr<const FrameBundle> HandOn(double now_s);
  Losses Count() const;

 private:
  bool Accepts(const std::string& channel, Timestamp stamp);
  void StartAnewAfterStep();
  /// Joins it to what is ready: of pictures only the newest pair is kept.
  void MakeReady(std::shared_ptr<const FrameBundle> bundle);

  ChannelNames channels_;
  bool follow_simulation_;
  VehicleClock clock_;
  BundleAssembler assembler_;
  std::shared_ptr<const FrameBundle> ready_;
  double taken_s_ = 0;                    ///< of the message at hand
  bool stepped_ = false;                  ///< the clock, by the message at hand
  double stalled_s_ = 0, stepped_s_ = 0;  ///< since the last bundle
  std::optional<Timestamp> last_time_;
  std::uint64_t sequence_ = 0;
  Losses joined_;  ///< what joining bundles that waited here left out
  /// Messages pushed out in the receiver: since the session began, and told with a bundle.
  std::array<std::uint64_t, kChannelCount> overflowed_{}, overflow_told_{};
};

}  // namespace palace
