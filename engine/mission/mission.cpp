#include "engine/mission/mission.h"

#include <utility>

namespace palace {
namespace {

constexpr std::size_t kMostEvents = 20000;

}  // namespace

Mission::Mission(MissionOptions options) : options_(std::move(options)) {
  memory_.approvals_given = options_.approvals_before;
  memory_.requests_made = options_.requests_before;
  events_told_ = options_.events_before;
}

MissionOptions Mission::OptionsToGoOn() const {
  MissionOptions options = options_;
  options.approvals_before = memory_.approvals_given;
  options.requests_before = memory_.requests_made;
  options.events_before = events_told_;
  return options;
}

Status Mission::Apply(const EngineCommand& command, const MissionInputs::Session& session) {
  MissionAnswer answer = palace::Apply(options_, memory_, command, session);
  memory_ = std::move(answer.memory);
  Take(std::move(answer.effects));
  return std::move(answer.status);
}

void Mission::Update(const MissionInputs& inputs) {
  MissionStep step = Step(options_, memory_, inputs);
  memory_ = std::move(step.memory);
  Take(std::move(step.effects));
}

void Mission::DropApproval(std::string_view why) {
  MissionStep step = palace::DropApproval(options_, memory_, why);
  memory_ = std::move(step.memory);
  Take(std::move(step.effects));
}

void Mission::AddEvent(Timestamp time, EventKind kind, std::string text) {
  Tell({time, kind, std::move(text)});
}

void Mission::Tell(Event event) {
  std::vector<Event>& events = events_.Edit();
  if (events.size() >= kMostEvents) {
    events.erase(events.begin(), events.begin() + kMostEvents / 2);
  }
  event.number = ++events_told_;
  events.push_back(std::move(event));
}

std::vector<VehicleMessage> Mission::TakeMessages() { return std::exchange(outbox_, {}); }

void Mission::Take(MissionEffects effects) {
  for (Event& event : effects.events) {
    Tell(std::move(event));
  }
  for (VehicleMessage& message : effects.messages) {
    outbox_.push_back(std::move(message));
  }
}

}  // namespace palace
