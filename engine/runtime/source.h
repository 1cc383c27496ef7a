// Where frames come from: the simulator, an LCM bus, a log, a folder of images, live cameras.
#pragma once

#include <memory>
#include <stop_token>

#include "engine/core/result.h"
#include "engine/model/command.h"
#include "engine/model/frame_bundle.h"
#include "engine/model/mission/losses.h"
#include "engine/model/snapshot.h"

namespace palace {

/// Called from one thread, except Control, Change, Status and Lost, which any thread may call.
class Source {
 public:
  virtual ~Source() = default;
  /// Waits for the next bundle (or until stop is requested, or paused). ErrorCode::kEnd at the end
  /// or when stopped. A lockstep source advances its time only here.
  virtual Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token stop) = 0;
  /// True: every bundle must be processed (simulator, log). False: newest wins (live).
  virtual bool IsLockstep() const = 0;
  virtual SourceStatus Status() const = 0;
  /// What was lost between the sender and Next, so far.
  virtual Losses Lost() const { return {}; }
  /// Play, pause, step, seek, speed; ignored by sources that cannot.
  virtual void Control(const PlaybackControl& control) = 0;
  /// Changes what is simulated, from the next bundle on; a checked change (CheckChange). Refused by
  /// all but a simulation in this program.
  virtual ::palace::Status Change(const SimulationChange&) {
    return UnavailableError("only the built-in simulation can be changed while it runs");
  }
};

}  // namespace palace
