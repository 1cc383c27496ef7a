#include "engine/core/plain_text.h"

#include <algorithm>

namespace palace {
namespace {

/// Bytes of the UTF-8 character that the text begins with; 0 where it begins with none.
std::size_t LengthOfLetter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80    ? 1
                             : first < 0xC2  ? 0  // goes on, or would be longer than it must
                             : first < 0xE0  ? 2
                             : first < 0xF0  ? 3
                             : first <= 0xF4 ? 4
                                             : 0;
  if (length == 0 || length > text.size()) {
    return 0;
  }
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) {
      return 0;
    }
  }
  const unsigned second = length > 1 ? byte(1) : 0x80;
  const bool wrong = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                     (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
  return wrong ? 0 : length;
}

/// C0, DEL, or C1 in UTF-8.
bool IsControl(std::string_view letter) {
  return letter[0] == '\x7F' || (letter[0] >= 0 && letter[0] < ' ') ||
         (letter.size() == 2 && letter[0] == '\xC2' &&
          static_cast<unsigned char>(letter[1]) < 0xA0);
}

}  // namespace

std::string Printable(std::string_view text) {
  std::string printable;
  while (!text.empty()) {
    const std::size_t length = LengthOfLetter(text);
    const std::string_view letter = text.substr(0, std::max<std::size_t>(1, length));
    if (length > 0 && !IsControl(letter)) {
      printable += letter;
    } else {
      for (const char c : letter) {
        constexpr const char* kDigits = "0123456789ABCDEF";
        const auto byte = static_cast<unsigned char>(c);
        printable += {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
      }
    }
    text.remove_prefix(letter.size());
  }
  return printable;
}

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
