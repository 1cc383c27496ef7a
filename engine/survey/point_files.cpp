#include "engine/survey/point_files.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

namespace palace {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Error AtLine(const std::filesystem::path& path, std::size_t line, const std::string& what) {
  return InvalidError(path.string() + ":" + std::to_string(line) + ": " + what);
}

bool Parts(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r'; }

/// Up to `most` numbers parted by blanks, commas or semicolons; stops at the first other word.
std::size_t ParseNumbers(const std::string& line, std::size_t most, std::vector<double>& numbers) {
  numbers.clear();
  const char* at = line.c_str();
  while (numbers.size() < most) {
    while (Parts(*at)) {
      ++at;
    }
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at || !(Parts(*end) || *end == '\0')) {
      break;
    }
    numbers.push_back(value);
    at = end;
  }
  return numbers.size();
}

/// "0,100 0,000 100,002": a comma within a word, where blanks part the words.
bool HasDecimalCommas(const std::string& line) {
  const auto last = line.find_last_not_of(" \t\r");
  const auto blank = line.find_first_of(" \t", line.find_first_not_of(" \t"));
  if (blank == std::string::npos || blank > last) {
    return false;
  }
  for (std::size_t at = line.find(','); at != std::string::npos; at = line.find(',', at + 1)) {
    const auto digit = [&](std::size_t i) {
      return i < line.size() && line[i] >= '0' && line[i] <= '9';
    };
    if (at > 0 && digit(at - 1) && digit(at + 1)) {
      return true;
    }
  }
  return false;
}

/// Start of a line fit for a message.
std::string Quoted(const std::string& line) {
  std::string text = line.substr(0, 40);
  for (char& c : text) {
    c = c >= ' ' && c <= '~' ? c : '?';
  }
  return '"' + text + '"';
}

/// Calls take(numbers) for every line of at least `least` numbers. Comments, empty lines and
/// headings before the first point are passed over.
template <typename Take>
Status ReadLines(const std::filesystem::path& path, std::ifstream& file, std::size_t least,
                 Take take) {
  constexpr std::size_t kMostColumns = 16;
  std::vector<double> numbers;
  std::size_t columns = 0;
  std::string line;
  for (std::size_t n = 1; std::getline(file, line); ++n) {
    if (n == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0) {
      line.erase(0, 3);
    }
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || std::strchr("#/%!", line[first]) != nullptr) {
      continue;
    }
    if (line.find(';') != std::string::npos && line.find(',') != std::string::npos) {
      return AtLine(path, n, "both ; and , in " + Quoted(line) + "; write decimals with a point");
    }
    if (HasDecimalCommas(line)) {
      return AtLine(
          path, n,
          "both blanks and , between numbers in " + Quoted(line) + "; write decimals with a point");
    }
    if (ParseNumbers(line, kMostColumns, numbers) < least) {
      if (columns == 0 && numbers.empty()) {
        continue;  // a heading
      }
      return AtLine(path, n,
                    "expected " + std::string(least > 3 ? "x y z label" : "x y z") + ", found " +
                        Quoted(line));
    }
    if (file.eof() && numbers.size() < columns) {
      return AtLine(path, n, "the last line is cut off: " + Quoted(line));
    }
    columns = columns == 0 ? numbers.size() : columns;
    take(numbers);
  }
  return Ok();
}

Result<Points> ReadText(const std::filesystem::path& path, std::ifstream& file) {
  Points points;
  const Status read = ReadLines(path, file, 3, [&](const std::vector<double>& numbers) {
    points.emplace_back(numbers[0], numbers[1], numbers[2]);
  });
  if (!read) {
    return read.error();
  }
  return points;
}

struct PlyHeader {
  bool binary = false;
  std::size_t count = 0;
  std::vector<std::pair<std::string, std::string>> properties;  ///< type, name
};

std::size_t SizeOfPlyType(const std::string& type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") {
    return 1;
  }
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") {
    return 2;
  }
  if (type == "double" || type == "float64") {
    return 8;
  }
  return type == "int" || type == "uint" || type == "int32" || type == "uint32" ||
                 type == "float" || type == "float32"
             ? 4
             : 0;
}

