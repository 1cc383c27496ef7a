// OverheardLink: a link to the vehicle, and the newest position that the station sent over it.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "engine/runtime/vehicle_link.h"

namespace palace {

/// Of engines without threads: what is sent is read by the thread that sends.
class OverheardLink final : public VehicleLink {
 public:
  explicit OverheardLink(std::shared_ptr<VehicleLink> link) : link_(std::move(link)) {}

  bool Send(const VehicleMessage& message) override {
    if (const auto* estimate = std::get_if<PositionEstimate>(&message)) {
      newest_ = *estimate;
    }
    return link_->Send(message);
  }
  void Seal(VehicleMessage& message) override { link_->Seal(message); }
  void Hear(const FrameBundle& bundle) override { link_->Hear(bundle); }
  AuthorityStatus Authority() const override { return link_->Authority(); }
  void Announce(const EngineSnapshot& snapshot) override { link_->Announce(snapshot); }
  std::uint64_t Unsent() const override { return link_->Unsent(); }

  const std::optional<PositionEstimate>& newest() const { return newest_; }

 private:
  std::shared_ptr<VehicleLink> link_;
  std::optional<PositionEstimate> newest_;
};

}  // namespace palace
