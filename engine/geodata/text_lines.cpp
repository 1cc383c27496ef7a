#include "engine/geodata/text_lines.h"

#include <algorithm>
#include <cstdlib>

namespace palace {
namespace {

bool Parts(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r'; }

}  // namespace

std::size_t ParseNumbers(const std::string& line, std::size_t most, std::vector<double>& numbers) {
  numbers.clear();
  const char* at = line.c_str();
  while (numbers.size() < most) {
    while (Parts(*at)) {
      ++at;
    }
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    const bool hexadecimal =
        std::any_of(at, static_cast<const char*>(end), [](char c) { return c == 'x' || c == 'X'; });
    if (end == at || hexadecimal || !(Parts(*end) || *end == '\0')) {
      break;
    }
    numbers.push_back(value);
    at = end;
  }
  return numbers.size();
}

std::string QuotedLine(const std::string& line) {
  std::string text = line.substr(0, 40);
  for (char& c : text) {
    c = c >= ' ' && c <= '~' ? c : '?';
  }
  return '"' + text + '"';
}

Error ErrorAtLine(const std::filesystem::path& path, std::size_t line, const std::string& what) {
  return InvalidError(path.string() + ":" + std::to_string(line) + ": " + what);
}

}  // namespace palace
