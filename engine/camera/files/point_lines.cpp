#include "engine/camera/files/point_lines.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/core/plain_text.h"

namespace palace {
namespace {

constexpr std::size_t kLongestLine = 4096;
constexpr std::string_view kSeparators = " \t\r,;";

/// The finite numbers of a line; nothing if it holds anything else.
std::optional<std::vector<double>> NumbersOf(std::string_view line) {
  std::vector<double> numbers;
  while (true) {
    const auto first = line.find_first_not_of(kSeparators);
    if (first == std::string_view::npos) {
      return numbers;
    }
    line.remove_prefix(first);
    line.remove_prefix(line.starts_with('+') && !line.starts_with("+-") ? 1 : 0);
    double number = 0;
    const auto [next, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    const auto used = static_cast<std::size_t>(next - line.data());
    if (error != std::errc() || !std::isfinite(number) ||
        (used < line.size() && kSeparators.find(line[used]) == std::string_view::npos)) {
      return std::nullopt;
    }
    numbers.push_back(number);
    line.remove_prefix(used);
  }
}

/// True for a line whose first word is a name: the header of a table.
bool IsHeader(std::string_view line) {
  const auto first = line.find_first_not_of(" \t\"'");
  return first != std::string_view::npos &&
         (std::isalpha(static_cast<unsigned char>(line[first])) != 0 || line[first] == '_') &&
         line.substr(first, 3) != "nan" && line.substr(first, 3) != "inf";
}

void Append(std::string& out, std::initializer_list<double> values) {
  const char* separator = "";
  for (const double value : values) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%s%.17g", separator, value);
    out += text.data();
    separator = ",";
  }
  out += "\n";
}

/// Calls `use` with the numbers of each line of data.
Status ForEachRow(std::istream& in, const std::string& name, std::size_t count, const char* form,
                  const std::function<void(const std::vector<double>&)>& use) {
  bool begun = false;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::string at = name + ":" + std::to_string(number) + ": ";
    if (line.size() > kLongestLine) {
      return InvalidError(at + "longer than 4096 characters; each line holds " + form);
    }
    const std::string_view data = std::string_view(line).substr(0, line.find('#'));
    if (data.find_first_not_of(kSeparators) == std::string_view::npos) {
      continue;
    }
    const auto numbers = NumbersOf(data);
    if (!begun && !numbers && IsHeader(data)) {
      begun = true;
      continue;
    }
    begun = true;
    if (!numbers || numbers->size() != count) {
      return InvalidError(at + "'" + Printable(line.substr(0, 60)) + "' is not " + form +
                          "; each line holds " + std::to_string(count) + " finite numbers");
    }
    use(*numbers);
  }
  return in.bad() ? Status(UnavailableError(name + ": cannot be read")) : Ok();
}

}  // namespace

Result<std::string> ProjectPoints(const CameraModel& model, std::istream& in,
                                  const std::string& name) {
  std::string out;
  const Status status = ForEachRow(in, name, 3, "X,Y,Z", [&](const std::vector<double>& row) {
    if (const auto pixel = ProjectCamera(model, {row[0], row[1], row[2]})) {
      Append(out, {pixel->x(), pixel->y()});
    } else {
      out += "invalid\n";
    }
  });
  return status ? Result<std::string>(out) : Result<std::string>(status.error());
}

Result<std::string> BackProjectPixels(const CameraModel& model, std::istream& in,
                                      const std::string& name) {
  std::string out;
  const Status status = ForEachRow(in, name, 2, "x,y", [&](const std::vector<double>& row) {
    if (const auto ray = RayFromPixelCamera(model, {row[0], row[1]})) {
      const Eigen::Vector3d& o = ray->origin;
      const Eigen::Vector3d& r = ray->direction;
      Append(out, {o.x(), o.y(), o.z(), r.x(), r.y(), r.z()});
    } else {
      out += "invalid\n";
    }
  });
  return status ? Result<std::string>(out) : Result<std::string>(status.error());
}

}  // namespace palace
