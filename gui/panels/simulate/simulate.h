// Simulate: the built-in simulation from outside, its time, and what of it may be changed while it
// flies (thesis 2.1, RIPTIDE). Offered where that is what the station looks at.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/model/snapshot.h"
#include "gui/widgets/panel_frame.h"
#include "gui/widgets/slider_row.h"

namespace palace {

/// A kind of fault; the app knows them.
struct FaultOffer {
  std::string name, words;  ///< "gps_jump", "GPS jump"
  std::string what;         ///< a sentence
  bool has_value = false;
  std::string unit{};
  double default_value = NAN, least = 0, most = 0;
  struct Channel {
    std::string name, words;  ///< "CAMERA_LEFT", "Camera left"
  };
  std::vector<Channel> channels{};  ///< one may be chosen of; empty: the kind says itself
};
/// One of the flight's, as it stands now.
struct ListedFault {
  int number = 0;
  std::string words;            ///< "GPS jump 3 m"
  std::string kind;             ///< "GPS jump", where there is no room
  double from_s = 0, to_s = 0;  ///< of the flight; infinite: until it is ended
  bool acts = false, over = false;
};
/// What a fault to come is made of.
struct FaultForm {
  std::size_t kind = 0;
  std::size_t channel = 0;  ///< 0: all, else the kind's nth
  double value = NAN;       ///< NaN: the default
  double for_s = 10;        ///< 0: until it is ended
};

/// What another flight may be flown in, and what may fail in this one; the app sets it.
struct OfferedFlights {
  std::vector<std::string> scenarios, vehicles;
  std::vector<FaultOffer> faults{};
};
enum class SimulateTab : std::uint8_t { kChanges, kFlight, kFaults };

struct SimulateState {
  /// The view that fills the main area, then the small ones beside it.
  std::array<WorldEye, 4> eyes = {WorldEye::kBirdsEye, WorldEye::kLeft, WorldEye::kChase,
                                  WorldEye::kAbove};
  SliderState sliders;
  double run_to_s = 0;        ///< offered
  bool run_to_typed = false;  ///< by the operator, and not run to yet: it is never replaced
  OfferedFlights offered;
  FlightChoice choice;                      ///< of the next flight
  SimulateTab tab = SimulateTab::kChanges;  ///< in a low window: what of the three is shown
  FaultForm fault;
  bool choosing_fault = false;      ///< the list of kinds is open
  std::vector<ListedFault> faults;  ///< set by the app, every frame
  int first_fault = 0;              ///< of the list, in sight
  std::string followed_fault;       ///< focus that the list has scrolled after
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
  bool folded = false;  ///< changes, next flight and faults share one place, behind tabs
  Rect time, changes, flight, faults;  ///< folded: the last three are the same
  std::array<Rect, 4> eyes;            ///< panels, the main one first
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
/// Items "fault/kind", "fault/channel/next", "fault/inject"; "fault/3" and "fault/end/3" of those
/// that act or are to come, by rows that the wheel and the focus bring into sight.
void DrawFaults(const EngineSnapshot& snap, const Rect& rect, SimulateState& state, UiFrame& ui);
/// Items "fault/kind/gps_jump" of all kinds.
void DrawFaultChoice(const Rect& rect, SimulateState& state, UiFrame& ui);
/// Items "world_view/chase" for each, "swap/chase" for the small ones shown.
void DrawWorldViews(const EngineSnapshot& snap, const SimulateLayout& layout, SimulateState& state,
                    UiFrame& ui);
void DrawSimulateWorkspace(const EngineSnapshot& snap, const Rect& body, SimulateState& state,
                           UiFrame& ui);

}  // namespace palace
