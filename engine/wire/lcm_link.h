// LcmLink: the way to a vehicle on an LCM bus, and its counterpart on the vehicle's side.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "engine/model/snapshot.h"
#include "engine/runtime/vehicle_link.h"
#include "engine/wire/bus.h"
#include "engine/wire/channels.h"
#include "engine/wire/output_encoder.h"

namespace palace {

/// Publishes POSITION_ESTIMATE, COMMAND and ABORT. Any thread may send.
class LcmLink final : public VehicleLink {
 public:
  explicit LcmLink(std::shared_ptr<Bus> bus, ChannelNames channels = {});
  void Send(const VehicleMessage& message) override;
  /// The station's own news: MISSION, SLAD_SETTINGS, SITE_PROPOSAL, TRACKER_STATUS, STATION_STATUS,
  /// EVENT. One thread.
  void Announce(const EngineSnapshot& snapshot) override;

  std::uint64_t sent() const { return sent_; }
  std::uint64_t Unsent() const override { return unsent_; }

 private:
  void Publish(const WireMessage& message);

  std::shared_ptr<Bus> bus_;
  ChannelNames channels_;
  OutputEncoder outputs_;
  std::atomic<std::uint64_t> sent_{0};
  std::atomic<std::uint64_t> unsent_{0};
  std::atomic<std::int64_t> newest_us_{0};  ///< data time commands are stamped with
};

/// The vehicle's end: hands what stations send to `vehicle`, publishes what the vehicle measures.
/// One thread. `vehicle` must outlive it.
class VehicleServer {
 public:
  static Result<std::unique_ptr<VehicleServer>> Create(std::shared_ptr<Bus> bus,
                                                       VehicleLink& vehicle,
                                                       ChannelNames channels = {});
  /// Handles the messages that wait, a thousand at most; waits up to `timeout_ms` for the first.
  Status Poll(int timeout_ms);
  Status Publish(const FrameBundle& bundle);
  std::uint64_t received() const { return received_; }
  std::uint64_t refused() const { return refused_; }

 private:
  VehicleServer(std::shared_ptr<Bus> bus, VehicleLink& vehicle, ChannelNames channels);
  void Take(const WireMessage& message);

  std::shared_ptr<Bus> bus_;
  VehicleLink& vehicle_;
  ChannelNames channels_;
  std::uint64_t received_ = 0;
  std::uint64_t refused_ = 0;
};

}  // namespace palace
