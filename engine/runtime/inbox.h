// Inbox: the two doors into the engine thread, frames and commands.
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <stop_token>
#include <vector>

#include "engine/model/frame_bundle.h"

namespace palace {

/// Frames of a lockstep source are handed over one by one and none is dropped; of a live source the
/// newest wins. Commands are never dropped.
class Inbox {
 public:
  struct Batch {
    std::shared_ptr<const FrameBundle> bundle;  ///< null: commands only
    std::vector<EngineCommand> commands;
  };

  void Post(EngineCommand command);
  /// Live sources: replaces a frame that waits. Returns how many frames were dropped.
  std::size_t PutNewest(std::shared_ptr<const FrameBundle> bundle);
  /// Lockstep sources: waits until the frame was taken and processed. False when stopped.
  bool PutAndWait(std::shared_ptr<const FrameBundle> bundle, std::stop_token stop);
  /// Waits for a frame, or for commands while no frame comes (`idle`). False when stopped.
  bool Take(Batch& batch, std::stop_token stop);
  /// The engine is done with the last batch.
  void Finished();
  /// No frame is to be expected soon: the source is paused or ended.
  void SetIdle(bool idle);
  /// The commands that wait, for a caller without threads.
  std::vector<EngineCommand> TakeCommands();

 private:
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::shared_ptr<const FrameBundle> bundle_;
  std::vector<EngineCommand> commands_;
  bool idle_ = false;
  bool busy_ = false;
};

}  // namespace palace
