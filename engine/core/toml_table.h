// One table of a TOML file that a person edits: keys asked for by name, checked against limits.
//
// The first error is kept and names file, line, key, value, limit and remedy; keys that nobody
// asked for are errors too. Included by .cpp files only: it brings toml++.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/toml_text.h"

namespace palace {

/// A number's limits and what to do when it is outside them.
struct NumberLimits {
  double least = 0;
  double greatest = 0;
  const char* remedy = "";
  bool whole = false;
};

class TomlTable {
 public:
  /// `name` in `root`, which must outlive this. A missing table is an error once a key is asked
  /// for.
  TomlTable(const toml::table& root, std::string file, std::string name);
  /// One of a list, [[name]], which must outlive this.
  static TomlTable OfList(const toml::table& table, std::string file, std::string name);

  bool present() const { return table_ != nullptr; }
  bool Has(const char* key) const { return table_ != nullptr && table_->contains(key); }

  /// Each of these is 0 or empty after an error.
  double Number(const char* key, const NumberLimits& limits);
  double NumberOr(const char* key, const NumberLimits& limits, double otherwise);
  bool BoolOr(const char* key, bool otherwise);
  std::string Text(const char* key);
  /// A text, or a whole number as text: a device may be given as "0" or 0.
  std::string TextOrIndex(const char* key);
  std::vector<double> Numbers(const char* key, std::size_t least, std::size_t most,
                              const NumberLimits& limits);
  /// Names a key as known without reading it.
  void Allow(const char* key) { asked_.insert(key); }

  void Fail(int line, const std::string& text);
  void FailKey(const char* key, const std::string& text);
  /// The first error, or the first key that was not asked for.
  Status Finish();

 private:
  TomlTable(std::string file, std::string name, const toml::table& table);
  std::string Name(std::string_view key) const { return name_ + "." + std::string(key); }
  std::string Asked() const;
  const toml::node* Required(const char* key);
  double ReadNumber(const toml::node& node, const char* key, const NumberLimits& limits);

  std::string file_;
  std::string name_;
  int line_ = 1;
  const toml::table* table_ = nullptr;
  std::set<std::string> asked_;
  std::optional<Error> error_;
};

}  // namespace palace
