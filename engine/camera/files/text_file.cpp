#include "engine/camera/files/text_file.h"

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
  std::string text(limit + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad() || (!stream && !stream.eof())) {
    return UnavailableError(path.string() + ": cannot be read; check its permissions");
  }
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > limit) {
    return InvalidError(path.string() + ": larger than " + std::to_string(limit) +
                        " bytes; is it the right file?");
  }
  return text;
}

}  // namespace palace
