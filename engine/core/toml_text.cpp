#include "engine/core/toml_text.h"

#include <algorithm>

namespace palace {
namespace {

/// A string may begin there: nothing stands before it but what a key or a value follows. A quote
/// amid a bare word is one of its letters to the parser.
bool MayBeginString(std::string_view text, std::size_t at) {
  const std::size_t before = at == 0 ? at : text.find_last_not_of(" \t", at - 1);
  return at == 0 || before == std::string_view::npos ||
         std::string_view("=[,{.\n\r").find(text[before]) != std::string_view::npos;
}

/// Behind the string that begins with the quote at `at`; behind the quote alone where the string
/// does not end in its line, or at all: what follows may be read as bare words.
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
  return at + 1;
}

}  // namespace

Status CheckTomlLetters(std::string_view text, const std::string& name) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  text.remove_prefix(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
  std::size_t i = 0;
  while (i < text.size()) {
    const char c = text[i];
    if (static_cast<unsigned char>(c) > 127) {
      const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(i), '\n');
      return InvalidError(name + ":" + std::to_string(line) +
                          ": a letter outside ASCII; keys and numbers have none, texts stand in "
                          "quotes");
    }
    const bool begins = (c == '"' || c == '\'') && MayBeginString(text, i);
    i = c == '#' ? text.find('\n', i) : begins ? EndOfString(text, i) : i + 1;
  }
  return Ok();
}

}  // namespace palace
