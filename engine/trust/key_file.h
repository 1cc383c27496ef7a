// Key files: one a pair of station and vehicle, the same file on both sides.
//
//   PALACE-KEY 1
//   made 2026-11-23T01:20:00Z
//   fingerprint 3F2A-91C0-77B4-E0D2
//   key 64 hexadecimal digits
//
// Lines may stand in any order after the first; `made` may be missing, '#' begins a comment line.
// A file is read when it is a plain file of at most 4 kB, of this user or root, that nobody else
// may read or write (mode 0600), and no link to elsewhere. An error names file, line and remedy,
// never a digit of the key.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/trust/secret_key.h"

namespace palace {

/// A key and what people call it.
struct NamedKey {
  std::string name;  ///< "heli-1"
  std::filesystem::path file;
  SecretKey key;
};

/// keys in ConfigFolder (core/files.h); empty where there is none.
std::filesystem::path DefaultKeyFolder();

/// 1 to 40 letters, digits, '-', '_' and '.', not beginning with '.'. Empty when fine, else why
/// not.
std::string WhyNoKeyName(const std::string& name);

Result<NamedKey> LoadKeyFile(const std::filesystem::path& file);
/// `name_or_file`: NAME.key of the folder, or a file when it holds a '/' or ends in ".key".
Result<NamedKey> FindKey(const std::string& name_or_file, const std::filesystem::path& folder);
/// A new random key as NAME.key, mode 0600, in a folder made with 0700. An existing one is refused.
Result<NamedKey> MakeKeyFile(const std::string& name, const std::filesystem::path& folder);
Status RemoveKeyFile(const std::string& name, const std::filesystem::path& folder);
/// The *.key files of the folder, by name; nothing where there is no folder.
std::vector<std::filesystem::path> KeyFilesIn(const std::filesystem::path& folder);

}  // namespace palace