Result<PlyHeader> ReadPlyHeader(const std::filesystem::path& path, std::ifstream& file) {
  PlyHeader header;
  std::string line, element;
  bool seen_other = false;
  for (std::size_t n = 1; std::getline(file, line); ++n) {
    std::istringstream words(line);
    std::string word, type, name;
    words >> word;
    if (word == "end_header") {
      return header;
    }
    if (word == "format") {
      words >> type;
      if (type != "ascii" && type != "binary_little_endian") {
        return AtLine(path, n, "format " + type + "; save it as ascii or binary_little_endian");
      }
      header.binary = type != "ascii";
    } else if (word == "element") {
      words >> element;
      seen_other = seen_other || (element != "vertex" && header.count == 0);
      if (element == "vertex") {
        long long count = -1;
        if (!(words >> count) || count < 0) {
          return AtLine(path, n, "element vertex needs a count, 0 or more");
        }
        header.count = static_cast<std::size_t>(count);
        if (seen_other) {
          return AtLine(path, n, "the vertices must come first; save the cloud without other data");
        }
      }
    } else if (word == "property" && element == "vertex") {
      words >> type >> name;
      if (SizeOfPlyType(type) == 0) {
        return AtLine(path, n, "property type " + type + " is not supported for vertices");
      }
      header.properties.emplace_back(type, name);
    }
  }
  return InvalidError(path.string() + ": no end_header; the PLY file is cut off");
}

double PlyNumber(const std::string& type, const char* at) {
  if (type == "double" || type == "float64") {
    double value;
    std::memcpy(&value, at, sizeof value);
    return value;
  }
  if (type == "float" || type == "float32") {
    float value;
    std::memcpy(&value, at, sizeof value);
    return static_cast<double>(value);
  }
  return std::nan("");
}

Result<Points> ReadPly(const std::filesystem::path& path, std::ifstream& file) {
  const auto header = ReadPlyHeader(path, file);
  if (!header) {
    return header.error();
  }
  std::array<std::size_t, 3> column{}, offset{};
  std::array<bool, 3> found{};
  std::size_t size = 0;
  for (std::size_t i = 0; i < header->properties.size(); ++i) {
    const auto& [type, name] = header->properties[i];
    const std::size_t axis = name == "x" ? 0 : name == "y" ? 1 : name == "z" ? 2 : 3;
    if (axis < 3) {
      found[axis] = !header->binary || !std::isnan(PlyNumber(type, "\0\0\0\0\0\0\0"));
      column[axis] = i;
      offset[axis] = size;
    }
    size += SizeOfPlyType(type);
  }
  if (!found[0] || !found[1] || !found[2]) {
    return InvalidError(path.string() + ": needs vertex properties x, y, z of float or double");
  }
  Points points;
  std::vector<double> numbers;
  std::string line;
  std::vector<char> record(size);
  for (std::size_t n = 0; n < header->count; ++n) {
    Eigen::Vector3d p;
    if (header->binary) {
      if (!file.read(record.data(), static_cast<std::streamsize>(size))) {
        return InvalidError(path.string() + ": cut off after " + std::to_string(n) + " of " +
                            std::to_string(header->count) + " points");
      }
      for (std::size_t k = 0; k < 3; ++k) {
        p[static_cast<int>(k)] = PlyNumber(header->properties[column[k]].first, &record[offset[k]]);
      }
    } else {
      const std::size_t most = header->properties.size();
      if (!std::getline(file, line) || ParseNumbers(line, most, numbers) < most) {
        return InvalidError(path.string() + ": point " + std::to_string(n + 1) + " of " +
                            std::to_string(header->count) + " is missing or not a number");
      }
      p = {numbers[column[0]], numbers[column[1]], numbers[column[2]]};
    }
    points.push_back(p);
  }
  return points;
}

}  // namespace

Result<std::vector<Eigen::Vector3d>> ReadPointFile(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return InvalidError(path.string() + " is a folder; give the file of points");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return UnavailableError("cannot read " + path.string() + ": does the file exist?");
  }
  std::string start(4, '\0');
  file.read(start.data(), 4);
  const bool ply = start.rfind("ply", 0) == 0;
  if (start == "LASF") {
    return InvalidError(path.string() + " is a LAS file; convert it to text of x y z, or to PLY");
  }
  file.clear();
  file.seekg(0);
  auto points = ply ? ReadPly(path, file) : ReadText(path, file);
  if (points && points->size() < 3) {
    return InvalidError(path.string() + ": " + std::to_string(points->size()) +
                        " points; expected lines of x y z or a PLY cloud");
  }
  return points;
}

Result<std::vector<LabelledPoint>> ReadLabelledPoints(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return UnavailableError("cannot read " + path.string() + ": does the file exist?");
  }
  std::vector<LabelledPoint> points;
  const Status read = ReadLines(path, file, 4, [&](const std::vector<double>& numbers) {
    points.push_back({{numbers[0], numbers[1], numbers[2]}, numbers[3] == 1});
  });
  if (!read) {
    return read.error();
  }
  return points;
}

}  // namespace palace
