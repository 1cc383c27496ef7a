// Camera model files: JPL text models (.cahv, .cahvor).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/model/rig.h"

namespace palace {

/// Parses the text of a JPL model: lines `Dimensions = W H`, `Model = CAHV...`, `C = x y z` and A,
/// H, V, and for CAHVOR O, R. Comments start with '#'; Hs, Hc, Vs, Vc, Theta and covariance lines
/// are derived values and not read. A and O are normalised. `name` is the file name for errors,
/// which also name line and key. Files over 1 MiB are refused.
Result<CahvorModel> ParseCahvorText(std::string_view text, const std::string& name);
Result<CahvorModel> ReadCahvorFile(const std::filesystem::path& path);
/// The same format, 17 digits.
std::string CahvorToText(const CahvorModel& model);

}  // namespace palace
