// Where a flight is recorded: what passed the doors of the engine, in order.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/model/recording.h"
#include "engine/model/snapshot.h"

namespace palace {

/// One engine pass: commands applied before the bundle, the bundle, what came out of it. Without a
/// bundle: what was said while time stood still.
struct RecordItem {
  std::vector<EngineCommand> commands;
  std::shared_ptr<const FrameBundle> bundle;
  std::shared_ptr<const EngineSnapshot> snapshot;
  std::vector<VehicleMessage> sent;
  std::vector<Event> notes;          ///< of what happened to the engine itself
  std::uint64_t pairs_left_out = 0;  ///< pictures that a slow disk cost here
};

/// Called from the recorder's thread only.
class RecordSink {
 public:
  virtual ~RecordSink() = default;
  /// Ok: it is in the hands of the operating system. After a failure the next may succeed again.
  virtual Status Record(const RecordItem& item) = 0;
  virtual Status Close() = 0;
  virtual std::string Path() const = 0;
  virtual RecordState State() const { return {}; }
};

}  // namespace palace
