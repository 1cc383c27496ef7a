#include "engine/calibration/target_file.h"
#include "engine/camera/files/camera_files.h"
#include "engine/camera/files/poses_file.h"
#include "engine/camera/files/rig_file.h"
#include "engine/capture/camera_address.h"
#include "engine/capture/euroc/euroc_tables.h"
#include "engine/faults/fault_plan.h"
#include "engine/faults/fault_text.h"
#include "engine/runtime/settings_io.h"
#include "engine/simulation/vehicle_file.h"
#include "engine/wire/channels.h"
#include "engine/world/world_file.h"
#include "tests/fuzz/fuzz_target.h"

namespace palace {

std::vector<FuzzTarget> TextTargets() {
  return {
      {"settings",
       [](Bytes input) { (void)ParseSettings(AsText(input), "settings.toml", Settings{}); }},
      {"setting", [](Bytes input) { (void)ApplySettingText(Settings{}, AsText(input)); }},
      {"channels", [](Bytes input) { (void)ParseChannels(AsText(input), "channels.toml"); }},
      {"target", [](Bytes input) { (void)ParseTargetText(AsText(input), "target.toml"); }},
      {"rig", [](Bytes input) { (void)LoadRigFile(ScratchFile("rig.toml", input)); }},
      {"vehicle", [](Bytes input) { (void)ParseVehicle(AsText(input), "vehicle.toml"); }},
      {"world", [](Bytes input) { (void)ParseWorld(std::string(AsText(input)), "world.toml"); }},
      {"faults",
       [](Bytes input) {
         if (const auto plan = ParseFaultPlan(AsText(input), "faults.toml")) {
           const auto again = ParseFaultPlan(FaultPlanText(*plan), "again.toml");
           if (!again || again->faults != plan->faults) {
             __builtin_trap();
           }
         }
         if (const auto fault = ParseFault(AsText(input))) {
           const auto again = ParseFault(FaultText(*fault));
           if (!again || !(*again == *fault)) {
             __builtin_trap();
           }
           (void)FaultWords(*fault);
         }
       }},
      {"poses", [](Bytes input) { (void)LoadPosesFile(ScratchFile("poses.csv", input)); }},
      {"euroc",
       [](Bytes input) {
         const auto file = ScratchFile("data.csv", input);
         (void)ReadEurocPictures(file);
         (void)ReadEurocInertials(file);
         if (const auto states = ReadEurocStates(file)) {
           (void)StateAt(*states, states->front().time_ns / 2 + states->back().time_ns / 2);
         }
       }},
      {"camera",
       [](Bytes input) {
         for (const char* name : {"camera.txt", "camera.yaml", "camera.xml", "camera.IMG"}) {
           (void)ParseCameraText(AsText(input), name);
           (void)ParseCameraText(AsText(input), name, {StereoSide::kRight, {}});
         }
       }},
      {"address",
       [](Bytes input) { (void)ParseCameraAddress(std::string(AsText(input)), "folder"); }},
  };
}

}  // namespace palace
