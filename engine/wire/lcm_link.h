// LcmLink: the way to a vehicle on an LCM bus, and its counterpart on the vehicle's side.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "engine/model/snapshot.h"
#include "engine/runtime/vehicle_link.h"
#include "engine/trust/station_session.h"
#include "engine/wire/bus.h"
#include "engine/wire/channels.h"
#include "engine/wire/output_encoder.h"

namespace palace {

/// Publishes POSITION_ESTIMATE, COMMAND, SESSION_REQUEST and ABORT. Any thread may send. Keeps the
/// session with the vehicle; estimates leave only while this station commands.
class LcmLink final : public VehicleLink {
 public:
  explicit LcmLink(std::shared_ptr<Bus> bus, ChannelNames channels = {}, StationTrust trust = {});
  /// Gives command back, if this station has it.
  ~LcmLink() override;
  bool Send(const VehicleMessage& message) override;
  void Seal(VehicleMessage& message) override;
  void Hear(const FrameBundle& bundle) override;
  AuthorityStatus Authority() const override;
  /// A message to the vehicle that was heard on the bus: own ones come back too. Any thread.
  void Overhear(const WireMessage& message);
  /// The station's own news: MISSION, SLAD_SETTINGS, SITE_PROPOSAL, TRACKER_STATUS, STATION_STATUS,
  /// EVENT. One thread.
  void Announce(const EngineSnapshot& snapshot) override;

  std::uint64_t sent() const { return sent_; }
  std::uint64_t Unsent() const override { return unsent_; }

 private:
  bool Publish(const WireMessage& message);
  void KeepSession();
  bool IsOwnAbort(std::uint64_t id, double now_s) const;

  std::shared_ptr<Bus> bus_;
  ChannelNames channels_;
  OutputEncoder outputs_;
  mutable std::mutex mutex_;  ///< guards what follows, for the time of a mac
  StationSession session_;
  /// Who has just come does not know yet who commands, so nobody is a stranger to him.
  static constexpr double kAuthorityWait_s = 2;
  bool knows_authority_ = false;
  std::optional<double> vehicle_since_s_;
  ForeignTraffic foreign_;
  double foreign_s_ = 0;
  struct SentAbort {
    std::uint64_t id = 0;
    double at_s = -1e9;
  };
  std::array<SentAbort, 8> own_aborts_{};  ///< the newest, by turns
  std::size_t aborts_sent_ = 0;
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
  /// The same already encoded, of that moment.
  Status Publish(const std::vector<WireMessage>& messages, Timestamp time);
  std::uint64_t received() const { return received_; }
  std::uint64_t refused() const { return refused_; }
  /// Why the newest message that could not be read was refused; empty when none was. It is answered
  /// too, with command id 0, at most once a second.
  const std::string& refusal() const { return refusal_; }

 private:
  VehicleServer(std::shared_ptr<Bus> bus, VehicleLink& vehicle, ChannelNames channels);
  void Take(const WireMessage& message);
  void AnswerUnread(const WireMessage& message);

  std::shared_ptr<Bus> bus_;
  VehicleLink& vehicle_;
  ChannelNames channels_;
  std::uint64_t received_ = 0;
  std::uint64_t refused_ = 0;
  std::string refusal_;
  double answered_s_ = -1e9;
  std::atomic<std::int64_t> newest_us_{0};  ///< of what the vehicle measured
};

}  // namespace palace
