// Text of somebody else, made fit to be shown to people.
#pragma once

#include <string>
#include <string_view>

namespace palace {

/// As it is but for what a terminal may obey, which becomes "\xNN" byte by byte: control bytes, line
/// ends among them, control characters of UTF-8, and bytes that are no UTF-8. Letters of any
/// language stay. For messages that say back what a file holds.
std::string Printable(std::string_view text);

/// Printable ASCII, "?" for each byte that is none, at most `most` characters: longer text is cut
/// and ends in "...".
std::string PlainText(std::string_view text, std::size_t most);
/// The same in quotes: "alpha". A quote inside becomes '.
std::string QuotedText(std::string_view text, std::size_t most);

inline constexpr std::size_t kLongestName = 60;
inline constexpr std::size_t kLongestReason = 200;

}  // namespace palace
