#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "engine/geodata/geo_tiff.h"
#include "engine/geodata/mesh_file.h"
#include "engine/geodata/point_files.h"
#include "engine/journal/export.h"
#include "engine/journal/log_index.h"
#include "engine/journal/log_tools.h"
#include "engine/journal/replay_source.h"
#include "engine/trust/key_file.h"
#include "tests/fuzz/fuzz_target.h"

namespace palace {
namespace {

constexpr int kMostBundles = 50;  ///< of a replay

/// The folder of this process, gone with it.
const std::filesystem::path& ScratchFolder() {
  struct Folder {
    Folder() {
      const std::filesystem::path memory = "/dev/shm";
      path = (std::filesystem::is_directory(memory) ? memory
                                                    : std::filesystem::temp_directory_path()) /
             ("palace_fuzz_" + std::to_string(::getpid()));
      std::filesystem::create_directories(path);
    }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
    std::filesystem::path path;
  };
  static const Folder folder;
  return folder.path;
}

void ReadLog(const std::filesystem::path& log) {
  (void)DescribeLog(log, false);
  const bool whole = DescribeLog(log, true).ok();
  const std::filesystem::path repaired = ScratchFolder() / "repaired.lcm";
  std::filesystem::remove(repaired);
  std::filesystem::remove(SidecarPath(repaired));
  if (RepairLog(log, repaired).ok() != whole) {  // what can be read through can be repaired
    __builtin_trap();
  }
  (void)ExportCsv(log, ScratchFolder() / "tables");
  ReplayOptions options;
  options.speed = 0;
  auto replay = ReplaySource::Open(log, options);
  for (int i = 0; replay && i < kMostBundles; ++i) {
    if (!(*replay)->Next({})) {
      break;
    }
  }
}

/// First two bytes: how much of the rest is the log; what follows is its sidecar.
void Log(Bytes input) {
  if (input.size() < 2) {
    return;
  }
  const std::size_t log_bytes =
      std::min<std::size_t>(input.size() - 2, input[0] * std::size_t{256} + input[1]);
  const auto log = ScratchFile("log.lcm", input.subspan(2, log_bytes));
  if (log_bytes + 2 < input.size()) {
    ScratchFile("log.lcm.idx", input.subspan(2 + log_bytes));
  } else {
    std::filesystem::remove(SidecarPath(log));
  }
  ReadLog(log);
}

void Points(Bytes input) {
  for (const char* name : {"points.xyz", "points.ply"}) {
    (void)ReadPointFile(ScratchFile(name, input));
  }
  (void)ReadLabelledPoints(ScratchFile("labelled.txt", input));
}

void Meshes(Bytes input) {
  if (const auto mesh = ReadMeshFile(ScratchFile("mesh.obj", input))) {
    (void)FindOpenEdges(*mesh);
  }
}

void Key(Bytes input) {
  using std::filesystem::perms;
  const auto file = ScratchFile("heli-1.key", input);
  std::filesystem::permissions(file, perms::owner_read | perms::owner_write);
  (void)LoadKeyFile(file);
}

}  // namespace

std::filesystem::path ScratchFile(const char* name, Bytes input) {
  const std::filesystem::path path = ScratchFolder() / name;
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file != nullptr) {
    if (!input.empty()) {
      (void)std::fwrite(input.data(), 1, input.size(), file);
    }
    (void)std::fclose(file);
  }
  return path;
}

std::vector<FuzzTarget> FileTargets() {
  return {{"log", &Log},
          {"points", &Points},
          {"geotiff", [](Bytes input) { (void)ReadGeoTiff(ScratchFile("map.tif", input)); }},
          {"mesh", &Meshes},
          {"key", &Key}};
}

}  // namespace palace
