#include "engine/faults/faulted_source.h"

#include <utility>

#include "engine/wire/convert.h"

namespace palace {
namespace {

constexpr double kHeartbeat_s = 0.2;
constexpr double kSlack_s = 1e-6;

}  // namespace

FaultedSource::FaultedSource(std::shared_ptr<Source> source, std::shared_ptr<VehicleLink> link,
                             std::uint64_t seed)
    : source_(std::move(source)),
      link_(std::move(link)),
      pictures_(seed),
      vehicle_(seed),
      messages_(seed),
      bundles_({}, /*follow_simulation=*/false) {}

::palace::Status FaultedSource::Add(const Fault& fault) {
  ::palace::Status sound = CheckFault(fault);
  if (sound) {
    faults_.push_back(fault);
  }
  return sound;
}

Result<std::shared_ptr<const FrameBundle>> FaultedSource::Next(std::stop_token stop) {
  do {
    Result<std::shared_ptr<const FrameBundle>> next = source_->Next(stop);
    if (!next) {
      return next;
    }
    Take(**next);
  } while (!bundles_.ready() && now_s_ - delivered_s_ < kHeartbeat_s - kSlack_s);
  delivered_s_ = now_s_;
  auto delivered = std::make_shared<FrameBundle>(*bundles_.HandOn(now_s_));
  ++delivered->sequence;  // a flight counts from 1
  return std::shared_ptr<const FrameBundle>(std::move(delivered));
}

void FaultedSource::Take(const FrameBundle& bundle) {
  start_ = start_.value_or(bundle.time);
  now_s_ = SecondsBetween(*start_, bundle.time);
  FrameBundle struck = bundle;
  if (struck.stereo) {
    struck.stereo = pictures_.Apply(struck.stereo, faults_, now_s_);
  }
  vehicle_.Apply(struck, faults_, now_s_);
  for (const WireMessage& message :
       messages_.Apply(EncodeBundle(struck, ChannelNames{}), faults_, now_s_)) {
    bundles_.Take(message, now_s_);
  }
  const std::lock_guard lock(mutex_);
  clock_offset_us_ = vehicle_.clock_offset_us();
  losses_ = bundles_.Count();
}

Losses FaultedSource::Lost() const {
  const std::lock_guard lock(mutex_);
  return losses_;
}

bool FaultedSource::Send(const VehicleMessage& message) {
  std::int64_t offset_us = 0;
  {
    const std::lock_guard lock(mutex_);
    offset_us = clock_offset_us_;
  }
  if (!link_) {
    return false;
  }
  VehicleMessage mapped = OnClock(message, -offset_us);
  link_->Seal(mapped);
  return link_->Send(mapped);
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
