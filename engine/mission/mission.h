// Mission: holds the memory of the state machine between steps, and what the steps brought about
// until somebody takes it. Every rule is in the pure functions of step.h.
//
// A step that fails half-way leaves the mission as it was before.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/shared_value.h"
#include "engine/mission/geometry.h"
#include "engine/mission/step.h"

namespace palace {

class Mission {
 public:
  explicit Mission(MissionOptions options);

  /// Refuses with the reason (I22), which is also in the events.
  Status Apply(const EngineCommand& command, const MissionInputs::Session& session);
  void Update(const MissionInputs& inputs);
  /// Settings were applied while armed or approved (I13).
  void DropApproval(std::string_view why);

  /// For a mission that takes over from this one: the same station, the numbers go on.
  MissionOptions OptionsToGoOn() const;
  const MissionMemory& memory() const { return memory_; }
  const MissionStatus& status() const { return memory_.status; }
  const std::optional<LandingSite>& alternative() const { return memory_.alternative; }
  bool WantsTracking() const { return WatchesSite(memory_) && !GoesRound(memory_); }
  bool VisionAllowed() const { return memory_.vision_allowed && !GoesRound(memory_); }
  /// ARMED and later: moved limits preview only.
  bool SettingsFrozen() const { return memory_.status.state >= MissionState::kArmed; }
  bool DropsWithSettings() const { return palace::DropsWithSettings(memory_.status); }

  const std::vector<Event>& events() const { return *events_; }
  /// The same, to keep: never changes.
  std::shared_ptr<const std::vector<Event>> SharedEvents() const { return events_.Share(); }
  void AddEvent(Timestamp time, EventKind kind, std::string text);
  /// Those of a mission before this one, with their numbers.
  void GoOnAfter(const std::vector<Event>& events) { events_.Edit() = events; }
  /// Messages for the vehicle since the last call, oldest first. Always empty in replay.
  std::vector<VehicleMessage> TakeMessages();

 private:
  void Take(MissionEffects effects);
  void Tell(Event event);

  MissionOptions options_;
  MissionMemory memory_;
  SharedValue<std::vector<Event>> events_;
  std::uint64_t events_told_ = 0;  ///< also those that are not kept any more
  std::vector<VehicleMessage> outbox_;
};

}  // namespace palace
