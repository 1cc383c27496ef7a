#include "engine/experiments/run_inputs.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>

#include <CLI/CLI.hpp>

#include "engine/core/files.h"
#include "engine/core/hash.h"
#include "engine/core/toml_text.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

/// What an option names: a file, or those of a folder of data. (Other folders are written to.)
std::set<fs::path> FilesNamed(const CLI::Option& option, const std::string& value) {
  std::error_code error;
  std::set<fs::path> files;
  if (fs::is_regular_file(value, error)) {
    files.insert(value);
  } else if (option.check_lname("data") && fs::is_directory(value, error)) {
    for (const fs::directory_entry& entry : fs::directory_iterator(value, error)) {
      if (entry.is_regular_file(error)) {
        files.insert(entry.path());
      }
    }
  }
  return files;
}

/// Adds each text of the TOML that is the name of a file, from the folder of the file it stands in.
void AddFilesOf(const toml::node& node, const fs::path& folder, std::set<fs::path>& files) {
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table) {
      AddFilesOf(value, folder, files);
    }
  } else if (const toml::array* array = node.as_array()) {
    for (const toml::node& value : *array) {
      AddFilesOf(value, folder, files);
    }
  } else if (const auto text = node.value_exact<std::string>()) {
    std::error_code error;
    if (!text->empty() && fs::is_regular_file(folder / *text, error)) {
      files.insert(folder / *text);
    }
  }
}

/// The files, and those that TOML files among them name.
std::set<fs::path> WithFilesInside(std::set<fs::path> files) {
  std::set<fs::path> inside;
  for (const fs::path& file : files) {
    const Result<std::string> text =
        file.extension() == ".toml" ? ReadTextFile(file) : Result<std::string>(std::string());
    // A file that cannot be read is refused by whoever needs it.
    if (const auto root = ParseToml(text ? *text : std::string(), file.string()); root) {
      AddFilesOf(*root, file.parent_path(), inside);
    }
  }
  files.merge(inside);
  return files;
}

}  // namespace

std::string InputsOf(const CLI::App& verb) {
  ContentHash hash;
  bool any = false;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& value : option->results()) {
      for (const fs::path& name : WithFilesInside(FilesNamed(*option, value))) {
        std::ifstream file(name, std::ios::binary);
        hash.Add(name.string());
        hash.Add(std::string{std::istreambuf_iterator<char>(file), {}});
        any = true;
      }
    }
  }
  return any ? " files " + ShortHash(hash.value()) : "";
}

}  // namespace palace
