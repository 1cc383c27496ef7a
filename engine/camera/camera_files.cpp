#include "engine/camera/camera_files.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

#include "engine/camera/cahvor.h"
#include "engine/camera/text_file.h"

namespace palace {
namespace {

constexpr std::size_t kSizeLimit = 1 << 20;
constexpr double kLargestSide_px = 65536;

std::string_view Trim(std::string_view text) {
  const char* blanks = " \t\r\f\v";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// A `key = values` line.
struct Entry {
  int line = 0;
  std::string_view values;
};

using Entries = std::map<std::string, Entry, std::less<>>;

std::string At(const std::string& name, int line, std::string_view key) {
  return name + ":" + std::to_string(line) + ": " + std::string(key);
}

/// All keyed lines; the first of a key counts. Lines without '=' (covariances) are not ours.
Entries SplitLines(std::string_view text) {
  Entries entries;
  int line = 0;
  while (!text.empty()) {
    ++line;
    const auto end = text.find('\n');
    std::string_view content = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    content = content.substr(0, content.find('#'));
    const auto equals = content.find('=');
    if (equals != std::string_view::npos) {
      entries.try_emplace(std::string(Trim(content.substr(0, equals))),
                          Entry{line, Trim(content.substr(equals + 1))});
    }
  }
  return entries;
}

Result<std::vector<double>> ReadNumbers(const Entries& entries, const std::string& name,
                                        std::string_view key, std::size_t count) {
  const auto found = entries.find(key);
  if (found == entries.end()) {
    return InvalidError(name + ": " + std::string(key) +
                        " is missing; a JPL camera model needs it");
  }
  std::vector<double> numbers;
  std::string_view rest = found->second.values;
  while (!rest.empty()) {
    double number = 0;
    const char* end = rest.data() + rest.size();
    const auto [next, error] = std::from_chars(rest.data(), end, number);
    if (error != std::errc() || !std::isfinite(number)) {
      return InvalidError(At(name, found->second.line, key) + " = " +
                          std::string(found->second.values.substr(0, 60)) +
                          ": not a list of finite numbers");
    }
    numbers.push_back(number);
    rest = Trim(rest.substr(static_cast<std::size_t>(next - rest.data())));
  }
  if (numbers.size() != count) {
    return InvalidError(At(name, found->second.line, key) + " has " +
                        std::to_string(numbers.size()) + " numbers, it must have " +
                        std::to_string(count));
  }
  return numbers;
}

Status ReadVector(const Entries& entries, const std::string& name, std::string_view key,
                  Eigen::Vector3d& vector) {
  const auto numbers = ReadNumbers(entries, name, key, 3);
  if (!numbers) {
    return numbers.error();
  }
  vector = {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  return Ok();
}

Status ReadUnitVector(const Entries& entries, const std::string& name, std::string_view key,
                      Eigen::Vector3d& vector) {
  if (Status status = ReadVector(entries, name, key, vector); !status) {
    return status;
  }
  const double length = vector.norm();
  if (!(length > 0.99 && length < 1.01)) {
    return InvalidError(At(name, entries.find(key)->second.line, key) + " has length " +
                        std::to_string(length) + ", a direction must have length 1");
  }
  vector /= length;
  return Ok();
}

Status ReadDimensions(const Entries& entries, const std::string& name, CahvorModel& model) {
  const auto numbers = ReadNumbers(entries, name, "Dimensions", 2);
  if (!numbers) {
    return numbers.error();
  }
  for (const double side : *numbers) {
    if (!(side >= 1 && side <= kLargestSide_px) || side != std::floor(side)) {
      return InvalidError(At(name, entries.find("Dimensions")->second.line, "Dimensions") +
                          ": sides must be whole numbers from 1 to 65536 px");
    }
  }
  model.width = static_cast<int>((*numbers)[0]);
  model.height = static_cast<int>((*numbers)[1]);
  return Ok();
}

/// True for CAHVOR, false for CAHV.
Result<bool> ReadKind(const Entries& entries, const std::string& name) {
  const auto found = entries.find("Model");
  if (found == entries.end()) {
    return entries.contains("O") && entries.contains("R");
  }
  const std::string_view value = found->second.values;
  const std::string_view word = value.substr(0, value.find_first_of(" =,\t"));
  if (word == "CAHV" || word == "CAHVOR") {
    return word == "CAHVOR";
  }
  return InvalidError(At(name, found->second.line, "Model") + " = " +
                      std::string(word.substr(0, 40)) +
                      ": only CAHV and CAHVOR can be a rig's camera; convert the model first");
}

}  // namespace

Result<CahvorModel> ParseCahvorText(std::string_view text, const std::string& name) {
  if (text.size() > kSizeLimit) {
    return InvalidError(name + ": larger than 1 MiB; is it a camera model?");
  }
  const Entries entries = SplitLines(text);
  const auto is_cahvor = ReadKind(entries, name);
  if (!is_cahvor) {
    return is_cahvor.error();
  }
  CahvorModel model;
  std::vector<Status> steps = {
      ReadDimensions(entries, name, model), ReadVector(entries, name, "C", model.C),
      ReadUnitVector(entries, name, "A", model.A), ReadVector(entries, name, "H", model.H),
      ReadVector(entries, name, "V", model.V)};
  if (*is_cahvor) {
    steps.push_back(ReadUnitVector(entries, name, "O", model.O));
    steps.push_back(ReadVector(entries, name, "R", model.R));
  } else {
    model.O = model.A;
  }
  for (const Status& step : steps) {
    if (!step) {
      return step.error();
    }
  }
  if (!(model.A.cross(model.H).norm() > 1e-6) || !(model.A.cross(model.V).norm() > 1e-6)) {
    return InvalidError(name + ": H or V runs along A; the focal length would be 0");
  }
  return model;
}

Result<CahvorModel> ReadCahvorFile(const std::filesystem::path& path) {
  const auto text = ReadTextFile(path, kSizeLimit);
  if (!text) {
    return text.error();
  }
  return ParseCahvorText(*text, path.string());
}

std::string CahvorToText(const CahvorModel& model) {
  const bool linear = IsLinear(model);
  std::string text =
      "Dimensions = " + std::to_string(model.width) + " " + std::to_string(model.height) +
      "\nModel = " + (linear ? "CAHV = perspective, linear" : "CAHVOR = perspective, distortion") +
      "\n";
  const auto add = [&](const char* key, const Eigen::Vector3d& v) {
    std::array<char, 128> line{};
    std::snprintf(line.data(), line.size(), "%s = %.17g %.17g %.17g\n", key, v.x(), v.y(), v.z());
    text += line.data();
  };
  add("C", model.C);
  add("A", model.A);
  add("H", model.H);
  add("V", model.V);
  if (!linear) {
    add("O", model.O);
    add("R", model.R);
  }
  return text;
}

}  // namespace palace
