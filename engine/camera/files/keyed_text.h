// Small text files as named values: what the readers of camera files share.
//
// Each syntax below is the part of its format that camera files use, read by a bounded parser that
// never fails: what it does not understand it leaves out, and the reader then misses a key and says
// so with file, line, key, value and limit.
//
// Files cut short must not read as another camera. A value that the end of the text may have cut
// (no closing bracket or quote after it) is kept as such and refused by Numbers; a syntax
// that closes what it opens (XML, Python dicts, groups of labels) tells by Whole what is open. In
// the formats of one value a line a last number cut between its digits cannot be told from a
// shorter one.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace palace {

/// The text of a value, as it stands in the file, and the line where its key stands.
struct KeyedValue {
  int line = 0;
  std::string text;
  bool is_cut = false;  ///< the text of the file ends in it
  int again_line = 0;   ///< that gives another value to the same key; 0: none
};

constexpr std::size_t kLongestKey = 256;  ///< longer names are no keys, and end up nowhere

/// Values of a file by key. Of keys that occur twice the first counts, but
/// for numbers, which are refused where the other differs; after 65,536 keys no more
/// are taken.
class KeyedText {
 public:
  explicit KeyedText(std::string file) : file_(std::move(file)) {}

  void Add(std::string_view key, int line, std::string_view text, bool is_cut = false);
  bool Has(std::string_view key) const { return Find(key) != nullptr; }
  /// Nothing where the file has no such key.
  const KeyedValue* Find(std::string_view key) const;
  /// The first of `keys` that the file has; empty if none.
  std::string FirstOf(const std::vector<std::string>& keys) const;
  std::vector<std::string> Keys() const;
  /// The text without quotes and blanks around it; empty without the key.
  std::string Word(std::string_view key) const;

  /// Numbers of a value, separated by blanks, commas or brackets; <units> are skipped. Refuses a
  /// missing key, a cut value, a count outside least..most, and numbers that are not finite or
  /// over 1e12.
  Result<std::vector<double>> Numbers(std::string_view key, std::size_t least,
                                      std::size_t most) const;
  Result<double> Number(std::string_view key) const;
  /// A whole number from `least` to `most`.
  Result<int> Count(std::string_view key, int least, int most) const;

  /// "file:line: key = value: what" for what is wrong with a value.
  Error Wrong(std::string_view key, const std::string& what) const;
  Error Missing(std::string_view key, const std::string& remedy) const;
  /// Tells that the text ends before `end` (a bracket, a tag), which closes what `line` opens.
  void LeaveOpen(int line, const std::string& end);
  /// Refuses a text that ends before all it opens is closed.
  Status Whole() const;
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::map<std::string, KeyedValue, std::less<>> values_;
  int open_line_ = 0;
  std::string open_end_;  ///< empty: all is closed
};

/// Text without blanks at its ends.
std::string_view Trimmed(std::string_view text);

/// JPL camera models: lines `key = value`, comments from '#'.
KeyedText ParseAssignments(std::string_view text, const std::string& file);
/// PDS3 and VICAR labels: `key = value` wherever it stands, values quoted, bare or in (brackets)
/// over several lines; keys inside GROUP, OBJECT or PROPERTY are "NAME.KEY". Ends at END.
KeyedText ParseLabel(std::string_view text, const std::string& file);
/// Plain numbers up to the first word of a line that is none; keys are 1, 2, 3... `# key = value`
/// lines count by key.
KeyedText ParseNumberLines(std::string_view text, const std::string& file);
/// YAML: nested maps as "outer.inner", [lists] over several lines, "- item" lists. Tags are
/// skipped, aliases (*name) stay words and stand for nothing. Keys without a value, those of maps
/// too, have an empty one.
KeyedText ParseYaml(std::string_view text, const std::string& file);
/// XML: elements as "outer.inner" without the root; attributes are skipped. Elements without text,
/// those around others too, have an empty one.
KeyedText ParseXml(std::string_view text, const std::string& file);
/// The outermost entries of a Python dict with text keys, comments from '#'.
KeyedText ParsePythonDict(std::string_view text, const std::string& file);

}  // namespace palace
