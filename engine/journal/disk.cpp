#include "engine/journal/disk.h"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <utility>

namespace palace {

const Disk& SystemDisk() {
  static const Disk disk = {
      .write = ::write,
      .cut = ::ftruncate,
      .sync = ::fdatasync,
      // Not posix_fallocate: where the file system cannot, that one writes every byte instead.
      .set_aside = [](int file, off_t size) { return ::fallocate(file, 0, 0, size) == 0; },
      .free_bytes = [](const std::filesystem::path& folder) -> std::optional<std::uint64_t> {
        struct statvfs space {};
        if (::statvfs(folder.c_str(), &space) != 0) {
          return std::nullopt;
        }
        return std::uint64_t{space.f_bavail} * space.f_frsize;
      }};
  return disk;
}

SpaceReserve::SpaceReserve(const std::filesystem::path& folder, std::uint64_t bytes,
                           const Disk& disk)
    : disk_(&disk) {
  const std::filesystem::path path = folder / "reserve.tmp";
  file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file_ < 0) {
    return;
  }
  ::unlink(path.c_str());
  bytes_ = bytes;
  if (!disk.set_aside(file_, static_cast<off_t>(bytes))) {
    Release();
  }
}

SpaceReserve::SpaceReserve(SpaceReserve&& other) noexcept
    : disk_(other.disk_),
      file_(std::exchange(other.file_, -1)),
      bytes_(std::exchange(other.bytes_, 0)) {}

SpaceReserve& SpaceReserve::operator=(SpaceReserve&& other) noexcept {
  std::swap(disk_, other.disk_);
  std::swap(file_, other.file_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

void SpaceReserve::Release() {
  if (file_ >= 0) {
    static_cast<void>(disk_->cut(file_, 0));
    ::close(std::exchange(file_, -1));
  }
  bytes_ = 0;
}

}  // namespace palace
