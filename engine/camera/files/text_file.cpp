#include "engine/camera/files/text_file.h"

#include <algorithm>
#include <fstream>
#include <system_error>

namespace palace {

Result<std::string> ReadTextFile(const std::filesystem::path& path, std::size_t limit) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) {
    return UnavailableError(path.string() + ": is a folder; name a file in it");
  }
  if (path == "-" || std::filesystem::is_character_file(path, code) ||
      std::filesystem::is_fifo(path, code)) {
    return UnavailableError(path.string() +
                            ": is no file on disk; save the text as a file and name that");
  }
  if (!std::filesystem::is_regular_file(path, code)) {
    return UnavailableError(path.string() + ": no such file; check the name");
  }
  std::ifstream stream(path, std::ios::binary);
  std::string text;
  char block[1 << 16];
  while (stream && text.size() <= limit) {
    stream.read(block,
                static_cast<std::streamsize>(std::min(sizeof block, limit + 1 - text.size())));
    text.append(block, static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad() || (!stream && !stream.eof())) {
    return UnavailableError(path.string() + ": cannot be read; check its permissions");
  }
  if (text.size() > limit) {
    return InvalidError(path.string() + ": larger than " + std::to_string(limit) +
                        " bytes; is it the right file?");
  }
  return text;
}

}  // namespace palace
