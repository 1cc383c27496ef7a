// One live camera kept going: read, and after an error opened again, with growing pauses.
#pragma once

#include <optional>
#include <string>

#include "engine/capture/camera_device.h"
#include "engine/model/snapshot.h"

namespace palace {

/// When a lost camera is tried again.
struct ReopenPauses {
  double first_s = 0.25;  ///< after the loss; doubled after every try that fails ...
  double longest_s = 4;   ///< ... up to this
};

/// A state machine without threads or a clock of its own.
///
///   open --read fails--> lost, pause --pause over, opens and gives a picture--> open
///
/// A picture of the wrong size, or one that cannot be decoded, is no picture: the first is a loss
/// (the device may have come back in another mode), the second is counted and read over.
/// Any one thread.
class CameraFeed {
 public:
  /// `check` judges every picture; its error says what is wrong.
  using Check = std::function<Status(const ImageU8&)>;

  CameraFeed(std::string name, CameraRequest request, OpenCamera open, Check check,
             ReopenPauses pauses = {});

  /// Opens and reads the first picture. Errors are those of the device or of `check`; then nothing
  /// is open.
  Status Start();

  /// What one step gave: a picture, or (after a loss) how long nothing is to be done.
  struct Outcome {
    std::optional<CameraPicture> picture;
    double pause_s = 0;
  };
  /// Waits in the device for the next picture, or opens it again when the pause is over at `now_s`
  /// (monotonic seconds). Call again after pause_s. The first picture is the one of Start.
  Outcome Step(double now_s);

  /// As of the last step, less `unpaired` and `age_s`, which this class cannot know.
  const CameraCounters& counters() const { return counters_; }
  /// Arrival of the newest picture; NaN before the first.
  double newest_s() const { return newest_s_; }
  double rate_hz() const { return expected_hz_; }

 private:
  Result<CameraPicture> Open();
  Result<CameraPicture> ReadFitting(CameraDevice& device);
  Outcome TryStep(double now_s);
  Outcome Lose(const Error& why, double now_s);
  void Count(const CameraPicture& picture);

  const CameraRequest request_;
  const OpenCamera open_;
  const Check check_;
  const ReopenPauses pauses_;
  std::optional<CameraDevice> device_;
  std::optional<CameraPicture> first_;  ///< of Start, until it is taken
  double pause_s_ = 0;                  ///< the next one
  double retry_at_s_ = 0;
  double expected_hz_ = 0;  ///< 0 unknown: no drops can be told
  double newest_s_ = NAN;
  std::uint64_t undecodable_ = 0;  ///< since the newest picture
  CameraCounters counters_;
};

}  // namespace palace
