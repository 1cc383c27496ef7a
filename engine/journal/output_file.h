// OutputFile: a new file whose every write is checked.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/journal/disk.h"

namespace palace {

/// Appended bytes wait in memory until Flush. Closes on destruction.
class OutputFile {
 public:
  /// Refuses to overwrite. `disk` must outlive the file.
  static Result<OutputFile> Create(const std::filesystem::path& path,
                                   const Disk& disk = SystemDisk());
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  void Append(const void* data, std::size_t size);
  /// To the operating system: survives the death of the program. After a failure the file may end
  /// with a part of what waited, which is forgotten: cut it back.
  Status Flush();
  /// To the disk: survives the loss of power.
  Status Sync();
  Status Close();
  /// Cuts the file back to `size` bytes that were flushed, and forgets what waits.
  void CutBack(std::uint64_t size);
  std::uint64_t size() const { return written_ + buffer_.size(); }
  std::size_t waiting() const { return buffer_.size(); }
  const std::filesystem::path& path() const { return path_; }
  /// Why the last write failed, in a few words: "the disk is full".
  const std::string& problem() const { return problem_; }

 private:
  OutputFile() = default;
  Error Failed(const char* doing, int code);

  std::filesystem::path path_;
  const Disk* disk_ = nullptr;
  int descriptor_ = -1;
  std::uint64_t written_ = 0;
  std::vector<std::uint8_t> buffer_;
  std::string problem_;
};

}  // namespace palace
