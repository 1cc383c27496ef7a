#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "engine/journal/log_writer.h"

namespace palace {
namespace {

constexpr std::size_t kBufferBytes = 1u << 20;

Error WriteError(const std::filesystem::path& path, const char* doing, int code) {
  std::string remedy = "check the folder and its permissions";
  if (code == ENOSPC || code == EDQUOT) {
    remedy = "the disk is full; free space or record elsewhere with --record DIR";
  } else if (code == EACCES || code == EPERM || code == EROFS) {
    remedy = "the folder cannot be written; choose another with --record DIR";
  } else if (code == EEXIST) {
    remedy = "it exists already; recordings are never overwritten";
  }
  return UnavailableError(path.string() + ": cannot " + doing + " (" + std::strerror(code) + "); " +
                          remedy);
}

}  // namespace

Result<OutputFile> OutputFile::Create(const std::filesystem::path& path) {
  OutputFile file;
  file.path_ = path;
  file.descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (file.descriptor_ < 0) {
    return WriteError(path, "be created", errno);
  }
  file.buffer_.reserve(kBufferBytes);
  return Result<OutputFile>(std::move(file));
}

OutputFile::~OutputFile() {
  // Close() reports; this only makes sure that nothing is forgotten.
  if (descriptor_ >= 0) {
    static_cast<void>(Close().ok());
  }
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_),
      buffer_(std::move(other.buffer_)) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  std::swap(buffer_, other.buffer_);
  return *this;
}

Status OutputFile::Append(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  buffer_.insert(buffer_.end(), bytes, bytes + size);
  size_ += size;
  return buffer_.size() >= kBufferBytes ? Flush() : Ok();
}

Status OutputFile::Flush() {
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t written = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written <= 0) {
      const int code = written < 0 ? errno : ENOSPC;
      size_ -= buffer_.size() - done;
      buffer_.clear();
      return WriteError(path_, "be written", code);
    }
    done += static_cast<std::size_t>(written);
  }
  buffer_.clear();
  return Ok();
}

Status OutputFile::Sync() {
  const Status flushed = Flush();
  if (!flushed) {
    return flushed;
  }
  // A pipe or device that cannot sync is no failure of ours.
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) {
    return WriteError(path_, "be brought to the disk", errno);
  }
  return Ok();
}

Status OutputFile::Close() {
  if (descriptor_ < 0) {
    return Ok();
  }
  const Status synced = Sync();
  const int closed = ::close(std::exchange(descriptor_, -1));
  if (!synced) {
    return synced;
  }
  return closed == 0 ? Ok() : Status(WriteError(path_, "be closed", errno));
}

void OutputFile::CutBack(std::uint64_t size) {
  buffer_.clear();
  if (descriptor_ >= 0 && ::ftruncate(descriptor_, static_cast<off_t>(size)) == 0) {
    ::lseek(descriptor_, 0, SEEK_END);
    size_ = size;
  }
}

}  // namespace palace
