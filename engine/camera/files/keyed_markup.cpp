// The syntaxes of keyed_text.h that nest: YAML, XML and Python dicts.
#include <algorithm>
#include <vector>

#include "engine/camera/files/keyed_text.h"

namespace palace {
namespace {

constexpr std::size_t kDeepest = 16;

std::string Joined(const std::vector<std::string>& path) {
  std::string joined;
  for (const std::string& name : path) {
    joined += (joined.empty() ? "" : ".") + name;
  }
  return joined;
}

/// The line without its comment: '#' at the start or after a blank, outside quotes.
std::string_view WithoutComment(std::string_view line) {
  char quote = '\0';
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != '\0') {
      quote = c == quote ? '\0' : quote;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) {
      return line.substr(0, i);
    }
  }
  return line;
}

/// "!!opencv-matrix" and the like in front of a value.
std::string_view WithoutTag(std::string_view value) {
  if (value.substr(0, 1) == "!") {
    const auto end = value.find_first_of(" \t");
    return end == std::string_view::npos ? std::string_view{} : Trimmed(value.substr(end));
  }
  return value;
}

int Balance(std::string_view text) {
  int depth = 0;
  for (const char c : text) {
    depth += c == '[' ? 1 : c == ']' ? -1 : 0;
  }
  return depth;
}

/// One entry of YAML's block structure that is still open.
struct YamlLevel {
  std::size_t indent = 0;
  std::string key;
};

/// Reads YAML line by line.
class YamlReader {
 public:
  YamlReader(std::string_view text, KeyedText& out) : rest_(text), out_(out) {}

  void Read() {
    while (NextLine()) {
      const std::string_view trimmed = Trimmed(content_);
      if (trimmed.empty() || trimmed[0] == '%' || trimmed.substr(0, 3) == "---") {
        continue;
      }
      const std::size_t indent = content_.find_first_not_of(" \t");
      if (trimmed[0] == '-' && (trimmed.size() == 1 || trimmed[1] == ' ')) {
        std::string_view item = trimmed;
        while (item.substr(0, 2) == "- ") {  // lists of lists are read as one
          item = Trimmed(item.substr(1));
        }
        ReadItem(item == "-" ? std::string_view{} : item);
        continue;
      }
      FlushItems();
      ReadEntry(indent, trimmed);
    }
    FlushItems();
  }

 private:
  bool NextLine() {
    if (rest_.empty()) {
      return false;
    }
    const auto end = rest_.find('\n');
    is_last_cut_ = end == std::string_view::npos;
    content_ = WithoutComment(rest_.substr(0, end));
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
    ++line_;
    return true;
  }
  void ReadEntry(std::size_t indent, std::string_view trimmed) {
    const auto colon = trimmed.find(':');
    if (colon == std::string_view::npos || colon > kLongestKey) {
      return;
    }
    while (!open_.empty() && open_.back().indent >= indent) {
      open_.pop_back();
    }
    std::string_view key = Trimmed(trimmed.substr(0, colon));
    if (key.size() >= 2 && (key.front() == '"' || key.front() == '\'')) {
      key = key.substr(1, key.size() - 2);
    }
    if (open_.size() < kDeepest) {
      open_.push_back({indent, std::string(key)});
    }
    key_line_ = line_;
    std::string value(WithoutTag(Trimmed(trimmed.substr(colon + 1))));
    bool is_cut = is_last_cut_;
    if (value.substr(0, 1) == "[") {
      int depth = Balance(value);
      while (depth > 0 && NextLine()) {
        depth += Balance(content_);
        value += " " + std::string(Trimmed(content_));
      }
      is_cut = depth > 0;
    }
    awaits_items_ = value.empty();
    if (!awaits_items_) {
      out_.Add(Path(), key_line_, value, is_cut);
    }
  }
  /// One that is a [list] may go on over several lines.
  void ReadItem(std::string_view item) {
    items_ += " " + std::string(item);
    int depth = item.substr(0, 1) == "[" ? Balance(item) : 0;
    while (depth > 0 && NextLine()) {
      depth += Balance(content_);
      items_ += " " + std::string(Trimmed(content_));
    }
    items_are_cut_ = is_last_cut_ || depth > 0;
  }
  void FlushItems() {
    if ((awaits_items_ || !items_.empty()) && !open_.empty()) {
      out_.Add(Path(), key_line_, items_, items_are_cut_);
    }
    items_.clear();
    awaits_items_ = items_are_cut_ = false;
  }
  std::string Path() const {
    std::vector<std::string> path;
    for (const YamlLevel& level : open_) {
      path.push_back(level.key);
    }
    return Joined(path);
  }

  std::string_view rest_;
  std::string_view content_;
  KeyedText& out_;
  std::vector<YamlLevel> open_;
  std::string items_;
  bool awaits_items_ = false;  ///< of a key without a value so far
  bool items_are_cut_ = false;
  bool is_last_cut_ = false;  ///< the line read last is the text's last, without a newline
  int line_ = 0;
  int key_line_ = 0;
};

int CountLines(std::string_view text) {
  int lines = 0;
  for (const char c : text) {
    lines += c == '\n' ? 1 : 0;
  }
  return lines;
}

