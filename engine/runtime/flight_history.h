// The descent history: one sample a frame, for plots and reports.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "engine/model/snapshot.h"

namespace palace {

/// Keeps the newest samples. Copies on write, so that a published history never changes.
class FlightHistory {
 public:
  void Reset(std::vector<HistorySample> samples) { samples_ = std::move(samples); }
  void Add(const HistorySample& sample);
  std::shared_ptr<const std::vector<HistorySample>> Publish() const;

 private:
  std::vector<HistorySample> samples_;
};

/// The history sample of a snapshot that is complete but for its history. While the vehicle is
/// silent for longer than the link may be (kLinkSilent_s), nothing of it is measured: no line goes
/// on, the band of the filter still grows.
HistorySample SampleOf(const EngineSnapshot& snapshot, const FrameBundle& bundle);

}  // namespace palace
