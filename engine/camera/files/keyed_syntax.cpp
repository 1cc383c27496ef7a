// The syntaxes of keyed_text.h that are lines and labels. Markup: keyed_markup.cpp.
#include <algorithm>
#include <cctype>
#include <vector>

#include "engine/camera/files/keyed_text.h"

namespace palace {
namespace {

/// Lines of a text, numbered from 1. A last one that no newline ends counts as whole: people's
/// files end so.
template <typename Use>
void ForEachLine(std::string_view text, const Use& use) {
  for (int line = 1; !text.empty(); ++line) {
    const auto end = text.find('\n');
    use(line, text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
}

void AddAssignment(KeyedText& keyed, int line, std::string_view content) {
  const auto equals = content.find('=');
  if (equals != std::string_view::npos) {
    keyed.Add(Trimmed(content.substr(0, equals)), line, content.substr(equals + 1));
  }
}

/// A place in a label.
class LabelScanner {
 public:
  explicit LabelScanner(std::string_view text) : text_(text) {}

  bool AtEnd() const { return at_ >= text_.size(); }
  char Peek() const { return AtEnd() ? '\0' : text_[at_]; }
  int line() const { return line_; }
  void Skip() {
    line_ += text_[at_] == '\n' ? 1 : 0;
    ++at_;
  }
  void SkipBlanks() {
    while (!AtEnd()) {
      if (std::isspace(static_cast<unsigned char>(Peek())) != 0) {
        Skip();
      } else if (text_.substr(at_, 2) == "/*") {
        SkipPast("*/");
      } else {
        break;
      }
    }
  }
  std::string_view Key() {
    return While([](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == ':' || c == '^';
    });
  }
  /// A quoted text, a bracketed list or a bare word, with the <unit> after it. `is_cut`: the text
  /// ends before the value does, as far as one can tell.
  std::string_view Value(bool& is_cut) {
    const std::size_t begin = at_;
    is_cut = true;
    if (Peek() == '"' || Peek() == '\'') {
      is_cut = !SkipQuoted();
    } else if (Peek() == '(' || Peek() == '{') {
      for (int depth = 0; !AtEnd();) {
        if (Peek() == '"' || Peek() == '\'') {
          SkipQuoted();
          continue;
        }
        depth += Peek() == '(' || Peek() == '{' ? 1 : Peek() == ')' || Peek() == '}' ? -1 : 0;
        Skip();
        if (depth == 0) {
          is_cut = false;
          break;
        }
      }
    } else {
      While([](char c) { return std::isspace(static_cast<unsigned char>(c)) == 0; });
      is_cut = AtEnd();
    }
    return text_.substr(begin, at_ - begin);
  }

 private:
  template <typename Test>
  std::string_view While(const Test& test) {
    const std::size_t begin = at_;
    while (!AtEnd() && test(Peek())) {
      Skip();
    }
    return text_.substr(begin, at_ - begin);
  }
  /// False where the text ends without the mark.
  bool SkipPast(std::string_view mark) {
    const auto found = text_.find(mark, at_);
    const std::size_t end = found == std::string_view::npos ? text_.size() : found + mark.size();
    while (at_ < end) {
      Skip();
    }
    return found != std::string_view::npos;
  }
  bool SkipQuoted() {
    const std::string_view quote = text_.substr(at_, 1);
    Skip();
    return SkipPast(quote);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

std::string Unquoted(std::string_view text) {
  std::string plain;
  for (const char c : text) {
    if (c != '"' && c != '\'') {
      plain += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
  }
  return plain;
}

}  // namespace

KeyedText ParseAssignments(std::string_view text, const std::string& file) {
  KeyedText keyed(file);
  ForEachLine(text, [&](int line, std::string_view content) {
    AddAssignment(keyed, line, content.substr(0, content.find('#')));
  });
  return keyed;
}

KeyedText ParseNumberLines(std::string_view text, const std::string& file) {
  KeyedText keyed(file);
  int count = 0;
  ForEachLine(text, [&](int line, std::string_view content) {
    const std::string_view trimmed = Trimmed(content);
    if (trimmed.substr(0, 1) == "#") {
      AddAssignment(keyed, line, trimmed.substr(1));
    }
    for (std::string_view rest = trimmed; !rest.empty() && rest[0] != '#';) {
      const std::string_view word = rest.substr(0, rest.find_first_of(" \t#"));
      // A word that is no number ends the line, but a line must begin with one.
      if (rest.size() < trimmed.size() && word.find_first_of("0123456789+-.") != 0) {
        break;
      }
      keyed.Add(std::to_string(++count), line, word);
      rest = Trimmed(rest.substr(word.size()));
    }
  });
  return keyed;
}

KeyedText ParseLabel(std::string_view text, const std::string& file) {
  constexpr std::size_t kDeepest = 16;
  KeyedText keyed(file);
  LabelScanner scan(text);
  std::vector<std::string> inside;
  int group_line = 0;  // 0: of VICAR, whose properties nothing ends
  while (true) {
    scan.SkipBlanks();
    if (scan.AtEnd()) {
      if (!inside.empty() && group_line > 0) {
        keyed.LeaveOpen(group_line, "the end of the group " + inside.back());
      }
      break;
    }
    const int line = scan.line();
    const std::string key(scan.Key());
    if (key.empty()) {
      scan.Skip();
      continue;
    }
    if (key.size() > kLongestKey) {
      continue;
    }
    scan.SkipBlanks();
    if (scan.Peek() != '=') {
      if (key == "END") {
        break;
      }
      if (key == "END_GROUP" || key == "END_OBJECT") {
        inside.resize(inside.size() - std::min<std::size_t>(inside.size(), 1));
      }
      continue;
    }
    scan.Skip();
    scan.SkipBlanks();
    bool is_cut = false;
    const std::string_view value = scan.Value(is_cut);
    if (key == "GROUP" || key == "OBJECT") {
      if (inside.size() < kDeepest) {
        inside.push_back(Unquoted(value.substr(0, kLongestKey)));
        group_line = line;
      }
    } else if (key == "PROPERTY" || key == "TASK") {  // VICAR: ends where the next begins
      inside.assign(1, Unquoted(value.substr(0, kLongestKey)));
      group_line = 0;
    } else if (key == "END_GROUP" || key == "END_OBJECT") {
      inside.resize(inside.size() - std::min<std::size_t>(inside.size(), 1));
    } else {
      keyed.Add(inside.empty() ? key : inside.back() + "." + key, line, value, is_cut);
    }
  }
  return keyed;
}

}  // namespace palace
