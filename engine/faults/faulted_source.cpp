#include "engine/faults/faulted_source.h"

#include <utility>

namespace palace {
namespace {

constexpr double kHeartbeat_s = 0.2;
constexpr double kSlack_s = 1e-6;

}  // namespace

FaultedSource::FaultedSource(std::shared_ptr<Source> source, std::shared_ptr<VehicleLink> link,
                             std::uint64_t seed)
    : source_(std::move(source)),
      link_(std::move(link)),
      injector_(seed),
      bundles_({}, /*follow_simulation=*/false) {}

Result<std::shared_ptr<const FrameBundle>> FaultedSource::Next(std::stop_token stop) {
  do {
    Result<std::shared_ptr<const FrameBundle>> next = source_->Next(stop);
    if (!next) {
      return next;
    }
    struck_ = struck_ || injector_.touched();
    Take(**next);
    if (!struck_) {
      HandOnUntouched(**next);
      return next;
    }
  } while (!bundles_.ready() && injector_.now_s() - delivered_s_ < kHeartbeat_s - kSlack_s);
  delivered_s_ = injector_.now_s();
  auto delivered = std::make_shared<FrameBundle>(*bundles_.HandOn(delivered_s_));
  delivered->injected_faults = injector_.TakeActing();
  delivered->sequence = ++sequence_;
  return std::shared_ptr<const FrameBundle>(std::move(delivered));
}

/// Clocks and counters of the way over the messages know what a fault later finds them at.
void FaultedSource::HandOnUntouched(const FrameBundle& bundle) {
  delivered_s_ = injector_.now_s();
  if (bundles_.ready()) {
    (void)bundles_.HandOn(delivered_s_);
  }
  sequence_ = bundle.sequence;
}

void FaultedSource::Take(const FrameBundle& bundle) {
  const std::vector<WireMessage> arrived = injector_.Strike(bundle);
  for (const WireMessage& message : arrived) {
    bundles_.Take(message, injector_.now_s());
  }
  const std::lock_guard lock(mutex_);
  clock_offset_us_ = injector_.clock_offset_us();
  losses_ = struck_ ? bundles_.Count() : source_->Lost();
}

Losses FaultedSource::Lost() const {
  const std::lock_guard lock(mutex_);
  return losses_;
}

bool FaultedSource::MovesClock(const VehicleMessage& message, std::int64_t& offset_us) const {
  const std::lock_guard lock(mutex_);
  offset_us = clock_offset_us_;
  return offset_us != 0 && std::holds_alternative<PositionEstimate>(message);
}

bool FaultedSource::Send(const VehicleMessage& message) {
  if (!link_) {
    return false;
  }
  std::int64_t offset_us = 0;
  if (!MovesClock(message, offset_us)) {
    return link_->Send(message);
  }
  VehicleMessage mapped = OnClock(message, -offset_us);
  link_->Seal(mapped);
  return link_->Send(mapped);
}

void FaultedSource::Seal(VehicleMessage& message) {
  std::int64_t offset_us = 0;
  if (link_ && !MovesClock(message, offset_us)) {
    link_->Seal(message);
  }
}

void FaultedSource::Hear(const FrameBundle& bundle) {
  if (link_) {
    link_->Hear(bundle);
  }
}

AuthorityStatus FaultedSource::Authority() const {
  return link_ ? link_->Authority() : AuthorityStatus{};
}

void FaultedSource::Announce(const EngineSnapshot& snapshot) {
  if (link_) {
    link_->Announce(snapshot);
  }
}

}  // namespace palace
