// Disk: what the journal asks of the system, in one place, so that a test can put a disk of its own
// underneath that fills up or fails at any byte.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

namespace palace {

struct Disk {
  /// As ::write: bytes written, or -1 with errno.
  std::function<ssize_t(int file, const void* data, std::size_t size)> write;
  std::function<int(int file, off_t size)> cut;         ///< as ::ftruncate
  std::function<int(int file)> sync;                    ///< as ::fdatasync
  std::function<bool(int file, off_t size)> set_aside;  ///< blocks for the whole file, or nothing
  /// Bytes that can still be written into a folder; empty when unknown.
  std::function<std::optional<std::uint64_t>(const std::filesystem::path&)> free_bytes;
};

/// That of the operating system.
const Disk& SystemDisk();

/// Space that nobody else can take: a file without a name, so that nothing is left of it when the
/// program dies. Empty where the file system cannot set space aside.
class SpaceReserve {
 public:
  SpaceReserve() = default;
  SpaceReserve(const std::filesystem::path& folder, std::uint64_t bytes, const Disk& disk);
  ~SpaceReserve() { Release(); }
  SpaceReserve(SpaceReserve&& other) noexcept;
  SpaceReserve& operator=(SpaceReserve&& other) noexcept;
  std::uint64_t bytes() const { return bytes_; }
  /// Gives the space back to the disk.
  void Release();

 private:
  const Disk* disk_ = nullptr;
  int file_ = -1;
  std::uint64_t bytes_ = 0;
};

}  // namespace palace
