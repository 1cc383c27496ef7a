#include "engine/core/plain_text.h"

#include <algorithm>

namespace palace {

std::string PlainText(std::string_view text, std::size_t most) {
  constexpr std::string_view kCut = "...";
  const bool cut = text.size() > most;
  std::string plain(text.substr(0, cut ? most - std::min(most, kCut.size()) : most));
  std::replace_if(
      plain.begin(), plain.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return cut ? plain.append(kCut) : plain;
}

std::string QuotedText(std::string_view text, std::size_t most) {
  std::string plain = PlainText(text, most);
  std::replace(plain.begin(), plain.end(), '"', '\'');
  return '"' + plain + '"';
}

}  // namespace palace
