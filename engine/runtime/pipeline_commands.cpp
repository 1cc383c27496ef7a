// The pipeline's door for commands: limits here, everything else to the mission.
#include "engine/runtime/pipeline_pass.h"

namespace palace {
namespace {

bool IsSettingCommand(const EngineCommand& command) {
  return std::holds_alternative<SetSetting>(command.action) ||
         std::holds_alternative<ApplySettings>(command.action) ||
         std::holds_alternative<DiscardSettings>(command.action);
}

}  // namespace

LimitsApply Pipeline::WhenLimitsApply(bool of_record) const {
  const bool reviewed = FollowsRecord(role_) && !of_record;
  if (reviewed || !mission_.SettingsFrozen()) {
    return LimitsApply::kAtOnce;
  }
  return mission_.status().state == MissionState::kDescending ? LimitsApply::kNotNow
                                                              : LimitsApply::kWhenApplied;
}

void Pipeline::ApplySettingCommand(Pass& pass, const EngineCommand& command) {
  const bool of_record = command.origin == CommandOrigin::kReplay;
  const LimitsApply when = WhenLimitsApply(of_record);
  const bool preview_only = when != LimitsApply::kAtOnce;
  Status done = Ok();
  std::string text;
  if (const auto* set = std::get_if<SetSetting>(&command.action)) {
    const SettingInfo* info = FindSetting(set->name);
    const Settings& moved = of_record ? settings_.recorded() : settings_.applied();
    const double before = info ? GetSetting(moved, set->name) : 0;
    done = of_record ? settings_.SetRecorded(set->name, set->value, preview_only)
                     : settings_.Set(set->name, set->value, preview_only);
    if (done) {
      const std::string to = FormatSetting(*info, set->value);
      text = preview_only && set->value == before
                 ? info->label + " no longer previewed, stays " + to
                 : info->label + (preview_only ? " previewed " : " ") +
                       FormatSetting(*info, before) + " to " + to;
    }
  } else if (std::holds_alternative<ApplySettings>(command.action)) {
    if (when == LimitsApply::kNotNow) {
      done = InvalidError("limits cannot be applied during the descent, only previewed");
    } else if (of_record || settings_.previewing()) {
      mission_.DropApproval("limits applied");
      of_record ? settings_.ApplyRecorded() : settings_.Apply();
      text = "Previewed limits applied";
    }
  } else {
    of_record ? settings_.DiscardRecorded() : settings_.Discard();
    text = "Preview discarded";
  }
  if (!done) {
    pass.Note(DiagnosticLevel::kWarning, "settings", done.error().message);
    mission_.AddEvent(pass.snapshot->time, EventKind::kSetting, "Refused: " + done.error().message);
    return;
  }
  if (!FollowsRecord(role_)) {
    settings_.FollowApplied();
  } else if (!of_record) {
    redecisions_.Forget();
  }
  pass.settings_moved = true;
  if (!text.empty()) {
    mission_.AddEvent(pass.snapshot->time, EventKind::kSetting, std::move(text));
  }
}

void Pipeline::ApplyCommands(Pass& pass) {
  if (FollowsRecord(role_) && pass.bundle && pass.bundle != last_bundle_) {
    std::vector<EngineCommand> recorded = pass.bundle->recorded_commands;
    for (EngineCommand& command : recorded) {
      command.origin = CommandOrigin::kReplay;
    }
    pass.commands.insert(pass.commands.begin(), recorded.begin(), recorded.end());
  }
  const Timestamp before = last_ ? last_->time : pass.snapshot->time;
  for (const EngineCommand& command : pass.commands) {
    if (IsSettingCommand(command)) {
      ApplySettingCommand(pass, command);
      continue;
    }
    const Status done = mission_.Apply(command, MissionSession(pass, before));
    if (!done) {
      pass.Note(DiagnosticLevel::kWarning, "mission", done.error().message);
    }
  }
}

}  // namespace palace
