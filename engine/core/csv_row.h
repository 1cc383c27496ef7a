// One line of a CSV table (RFC 4180): SI numbers with 17 digits, unknown as an empty field.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include <Eigen/Dense>

namespace palace {

/// Fields are appended in order; NaN becomes an empty field, text is quoted where a comma, a quote
/// or a line break needs it.
class CsvRow {
 public:
  CsvRow() = default;
  CsvRow& operator<<(double value) {
    char text[40] = "";
    if (!std::isnan(value)) {
      std::snprintf(text, sizeof text, "%.17g", value);
    }
    return Field(text);
  }
  CsvRow& operator<<(int value) { return Field(std::to_string(value)); }
  CsvRow& operator<<(std::int64_t value) { return Field(std::to_string(value)); }
  CsvRow& operator<<(std::uint64_t value) { return Field(std::to_string(value)); }
  CsvRow& operator<<(const Eigen::Vector3d& v) { return *this << v.x() << v.y() << v.z(); }
  CsvRow& operator<<(const char* text) { return *this << std::string(text); }
  CsvRow& operator<<(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) {
      return Field(text);
    }
    std::string quoted = "\"";
    for (const char c : text) {
      quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return Field(quoted + "\"");
  }
  std::string line() const { return line_ + "\n"; }

 private:
  CsvRow& Field(const std::string& text) {
    line_ += (first_ ? "" : ",") + text;
    first_ = false;
    return *this;
  }
  std::string line_;
  bool first_ = true;
};

}  // namespace palace
