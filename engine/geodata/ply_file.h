// PLY files (Turk 1994), ascii and binary_little_endian: a header of elements, then their rows in
// the same order. Whoever asks reads the rows of the elements it knows and passes over the others.
#pragma once

#include <cstddef>
#include <filesystem>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace palace {

struct PlyProperty {
  std::string name;
  std::string type;        ///< "float"
  std::string count_type;  ///< of a list; empty: one number
};

struct PlyElement {
  std::string name;  ///< "vertex"
  std::size_t count = 0;
  std::size_t line = 0;  ///< of the header, where it is declared
  std::vector<PlyProperty> properties{};
  /// Position of a property; properties.size() where there is none.
  std::size_t IndexOf(std::string_view property) const;
};

struct PlyHeader {
  bool binary = false;
  std::size_t lines = 0;  ///< of the header itself
  std::vector<PlyElement> elements{};
};

/// Errors name file and line. Refuses two formats, and two elements or properties of one name.
Result<PlyHeader> ReadPlyHeader(const std::filesystem::path& path, std::istream& file);

/// After the rows of all elements: refuses more of them than the header counts, with their line.
Status CheckPlyEnd(const std::filesystem::path& path, std::istream& file, const PlyHeader& header);

/// Reads the rows of one element in turn. `what` they are, for messages: "point".
class PlyRows {
 public:
  PlyRows(std::filesystem::path path, std::istream& file, bool binary, const PlyElement& element,
          std::string what);
  /// The next row; it must have one. A list longer than kLongestList is damage.
  Status Next();
  /// Of the row read last: a number for each property, a list's count; NaN before the first.
  double Value(std::size_t property) const { return values_[property]; }
  const std::vector<double>& List(std::size_t property) const { return lists_[property]; }

  static constexpr std::size_t kLongestList = 256;

 private:
  Status NextText();
  Status NextBinary();
  Error Broken(const std::string& how) const;

  const std::filesystem::path path_;
  std::istream& file_;
  const bool binary_;
  const PlyElement& element_;
  const std::string what_;
  std::size_t read_ = 0;
  std::vector<double> values_;
  std::vector<std::vector<double>> lists_;
  std::string line_;
  std::vector<double> numbers_;
};

/// Reads the rows of an element that nobody wants.
Status PassOver(const std::filesystem::path& path, std::istream& file, bool binary,
                const PlyElement& element);

}  // namespace palace
