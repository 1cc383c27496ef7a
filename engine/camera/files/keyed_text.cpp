#include "engine/camera/files/keyed_text.h"

#include <charconv>
#include <cmath>
#include <utility>

#include "engine/core/plain_text.h"

namespace palace {
namespace {

constexpr std::size_t kShown = 60;  // characters of a value in a message
constexpr double kLargest = 1e12;

bool IsSeparator(char c) {
  return std::string_view(" \t\r\n\f\v,()[]{}").find(c) != std::string_view::npos;
}

std::string Shown(std::string_view text) {
  std::string shown(text.substr(0, kShown));
  for (char& c : shown) {
    c = c >= ' ' && c <= '~' ? c : ' ';
  }
  return shown + (text.size() > kShown ? "..." : "");
}

}  // namespace

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\f\v";
  const auto first = text.find_first_not_of(kBlanks);
  return first == std::string_view::npos
             ? std::string_view{}
             : text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

void KeyedText::Add(std::string_view key, int line, std::string_view text, bool is_cut) {
  constexpr std::size_t kMostKeys = 65536;
  if (key.size() > 16 * kLongestKey || values_.size() >= kMostKeys) {
    return;
  }
  const auto [place, is_new] =
      values_.try_emplace(std::string(key), KeyedValue{line, std::string(Trimmed(text)), is_cut});
  if (!is_new && place->second.again_line == 0 && place->second.text != Trimmed(text)) {
    place->second.again_line = line;
  }
}

const KeyedValue* KeyedText::Find(std::string_view key) const {
  const auto found = values_.find(key);
  return found == values_.end() ? nullptr : &found->second;
}

std::string KeyedText::FirstOf(const std::vector<std::string>& keys) const {
  for (const std::string& key : keys) {
    if (Has(key)) {
      return key;
    }
  }
  return {};
}

std::vector<std::string> KeyedText::Keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, value] : values_) {
    keys.push_back(key);
  }
  return keys;
}

std::string KeyedText::Word(std::string_view key) const {
  const KeyedValue* value = Find(key);
  if (value == nullptr) {
    return {};
  }
  std::string_view text = value->text;
  if (text.size() >= 2 && text.front() == text.back() && (text[0] == '"' || text[0] == '\'')) {
    text = Trimmed(text.substr(1, text.size() - 2));
  }
  return std::string(text);
}

Error KeyedText::Wrong(std::string_view key, const std::string& what) const {
  const KeyedValue* value = Find(key);
  const std::string place = value == nullptr ? file_ : file_ + ":" + std::to_string(value->line);
  return InvalidError(place + ": " + Printable(key) + " = " +
                      (value == nullptr ? "" : Shown(value->text)) + ": " + what);
}

Error KeyedText::Missing(std::string_view key, const std::string& remedy) const {
  return InvalidError(file_ + ": " + Printable(key) + " is missing; " + remedy);
}

void KeyedText::LeaveOpen(int line, const std::string& end) {
  if (open_end_.empty()) {
    open_line_ = line;
    open_end_ = end;
  }
}

Status KeyedText::Whole() const {
  return open_end_.empty()
             ? Ok()
             : Status(InvalidError(file_ + ":" + std::to_string(open_line_) + ": " + open_end_ +
                                   " is missing, the file is cut short or damaged; fetch it anew"));
}

Result<std::vector<double>> KeyedText::Numbers(std::string_view key, std::size_t least,
                                               std::size_t most) const {
  const KeyedValue* value = Find(key);
  const std::string wanted =
      std::to_string(least) + (least == most ? "" : " to " + std::to_string(most));
  if (value == nullptr) {
    return Missing(key, "give its " + wanted + (most == 1 ? " number" : " numbers"));
  }
  if (value->again_line > 0) {
    return Wrong(key, "line " + std::to_string(value->again_line) +
                          " gives it again with another value; leave one of them");
  }
  if (value->is_cut) {
    return Wrong(key,
                 "the file ends in this value, it may be cut short; fetch it anew, or close the "
                 "bracket or end the line if the value is whole");
  }
  std::vector<double> numbers;
  std::string_view rest = value->text;
  while (true) {
    while (!rest.empty() && IsSeparator(rest.front())) {
      rest.remove_prefix(1);
    }
    if (!rest.empty() && rest.front() == '<') {
      const auto end = rest.find('>');
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
      continue;
    }
    if (rest.empty() || numbers.size() > most) {
      break;
    }
    if (rest.front() == '+' && rest.substr(1, 1) != "-") {
      rest.remove_prefix(1);
    }
    double number = 0;
    const auto [next, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    const auto used = static_cast<std::size_t>(next - rest.data());
    const bool ends = used == rest.size() || IsSeparator(rest[used]) || rest[used] == '<';
    if (error != std::errc() || !ends || !std::isfinite(number)) {
      return Wrong(key, "not a list of finite numbers");
    }
    if (std::abs(number) > kLargest) {
      return Wrong(key, "numbers must lie within -1e12 .. 1e12");
    }
    numbers.push_back(number);
    rest.remove_prefix(used);
  }
  if (numbers.size() < least || numbers.size() > most) {
    return Wrong(key, (numbers.size() > most ? "more than " + std::to_string(most)
                                             : std::to_string(numbers.size())) +
                          " numbers, it must have " + wanted);
  }
  return numbers;
}

Result<double> KeyedText::Number(std::string_view key) const {
  const auto numbers = Numbers(key, 1, 1);
  return numbers ? Result<double>(numbers->front()) : Result<double>(numbers.error());
}

Result<int> KeyedText::Count(std::string_view key, int least, int most) const {
  const auto number = Number(key);
  if (!number) {
    return number.error();
  }
  if (!(*number >= least && *number <= most) || *number != std::floor(*number)) {
    return Wrong(key, "must be a whole number from " + std::to_string(least) + " to " +
                          std::to_string(most));
  }
  return static_cast<int>(*number);
}

}  // namespace palace