/// The text up to the closing quote that `text` starts with; the whole text without one.
std::size_t QuotedLength(std::string_view text) {
  const auto end = text.find(text[0], 1);
  return end == std::string_view::npos ? text.size() : end + 1;
}

/// A text without '#' comments, of the same number of lines; quoted '#' stay.
std::string WithoutPythonComments(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '"' || text[i] == '\'') {
      const std::size_t length = QuotedLength(text.substr(i));
      plain += text.substr(i, length);
      i += length;
    } else if (text[i] == '#') {
      const auto end = text.find('\n', i);
      i = end == std::string_view::npos ? text.size() : end;
    } else {
      plain += text[i++];
    }
  }
  return plain;
}

/// Length of the value at the start of `text`: up to the ',' or '}' that ends the entry.
std::size_t PythonValueLength(std::string_view text) {
  int depth = 0;
  std::size_t i = 0;
  while (i < text.size()) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i += QuotedLength(text.substr(i));
      continue;
    }
    if (depth == 0 && (c == ',' || c == '}')) {
      break;
    }
    depth += c == '[' || c == '(' || c == '{' ? 1 : c == ']' || c == ')' || c == '}' ? -1 : 0;
    ++i;
  }
  return i;
}

}  // namespace

KeyedText ParseYaml(std::string_view text, const std::string& file) {
  KeyedText keyed(file);
  YamlReader(text, keyed).Read();
  return keyed;
}

KeyedText ParseXml(std::string_view text, const std::string& file) {
  KeyedText keyed(file);
  std::vector<std::string> path;        // without the root
  std::vector<std::string_view> names;  // of the elements that are open, the root among them
  int depth = 0;
  int line = 1;
  bool has_root = false;
  std::size_t at = 0;
  const auto leave = [&](std::string_view content) {
    if (!path.empty()) {
      keyed.Add(Joined(path), line, content);
    }
    --depth;
    if (!path.empty() && depth <= static_cast<int>(path.size())) {
      path.pop_back();
    }
  };
  while (at < text.size()) {
    const auto open = text.find('<', at);
    if (open == std::string_view::npos) {
      break;
    }
    const std::string_view content = text.substr(at, open - at);
    const bool comment = text.substr(open, 4) == "<!--";
    const auto close = comment ? text.find("-->", open) : text.find('>', open);
    if (close == std::string_view::npos) {
      break;
    }
    const std::string_view tag = text.substr(open + 1, close - open - 1);
    const std::string_view name = tag.substr(0, tag.find_first_of(" \t\r\n/", 1));
    if (!comment && tag.substr(0, 1) == "/") {
      if (names.empty() || names.back() != name.substr(1)) {
        keyed.LeaveOpen(line + CountLines(content),
                        names.empty() ? "the start tag of <" + std::string(name) + ">"
                                      : "the end tag </" + std::string(names.back()) + ">");
        return keyed;
      }
      names.pop_back();
      leave(content);
    } else if (!comment && !tag.empty() && tag[0] != '?' && tag[0] != '!') {
      has_root = true;
      if (depth > 0 && path.size() < kDeepest) {
        path.emplace_back(tag.substr(0, std::min(tag.find_first_of(" \t\r\n/"), kLongestKey)));
      }
      ++depth;
      names.push_back(name);
      if (tag.back() == '/') {
        names.pop_back();
        leave({});
      }
    }
    line += CountLines(text.substr(at, close + 1 - at));
    at = close + 1;
  }
  if (!has_root || depth > 0) {
    keyed.LeaveOpen(line, "the end tag of the root element");
  }
  return keyed;
}

KeyedText ParsePythonDict(std::string_view text, const std::string& file) {
  KeyedText keyed(file);
  const std::string plain = WithoutPythonComments(text);
  std::string_view rest = plain;
  int line = 1;
  const auto skip = [&](std::size_t count) {
    line += CountLines(rest.substr(0, count));
    rest.remove_prefix(count);
  };
  const auto begin = rest.find('{');
  skip(begin == std::string_view::npos ? rest.size() : begin + 1);
  while (!rest.empty()) {
    const auto quote = rest.find_first_of("\"'}");
    if (quote == std::string_view::npos) {
      break;
    }
    if (rest[quote] == '}') {
      return keyed;
    }
    skip(quote);
    const std::size_t length = QuotedLength(rest);
    const std::string key(rest.substr(1, length < 2 ? 0 : length - 2));
    const int key_line = line;
    skip(length);
    const std::size_t next = rest.find_first_not_of(" \t\r\n");
    if (next == std::string_view::npos || rest[next] != ':') {
      break;
    }
    skip(next + 1);
    const std::size_t value_length = PythonValueLength(rest);
    std::string_view value = Trimmed(rest.substr(0, value_length));
    if (value.substr(0, 2) == "b'" || value.substr(0, 2) == "b\"") {
      value.remove_prefix(1);
    }
    keyed.Add(key, key_line, value, value_length == rest.size());
    skip(value_length);
  }
  keyed.LeaveOpen(line, "the closing } of the dict");
  return keyed;
}

}  // namespace palace
