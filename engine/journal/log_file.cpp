#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "engine/journal/log_reader.h"

namespace palace {

Result<LogFile> LogFile::Open(const std::filesystem::path& path) {
  LogFile file;
  file.path_ = path;
  // O_NONBLOCK: opening a pipe must not wait for its writer.
  file.descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file.descriptor_ < 0) {
    const char* remedy = errno == ENOENT ? "check the name" : "check its permissions";
    return UnavailableError(path.string() + ": cannot be opened (" + std::strerror(errno) + "); " +
                            remedy);
  }
  struct stat info {};
  if (::fstat(file.descriptor_, &info) != 0 || S_ISDIR(info.st_mode)) {
    return UnavailableError(path.string() + ": is a folder; name the log in it, e.g. " +
                            (path / "flight.lcm").string());
  }
  if (!S_ISREG(info.st_mode)) {
    return UnavailableError(path.string() + ": is no regular file; name an LCM event log");
  }
  file.size_ = static_cast<std::uint64_t>(info.st_size);
  return Result<LogFile>(std::move(file));
}

LogFile::~LogFile() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

LogFile::LogFile(LogFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_) {}

LogFile& LogFile::operator=(LogFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  return *this;
}

std::size_t LogFile::ReadAt(std::uint64_t offset, void* buffer, std::size_t size) const {
  auto* out = static_cast<std::uint8_t*>(buffer);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t got =
        ::pread(descriptor_, out + done, size - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got <= 0) {
      break;
    }
    done += static_cast<std::size_t>(got);
  }
  return done;
}

}  // namespace palace
