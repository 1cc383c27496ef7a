#include "engine/faults/fault_injector.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/faults/fault_text.h"
#include "engine/wire/convert.h"

namespace palace {

FaultInjector::FaultInjector(std::uint64_t seed, ChannelNames channels)
    : channels_(std::move(channels)), pictures_(seed), vehicle_(seed), messages_(seed, channels_) {}

Result<int> FaultInjector::AddLocked(const Fault& fault) {
  if (const Status sound = CheckFault(fault); !sound) {
    return sound.error();
  }
  if (faults_.size() >= kMostFaults) {
    return UsageError("a flight has " + std::to_string(kMostFaults) +
                      " faults at most; this would be one more");
  }
  faults_.push_back(fault);
  return static_cast<int>(faults_.size());
}

Result<int> FaultInjector::Add(const Fault& fault) {
  const std::lock_guard lock(mutex_);
  return AddLocked(fault);
}

Status FaultInjector::Add(const FaultPlan& plan) {
  for (const Fault& fault : plan.faults) {
    if (const Result<int> added = Add(fault); !added) {
      return added.error();
    }
  }
  return Ok();
}

Result<int> FaultInjector::AddFromNow(Fault fault) {
  const std::lock_guard lock(mutex_);
  // People read them: whole milliseconds.
  const auto from_now = [&](double s) { return std::round(1000 * (now_s_ + s)) / 1000; };
  fault.from_s = from_now(fault.from_s);
  fault.to_s = from_now(fault.to_s);
  return AddLocked(fault);
}

void FaultInjector::End(int number) {
  const std::lock_guard lock(mutex_);
  const auto i = static_cast<std::size_t>(number - 1);
  if (number >= 1 && i < faults_.size()) {
    faults_[i].to_s = std::min(faults_[i].to_s, now_s_);
  }
}

std::vector<InjectedFault> FaultInjector::Faults() const {
  const std::lock_guard lock(mutex_);
  std::vector<InjectedFault> all;
  for (const Fault& fault : faults_) {
    all.push_back(
        {static_cast<int>(all.size()) + 1, fault, fault.ActsAt(now_s_), fault.to_s <= now_s_});
  }
  return all;
}

bool FaultInjector::touched() const {
  const std::lock_guard lock(mutex_);
  return !faults_.empty();
}

double FaultInjector::now_s() const {
  const std::lock_guard lock(mutex_);
  return now_s_;
}

std::vector<WireMessage> FaultInjector::Strike(const FrameBundle& bundle) {
  start_ = start_.value_or(bundle.time);
  const double now_s = SecondsBetween(*start_, bundle.time);
  std::vector<Fault> faults;
  {
    const std::lock_guard lock(mutex_);
    now_s_ = now_s;
    faults = faults_;
  }
  for (const Fault& fault : faults) {
    if (!fault.ActsAt(now_s)) {
      continue;
    }
    std::string words = FaultWords(fault);
    if (std::find(acted_.begin(), acted_.end(), words) == acted_.end()) {
      acted_.push_back(std::move(words));
    }
  }
  FrameBundle struck = bundle;
  if (struck.stereo) {
    struck.stereo = pictures_.Apply(struck.stereo, faults, now_s);
  }
  vehicle_.Apply(struck, faults, now_s);
  return messages_.Apply(EncodeBundle(struck, channels_), faults, now_s);
}

std::vector<std::string> FaultInjector::TakeActing() { return std::exchange(acted_, {}); }

}  // namespace palace
