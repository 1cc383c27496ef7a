#include "engine/core/files.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <system_error>

namespace palace {

Status CheckRegularFile(const std::filesystem::path& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) {
    return UnavailableError(path.string() + ": is a folder; name a file in it");
  }
  if (path == "-" || std::filesystem::is_character_file(path, code) ||
      std::filesystem::is_fifo(path, code)) {
    return UnavailableError(path.string() +
                            ": is no file on disk; save what it gives as a file and name that");
  }
  if (!std::filesystem::is_regular_file(path, code)) {
    return UnavailableError(path.string() + ": no such file; check the name");
  }
  return Ok();
}

Result<std::string> ReadTextFile(const std::filesystem::path& path, std::size_t limit) {
  if (const Status regular = CheckRegularFile(path); !regular) {
    return regular.error();
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
    std::error_code code;
    const std::uintmax_t size = std::filesystem::file_size(path, code);
    return InvalidError(path.string() + ": " + (code ? "" : std::to_string(size) + " bytes, ") +
                        "larger than " + std::to_string(limit) + " bytes; is it the right file?");
  }
  return text;
}

Status WriteTextFile(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::path part = path;
  part += ".part";
  std::ofstream out(part, std::ios::trunc | std::ios::binary);
  out << text;
  out.close();
  std::error_code error;
  if (out) {
    std::filesystem::rename(part, path, error);
  }
  if (!out || error) {
    std::filesystem::remove(part, error);
    return UnavailableError("cannot write " + path.string() +
                            "; choose a folder you may write to, with free space");
  }
  return Ok();
}

std::filesystem::path ConfigFolder() {
  const auto absolute = [](const char* variable) {
    const char* value = std::getenv(variable);
    return std::filesystem::path(value != nullptr && value[0] == '/' ? value : "");
  };
  if (const std::filesystem::path config = absolute("XDG_CONFIG_HOME"); !config.empty()) {
    return config / "palace";
  }
  const std::filesystem::path home = absolute("HOME");
  return home.empty() ? home : home / ".config" / "palace";
}

Status MakeFolder(const std::filesystem::path& folder) {
  std::error_code error, ignored;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, ignored)) {
    return UnavailableError("cannot make the folder " + folder.string() +
                            (error ? " (" + error.message() + ")" : "") +
                            "; choose one you may write to");
  }
  return Ok();
}

}  // namespace palace
