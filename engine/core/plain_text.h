// Text of somebody else, made fit to be shown to people.
#pragma once

#include <string>
#include <string_view>

namespace palace {

/// Printable ASCII, "?" for each byte that is none, at most `most` characters: longer text is cut
/// and ends in "...".
std::string PlainText(std::string_view text, std::size_t most);
/// The same in quotes: "alpha". A quote inside becomes '.
std::string QuotedText(std::string_view text, std::size_t most);

inline constexpr std::size_t kLongestName = 60;
inline constexpr std::size_t kLongestReason = 200;

}  // namespace palace
