// Fuzz targets: everything that reads bytes which a stranger may have written. Any bytes must give
// a value or an Error: no crash, no undefined behaviour, no memory beyond what the bytes justify.
//
//   ./test         each target on its corpus and on mutations of it with a printed seed
//   ./test --full  libFuzzer with AddressSanitizer and UndefinedBehaviorSanitizer, ten million runs
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palace {

using Bytes = std::span<const std::uint8_t>;

struct FuzzTarget {
  const char* name;  ///< and the folder of its corpus
  void (*run)(Bytes input);
};

/// What files a person edits say.
std::vector<FuzzTarget> TextTargets();
/// Scripts; they are the window's, so a build of the engine alone has none.
FuzzTarget ScriptTarget();
/// What comes from a bus.
std::vector<FuzzTarget> WireTargets();
/// The names of the message types that they fuzz.
std::vector<std::string> FuzzedTypes();
/// What lies on a disk: logs with their sidecar, point clouds, elevation maps.
std::vector<FuzzTarget> FileTargets();

inline std::vector<FuzzTarget> FuzzTargets() {
  std::vector<FuzzTarget> all = TextTargets();
  for (const auto& group : {WireTargets(), FileTargets()}) {
    all.insert(all.end(), group.begin(), group.end());
  }
#ifdef PALACE_FUZZ_SCRIPTS
  all.push_back(ScriptTarget());
#endif
  return all;
}

inline std::string_view AsText(Bytes input) {
  return {reinterpret_cast<const char*>(input.data()), input.size()};
}

/// A file of this process in memory, with these bytes, under the folder of scratch_folder.
std::filesystem::path ScratchFile(const char* name, Bytes input);

}  // namespace palace
