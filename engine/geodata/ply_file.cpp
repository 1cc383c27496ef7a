#include "engine/geodata/ply_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <utility>

#include "engine/geodata/text_lines.h"

namespace palace {
namespace {

template <typename T>
double Load(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

struct PlyType {
  const char* name;
  const char* other_name;
  std::size_t bytes;
  double (*load)(const char*);
};
constexpr PlyType kTypes[] = {
    {"char", "int8", 1, Load<std::int8_t>},    {"uchar", "uint8", 1, Load<std::uint8_t>},
    {"short", "int16", 2, Load<std::int16_t>}, {"ushort", "uint16", 2, Load<std::uint16_t>},
    {"int", "int32", 4, Load<std::int32_t>},   {"uint", "uint32", 4, Load<std::uint32_t>},
    {"float", "float32", 4, Load<float>},      {"double", "float64", 8, Load<double>},
};

const PlyType* TypeOf(const std::string& name) {
  for (const PlyType& type : kTypes) {
    if (name == type.name || name == type.other_name) {
      return &type;
    }
  }
  return nullptr;
}

/// "float x" or "list uchar int vertex_indices".
Result<PlyProperty> ReadProperty(const std::filesystem::path& path, std::size_t line,
                                 std::istringstream& words) {
  PlyProperty property;
  words >> property.type;
  if (property.type == "list") {
    words >> property.count_type >> property.type;
  }
  words >> property.name;
  for (const std::string& type : {property.type, property.count_type}) {
    if (!(type.empty() && property.count_type.empty()) && TypeOf(type) == nullptr) {
      return ErrorAtLine(path, line, "property type " + QuotedLine(type) + " is not supported");
    }
  }
  if (property.name.empty()) {
    return ErrorAtLine(path, line, "a property needs a type and a name");
  }
  return property;
}

template <typename Named>
bool Holds(const std::vector<Named>& all, const std::string& name) {
  return std::any_of(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
}

/// Whether the data are binary.
Result<bool> ReadFormat(const std::filesystem::path& path, std::size_t line,
                        std::istringstream& words) {
  std::string type;
  words >> type;
  if (type != "ascii" && type != "binary_little_endian") {
    return ErrorAtLine(path, line,
                       "format " + QuotedLine(type) + "; save it as ascii or binary_little_endian");
  }
  return type != "ascii";
}

Result<PlyElement> ReadElement(const std::filesystem::path& path, std::size_t line,
                               std::istringstream& words) {
  PlyElement element;
  long long count = -1;
  if (!(words >> element.name >> count) || count < 0) {
    return ErrorAtLine(path, line, "element " + element.name + " needs a count, 0 or more");
  }
  element.count = static_cast<std::size_t>(count);
  element.line = line;
  return element;
}

}  // namespace

std::size_t PlyElement::IndexOf(std::string_view property) const {
  std::size_t i = 0;
  while (i < properties.size() && properties[i].name != property) {
    ++i;
  }
  return i;
}

Result<PlyHeader> ReadPlyHeader(const std::filesystem::path& path, std::istream& file) {
  PlyHeader header;
  std::size_t format_line = 0;
  std::string line;
  while (std::getline(file, line) && !file.eof()) {
    const std::size_t n = ++header.lines;
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "end_header") {
      return header;
    }
    if (word == "format") {
      const Result<bool> binary = ReadFormat(path, n, words);
      if (!binary) {
        return binary.error();
      }
      if (format_line != 0) {
        return ErrorAtLine(path, n,
                           "a second format, after that of line " + std::to_string(format_line) +
                               "; keep the true one");
      }
      format_line = n;
      header.binary = *binary;
    } else if (word == "element") {
      Result<PlyElement> element = ReadElement(path, n, words);
      if (!element) {
        return element.error();
      }
      if (Holds(header.elements, element->name)) {
        return ErrorAtLine(path, n,
                           "a second element " + QuotedLine(element->name) +
                               "; join its rows with those of the first");
      }
      header.elements.push_back(std::move(*element));
    } else if (word == "property" && !header.elements.empty()) {
      Result<PlyProperty> property = ReadProperty(path, n, words);
      if (!property) {
        return property.error();
      }
      if (Holds(header.elements.back().properties, property->name)) {
        return ErrorAtLine(path, n,
                           "a second property " + QuotedLine(property->name) +
                               " of one element; name the true one alone");
      }
      header.elements.back().properties.push_back(std::move(*property));
    }
  }
  return InvalidError(path.string() + ": no end_header; the PLY file is cut off");
}

Status CheckPlyEnd(const std::filesystem::path& path, std::istream& file, const PlyHeader& header) {
  std::size_t line = header.lines + 1;
  std::string counts;
  for (const PlyElement& element : header.elements) {
    line += element.count;
    counts += (counts.empty() ? "" : ", ") + std::to_string(element.count) + " of " +
              QuotedLine(element.name);
  }
  int next = file.get();
  for (; next == ' ' || next == '\t' || next == '\r' || next == '\n'; next = file.get()) {
    line += next == '\n' ? 1 : 0;
  }
  if (next == std::char_traits<char>::eof()) {
    return Ok();
  }
  const std::string what = "more data than the header counts (" + counts +
                           "); correct its element lines, or cut the rest off";
  return header.binary ? Status(InvalidError(path.string() + ": " + what))
                       : Status(ErrorAtLine(path, line, what));
}

PlyRows::PlyRows(std::filesystem::path path, std::istream& file, bool binary,
                 const PlyElement& element, std::string what)
    : path_(std::move(path)),
      file_(file),
      binary_(binary),
      element_(element),
      what_(std::move(what)),
      values_(element.properties.size(), NAN),
      lists_(element.properties.size()) {}

Status PlyRows::Next() {
  const Status read = binary_ ? NextBinary() : NextText();
  read_ += read.ok() ? 1 : 0;
  return read;
}

Error PlyRows::Broken(const std::string& how) const {
  return InvalidError(path_.string() + ": " + what_ + " " + std::to_string(read_ + 1) + " of " +
                      std::to_string(element_.count) + " " + how);
}

Status PlyRows::NextText() {
  if (!std::getline(file_, line_)) {
    return Broken("is missing");
  }
  const std::size_t most = element_.properties.size() * (kLongestList + 1);
  std::size_t at = 0;
  const std::size_t found = ParseNumbers(line_, most, numbers_);
  for (std::size_t i = 0; i < element_.properties.size(); ++i) {
    if (at >= found) {
      return Broken("is missing or not a number: " + QuotedLine(line_));
    }
    values_[i] = numbers_[at++];
    if (!element_.properties[i].count_type.empty()) {
      if (!(values_[i] >= 0 && values_[i] <= static_cast<double>(found - at))) {
        return Broken("has a list cut off or too long: " + QuotedLine(line_));
      }
      const auto from = numbers_.begin() + static_cast<std::ptrdiff_t>(at);
      const auto length = static_cast<std::ptrdiff_t>(values_[i]);
      lists_[i].assign(from, from + length);
      at += static_cast<std::size_t>(length);
    }
  }
  return Ok();
}

Status PlyRows::NextBinary() {
  std::array<char, 8> bytes{};
  const auto take = [&](const std::string& name, double& value) {
    const PlyType& type = *TypeOf(name);
    file_.read(bytes.data(), static_cast<std::streamsize>(type.bytes));
    value = file_ ? type.load(bytes.data()) : NAN;
    return static_cast<bool>(file_);
  };
  const auto cut = [&] {
    return InvalidError(path_.string() + ": cut off after " + std::to_string(read_) + " of " +
                        std::to_string(element_.count) + " " + what_ + "s");
  };
  for (std::size_t i = 0; i < element_.properties.size(); ++i) {
    const PlyProperty& property = element_.properties[i];
    const bool list = !property.count_type.empty();
    if (!take(list ? property.count_type : property.type, values_[i])) {
      return cut();
    }
    if (!list) {
      continue;
    }
    if (!(values_[i] >= 0 && values_[i] <= static_cast<double>(kLongestList))) {
      return Broken("has a list of no sensible length; the file is damaged");
    }
    lists_[i].resize(static_cast<std::size_t>(values_[i]));
    for (double& value : lists_[i]) {
      if (!take(property.type, value)) {
        return cut();
      }
    }
  }
  return Ok();
}

Status PassOver(const std::filesystem::path& path, std::istream& file, bool binary,
                const PlyElement& element) {
  if (binary && element.properties.empty()) {
    return Ok();  // rows without bytes, as many as the header likes to claim
  }
  PlyRows rows(path, file, binary, element, element.name + " row");
  for (std::size_t n = 0; n < element.count; ++n) {
    if (const Status read = rows.Next(); !read) {
      return read;
    }
  }
  return Ok();
}

}  // namespace palace
