// What of the faults room the Simulate workspace offers and lists.
#pragma once

#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/faults/fault_injector.h"
#include "gui/panels/simulate/simulate.h"

namespace palace {

std::vector<FaultOffer> FaultsOffered();
std::vector<ListedFault> ListFaults(const FaultInjector& injector);
/// A fault as text, its times counted from now.
Status Inject(FaultInjector& injector, const std::string& text);

}  // namespace palace
