// Simulate: the built-in simulation from outside, its time, and what of it may be changed while it
// flies (thesis 2.1, RIPTIDE). Offered where that is what the station looks at.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/model/snapshot.h"
#include "gui/widgets/panel_frame.h"
#include "gui/widgets/slider_row.h"

namespace palace {

/// What another flight may be flown in; the app sets it.
struct OfferedFlights {
  std::vector<std::string> scenarios, vehicles;
};

struct SimulateState {
  /// The view that fills the main area, then the small ones beside it.
  std::array<WorldEye, 4> eyes = {WorldEye::kBirdsEye, WorldEye::kLeft, WorldEye::kChase,
                                  WorldEye::kAbove};
  SliderState sliders;
  double run_to_s = 0;  ///< offered
  OfferedFlights offered;
  FlightChoice choice;    ///< of the next flight
  bool choosing = false;  ///< in a low window: the next flight is shown in place of the changes
};

/// A built-in simulation is looked at.
bool IsSimulation(const EngineSnapshot& snap);
/// "left", "birds_eye": as scripts name it.
const char* EyeName(WorldEye eye);
/// "Left camera", "Bird's eye": as the screen does.
const char* EyeWords(WorldEye eye);
/// Fills the main area with it: a small one changes places with the one there.
void ShowEye(WorldEye eye, SimulateState& state);

struct SimulateLayout {
  bool folded = false;         ///< changes and next flight share one place, behind tabs
  Rect time, changes, flight;  ///< folded: the last two are the same
  std::array<Rect, 4> eyes;    ///< panels, the main one first
};
SimulateLayout LaySimulate(const Rect& body, const Style& style);

/// Items "sim/play", "sim/step", "sim/run_to", "sim/speed/2", "sim/speed/fastest".
void DrawSimulatedTime(const EngineSnapshot& snap, const Rect& rect, SimulateState& state,
                       UiFrame& ui);
/// Items "limit/simulation.wind_mps" and so on: SimulationChange.
void DrawSimulationChanges(const EngineSnapshot& snap, const Rect& rect, SimulateState& state,
                           UiFrame& ui);
/// Items "scenario/rocks", "vehicle/r50", "field/simulation.seed", "fly_world".
void DrawNextFlight(const EngineSnapshot& snap, const Rect& rect, SimulateState& state,
                    UiFrame& ui);
/// Items "world_view/chase" for each, "swap/chase" for the small ones shown.
void DrawWorldViews(const EngineSnapshot& snap, const SimulateLayout& layout, SimulateState& state,
                    UiFrame& ui);
void DrawSimulateWorkspace(const EngineSnapshot& snap, const Rect& body, SimulateState& state,
                           UiFrame& ui);

}  // namespace palace
