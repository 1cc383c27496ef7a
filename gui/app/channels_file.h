// Where the names of the LCM channels come from.
#pragma once

#include <filesystem>
#include <optional>

#include "engine/core/result.h"
#include "engine/wire/channels.h"
#include "gui/app/options.h"

namespace palace {

/// config/channels.toml of the checkout that `program` was built in, else the installed one; empty
/// where there is neither.
std::optional<std::filesystem::path> FindChannelsFile(const std::filesystem::path& program);

/// The names of --channels; without it, on a live bus, those of the file that belongs to this
/// program; else the built-in ones. A log holds the built-in names unless --channels says
/// otherwise.
Result<ChannelNames> ChannelsFor(const AppOptions& options);

}  // namespace palace
