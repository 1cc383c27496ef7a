#include "engine/journal/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace palace {
namespace {

/// What is wrong, and what helps.
struct Trouble {
  std::string problem;
  std::string remedy;
};

Trouble TroubleOf(int code) {
  switch (code) {
    case ENOSPC:
    case EDQUOT:
      return {"the disk is full", "free space or write elsewhere"};
    case EACCES:
    case EPERM:
    case EROFS:
      return {"the folder cannot be written", "choose another"};
    case EEXIST:
      return {"it exists already", "logs are never overwritten"};
    default:
      return {std::strerror(code), "check the folder and its permissions"};
  }
}

}  // namespace

Error OutputFile::Failed(const char* doing, int code) {
  const Trouble trouble = TroubleOf(code);
  problem_ = trouble.problem;
  return UnavailableError(path_.string() + ": cannot " + doing + " (" + std::strerror(code) +
                          "); " + trouble.problem + "; " + trouble.remedy);
}

Result<OutputFile> OutputFile::Create(const std::filesystem::path& path, const Disk& disk) {
  OutputFile file;
  file.path_ = path;
  file.disk_ = &disk;
  file.descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (file.descriptor_ < 0) {
    return file.Failed("be created", errno);
  }
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
      disk_(other.disk_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      written_(other.written_),
      buffer_(std::move(other.buffer_)),
      problem_(std::move(other.problem_)) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(disk_, other.disk_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(written_, other.written_);
  std::swap(buffer_, other.buffer_);
  std::swap(problem_, other.problem_);
  return *this;
}

void OutputFile::Append(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  buffer_.insert(buffer_.end(), bytes, bytes + size);
}

Status OutputFile::Flush() {
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t written = disk_->write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written <= 0) {
      const int code = written < 0 ? errno : ENOSPC;
      written_ += done;
      buffer_.clear();
      return Failed("be written", code);
    }
    done += static_cast<std::size_t>(written);
  }
  written_ += done;
  buffer_.clear();
  return Ok();
}

Status OutputFile::Sync() {
  const Status flushed = Flush();
  if (!flushed) {
    return flushed;
  }
  // A pipe or device that cannot sync is no failure of ours.
  if (disk_->sync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) {
    return Failed("be brought to the disk", errno);
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
  return closed == 0 ? Ok() : Status(Failed("be closed", errno));
}

void OutputFile::CutBack(std::uint64_t size) {
  buffer_.clear();
  if (descriptor_ < 0 || size >= written_) {
    return;
  }
  if (disk_->cut(descriptor_, static_cast<off_t>(size)) == 0) {
    written_ = size;
  }
  ::lseek(descriptor_, static_cast<off_t>(written_), SEEK_SET);
}

}  // namespace palace
