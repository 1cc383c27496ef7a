// Export: a log as CSV tables in SI units.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/wire/channels.h"

namespace palace {

struct ExportedTable {
  std::filesystem::path file;
  std::uint64_t rows = 0;
};

struct ExportedLog {
  std::vector<ExportedTable> tables;
  std::uint64_t left_out = 0;  ///< events whose bytes differ from their checksum or make no message
};

/// Writes estimates.csv truth.csv decisions.csv sites.csv settings.csv events.csv status.csv
/// refused.csv into `folder` (made when missing). Headers carry the unit; doubles have 17 digits;
/// unknown is an empty field. Pictures are not looked at. Errors name the file.
Result<ExportedLog> ExportCsv(const std::filesystem::path& log, const std::filesystem::path& folder,
                              const ChannelNames& channels = {});

}  // namespace palace
