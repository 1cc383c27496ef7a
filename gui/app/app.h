// App: from the command line to the exit code.
#pragma once

#include "gui/app/intent.h"
#include "gui/app/options.h"
#include "gui/panels/simulate/simulate.h"
#include "gui/widgets/ui_frame.h"

namespace palace {

/// 0 done, 1 failed, 2 bad usage. Every failure is one message on stderr.
int RunApp(const AppOptions& options);

/// Of the station that follows one started with `options`: the same flight again, or a look at its
/// log, which is no new flight and records nothing. After a log that the program was started with,
/// a flight is the built-in simulation, as without arguments: the log is no vehicle.
AppOptions OptionsOfNext(AppOptions options, const NextFlight& next);

/// What a simulated flight may be flown in: the names that are known, and the files of these
/// options.
OfferedFlights FlightsOffered(const AppOptions& options);
/// What these options fly.
FlightChoice ChoiceOf(const AppOptions& options);

/// What ends a review in a program started with `options`, and what then comes.
WayOut WayOutOfReview(const AppOptions& options);

}  // namespace palace
