// Where a flight is recorded: what passed the doors of the engine, in order.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/snapshot.h"

namespace palace {

/// One engine pass: commands applied before the bundle, the bundle, what came out of it.
struct RecordItem {
  std::vector<EngineCommand> commands;
  std::shared_ptr<const FrameBundle> bundle;
  std::shared_ptr<const EngineSnapshot> snapshot;
  std::vector<VehicleMessage> sent;
};

/// Called from the recorder's thread only.
class RecordSink {
 public:
  virtual ~RecordSink() = default;
  virtual Status Record(const RecordItem& item) = 0;
  virtual Status Close() = 0;
  virtual std::string Path() const = 0;
};

}  // namespace palace
