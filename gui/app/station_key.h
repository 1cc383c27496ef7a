// Which key this station commands a live vehicle with.
#pragma once

#include <filesystem>

#include "engine/core/result.h"
#include "engine/trust/station_session.h"

namespace palace {

/// `wanted` (--key): a name in `folder` or a file; an error where it cannot be used. Empty: the one
/// key of the folder; with none, with several or with one that cannot be used this station may only
/// look, and says why.
Result<StationTrust> StationTrustFor(const std::string& wanted,
                                     const std::filesystem::path& folder);

}  // namespace palace
