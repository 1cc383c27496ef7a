#include "engine/core/toml_text.h"

#include "engine/core/plain_text.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace palace {
namespace {

bool IsAscii(char c) { return static_cast<unsigned char>(c) < 128; }

/// Behind the string that begins with the quote at `at`, of a text that is TOML.
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
    }
  }
  return text.size();
}

/// Of a text that is TOML.
Status CheckLetters(std::string_view text, const std::string& name) {
  std::size_t i = 0;
  while (i < text.size()) {
    const char c = text[i];
    if (!IsAscii(c)) {
      const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(i), '\n');
      return InvalidError(name + ":" + std::to_string(line) +
                          ": a letter outside ASCII; keys and numbers have none, texts stand in "
                          "quotes");
    }
    i = c == '#' ? text.find('\n', i) : c == '"' || c == '\'' ? EndOfString(text, i) : i + 1;
  }
  return Ok();
}

Result<toml::table> Parse(std::string_view text, const std::string& name) {
  toml::parse_result parsed = toml::parse(text);
  if (!parsed) {
    return InvalidError(name + ":" + std::to_string(parsed.error().source().begin.line) + ": " +
                        Printable(parsed.error().description()));
  }
  return std::move(parsed).table();
}

}  // namespace

Result<toml::table> ParseToml(std::string_view text, const std::string& name) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  text.remove_prefix(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
  std::string ascii(text);
  std::replace_if(
      ascii.begin(), ascii.end(), [](char c) { return !IsAscii(c); }, 'x');
  if (Result<toml::table> form = Parse(ascii, name); !form) {
    return form;
  }
  if (const Status letters = CheckLetters(text, name); !letters) {
    return letters.error();
  }
  return Parse(text, name);
}

std::optional<double> NumberOfToml(const toml::node& node) {
  if (const auto whole = node.value_exact<std::int64_t>()) {
    return static_cast<double>(*whole);
  }
  return node.value_exact<double>();
}

}  // namespace palace
