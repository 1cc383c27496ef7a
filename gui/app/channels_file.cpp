#include "gui/app/channels_file.h"

#include "engine/core/log.h"

namespace palace {

std::optional<std::filesystem::path> FindChannelsFile(const std::filesystem::path& program) {
  const std::filesystem::path beside = program.parent_path();
  // build/PRESET/palace of a checkout; bin/palace of an installation.
  for (const char* place : {"../../config/channels.toml", "../share/palace/channels.toml"}) {
    const std::filesystem::path file = (beside / place).lexically_normal();
    std::error_code none;
    if (std::filesystem::is_regular_file(file, none)) {
      return file;
    }
  }
  return std::nullopt;
}

Result<ChannelNames> ChannelsFor(const AppOptions& options) {
  if (!options.channels_file.empty()) {
    return LoadChannels(options.channels_file);
  }
  if (options.source != SourceChoice::kConnect) {
    return ChannelNames();
  }
  std::error_code none;
  const auto file = FindChannelsFile(std::filesystem::read_symlink("/proc/self/exe", none));
  if (!file) {
    return ChannelNames();
  }
  LogInfo("channels from " + file->string());
  return LoadChannels(*file);
}

}  // namespace palace
