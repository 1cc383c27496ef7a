// What the approve panel says, made from the snapshot alone; "" where there is nothing to say.
#pragma once

#include <string>

#include "engine/model/snapshot.h"
#include "gui/panels/fly_state.h"

namespace palace {

/// Why the vehicle cannot be committed now, as the button gives it: a preview, the first check that
/// fails, a screen that is `silent_s` behind the engine. Empty: all checks pass.
std::string WhyNotApprove(const EngineSnapshot& snap, double silent_s);
/// Label, phase and reason of the hold button; `ui_time_s` on the clock of ApproveState.
HoldButtonView ApproveButton(const EngineSnapshot& snap, const ApproveState& state,
                             double ui_time_s, double silent_s);
/// ", from the north-east" where the approach goes round to there; empty where it is straight.
std::string SideOnlyWords(const MissionStatus& mission);
/// The same, with the reason where there is one: ", from the north-east, wind and sun".
std::string SideWords(const MissionStatus& mission);
/// What an approval leads to, in sentences: distance and height, time, heading; before that what
/// speaks against the armed site. `narrow`: half of it.
std::string ApprovalConsequence(const EngineSnapshot& snap, bool narrow);
/// What a person may do, and why not: while nothing is armed.
std::string WhatToDoUnarmed(const EngineSnapshot& snap);
/// "Look right 45°".
std::string LookLabel(const ProposedLook& look);
/// Letter of the site that follows when the armed one is refused; empty when none does.
std::string NextSiteLetter(const EngineSnapshot& snap);

}  // namespace palace
