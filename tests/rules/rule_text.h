// Reading our own sources and tables, for tests that hold one against the other.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace palace {

using Complaints = std::vector<std::string>;

inline std::string Joined(const Complaints& complaints) {
  std::string text;
  for (const std::string& complaint : complaints) {
    text += complaint + "\n";
  }
  return text;
}

inline std::string ReadText(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Comments and the insides of strings become blanks.
inline std::string CodeOf(const std::string& text) {
  std::string code = text;
  for (std::size_t i = 0; i < code.size();) {
    std::size_t end = i + 1;
    if (code.compare(i, 2, "//") == 0) {
      end = std::min(code.find('\n', i), code.size());
    } else if (code.compare(i, 2, "/*") == 0) {
      end = std::min(code.find("*/", i), code.size() - 2) + 2;
    } else if (code[i] == '"') {
      while (end < code.size() && code[end] != '"') {
        end += code[end] == '\\' ? 2 : 1;
      }
      end = std::min(end + 1, code.size());
    } else {
      ++i;
      continue;
    }
    std::fill(code.begin() + static_cast<std::ptrdiff_t>(i),
              code.begin() + static_cast<std::ptrdiff_t>(end), ' ');
    i = end;
  }
  return code;
}

/// Fields of a row of a Markdown table.
inline std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line.substr(1));
  for (std::string cell; std::getline(stream, cell, '|');) {
    const std::size_t first = cell.find_first_not_of(' ');
    const std::size_t last = cell.find_last_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

/// Words between back quotes.
inline std::vector<std::string> Quoted(const std::string& cell) {
  std::vector<std::string> words;
  const std::regex quoted("`([^`]*)`");
  for (std::sregex_iterator at(cell.begin(), cell.end(), quoted), end; at != end; ++at) {
    words.push_back((*at)[1].str());
  }
  return words;
}

}  // namespace palace
