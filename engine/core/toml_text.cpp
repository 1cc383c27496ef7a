#include "engine/core/toml_text.h"

#include <algorithm>

namespace palace {
namespace {

/// Behind the string that begins with the quote at `at`; npos where it does not end in its line, or
/// at all: the parser stops there too.
std::size_t EndOfString(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool long_one = text.substr(at, 3) == std::string(3, quote);
  const std::string_view end = long_one ? text.substr(at, 3) : text.substr(at, 1);
  for (std::size_t i = at + end.size(); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (text.substr(i, end.size()) == end) {
      i += end.size();
      // A long one may end in up to two quotes of its own.
      for (int more = 0; long_one && more < 2 && i < text.size() && text[i] == quote; ++more) {
        ++i;
      }
      return i;
    } else if (text[i] == '\n' && !long_one) {
      break;
    }
  }
  return std::string_view::npos;
}

}  // namespace

Status CheckTomlLetters(std::string_view text, const std::string& name) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  std::size_t i = text.substr(0, 3) == kByteOrderMark ? 3 : 0;
  while (i < text.size()) {
    const char c = text[i];
    if (static_cast<unsigned char>(c) > 127) {
      const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(i), '\n');
      return InvalidError(name + ":" + std::to_string(line) +
                          ": a letter outside ASCII; keys and numbers have none, texts stand in "
                          "quotes");
    }
    i = c == '#' ? text.find('\n', i) : c == '"' || c == '\'' ? EndOfString(text, i) : i + 1;
  }
  return Ok();
}

}  // namespace palace
