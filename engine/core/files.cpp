#include "engine/core/files.h"

#include <fstream>
#include <system_error>

namespace palace {

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
