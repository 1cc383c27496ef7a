// What maps need and has not come is named, message by message.
#include "engine/runtime/missing_inputs.h"

#include <gtest/gtest.h>

namespace palace {
namespace {

TEST(MissingInputs, NamesWhatAnIntegratorHasToSend) {
  constexpr const char* kRig = "CAMERA_RIG with a rig (has_rig 1)";
  const struct {
    const char* what;
    bool pictures, rig, pose;
    std::uint64_t unpaired, without_rig;
    std::string missing;
  } table[] = {{"silence", false, false, false, 0, 0,
                std::string("CAMERA_LEFT and CAMERA_RIGHT, ") + kRig + ", VEHICLE_POSE"},
               {"has_rig 0", false, false, true, 0, 12, kRig},
               {"one camera", false, true, true, 12, 0, "a second picture within 5 ms of each"},
               {"no pose", true, true, false, 0, 0, "VEHICLE_POSE"},
               {"all of it", true, true, true, 3, 0, ""}};
  for (const auto& row : table) {
    SCOPED_TRACE(row.what);
    EngineSnapshot snap;
    snap.session.Edit().role = SessionRole::kLive;
    const auto add = [&](ChannelId id, bool came) {
      using State = ChannelHealth::State;
      snap.sensors.Edit().channels.push_back(
          {.id = id, .state = came ? State::kFresh : State::kNever, .note = {}});
    };
    add(ChannelId::kCameraLeft, row.pictures);
    add(ChannelId::kVehiclePose, row.pose);
    if (row.rig) {
      snap.sensors.Edit().rig = std::make_shared<const StereoRig>();
    }
    Losses losses;
    losses.pictures_unpaired = row.unpaired;
    losses.pairs_without_rig = row.without_rig;
    EXPECT_EQ(MissingInputs(snap, losses), row.missing);
    snap.session.Edit().role = SessionRole::kPictures;
    EXPECT_EQ(MissingInputs(snap, losses), "");
  }
}

}  // namespace
}  // namespace palace
