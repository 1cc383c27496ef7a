// Tables that the programs wrote, as rows by the names of their columns.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace palace {

using CsvTable = std::vector<std::map<std::string, std::string>>;

/// Fields here hold no quoted commas but in the last column, which is not asked for beyond them.
inline CsvTable ReadTable(const std::filesystem::path& path) {
  std::ifstream file(path);
  const auto fields = [](const std::string& line) {
    std::vector<std::string> words;
    std::stringstream stream(line);
    for (std::string word; std::getline(stream, word, ',');) {
      words.push_back(word);
    }
    return words;
  };
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> names = fields(line);
  CsvTable table;
  while (std::getline(file, line)) {
    const std::vector<std::string> words = fields(line);
    auto& row = table.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) {
      row[names[i]] = i < words.size() ? words[i] : "";
    }
  }
  return table;
}

}  // namespace palace
