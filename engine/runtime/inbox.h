// Inbox: the two doors into the engine thread, frames and commands.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <stop_token>
#include <vector>

#include "engine/model/frame_bundle.h"
#include "engine/model/mission/losses.h"

namespace palace {

/// Frames of a lockstep source are handed over one by one and none is dropped. Of a live source the
/// newest pictures win; what came with the older ones is joined to them. Commands are never
/// dropped, and wake the engine at once.
class Inbox {
 public:
  struct Batch {
    std::shared_ptr<const FrameBundle> bundle;  ///< null: commands only, or Wake
    std::vector<EngineCommand> commands;
  };

  void Post(EngineCommand command);
  /// Take returns although nothing came: the session changed, a paused source for one.
  void Wake();
  /// Live sources, one thread: joins a frame that waits. Never waits itself.
  void PutNewest(std::shared_ptr<const FrameBundle> bundle);
  /// Lockstep sources: waits until the frame was taken and processed. False when stopped.
  bool PutAndWait(std::shared_ptr<const FrameBundle> bundle, std::stop_token stop);
  /// Waits for a frame or a command, whichever comes first. False when stopped.
  bool Take(Batch& batch, std::stop_token stop);
  /// The engine is done with the last batch.
  void Finished();
  /// The commands that wait, for a caller without threads.
  std::vector<EngineCommand> TakeCommands();
  /// What PutNewest had to leave out so far: pairs_replaced, samples_overflowed.
  Losses losses() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::shared_ptr<const FrameBundle> bundle_;
  std::vector<EngineCommand> commands_;
  Losses losses_;
  bool busy_ = false;
  bool woken_ = false;
};

}  // namespace palace
