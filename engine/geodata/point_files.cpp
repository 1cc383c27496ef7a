#include "engine/geodata/point_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>

#include "engine/core/files.h"
#include "engine/geodata/column_names.h"
#include "engine/geodata/ply_file.h"
#include "engine/geodata/text_lines.h"

namespace palace {
namespace {

using Points = std::vector<Eigen::Vector3d>;

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

Status Open(const std::filesystem::path& path, std::ifstream& file) {
  if (const Status regular = CheckRegularFile(path); !regular) {
    return regular;
  }
  file.open(path, std::ios::binary);
  return file ? Ok()
              : Status(UnavailableError(path.string() + ": cannot be read; check its permissions"));
}

/// A line before the first row that is none itself.
struct Heading {
  std::string line;
  std::size_t number = 0;
  bool is_comment = false;
};

/// Calls take(numbers, headings) for every line of at least `least` numbers. Comments, empty lines
/// and some headings before the first point are passed over; of comments the last is handed on.
template <typename Take>
Status ReadLines(const std::filesystem::path& path, std::ifstream& file, std::size_t least,
                 Take take) {
  constexpr std::size_t kMostColumns = 16, kMostHeadings = 20;
  std::vector<double> numbers;
  std::size_t columns = 0;
  std::vector<Heading> headings;
  std::string line;
  for (std::size_t n = 1; std::getline(file, line); ++n) {
    if (n == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0) {
      line.erase(0, 3);
    }
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos) {
      continue;
    }
    if (std::strchr("#/%!", line[first]) != nullptr) {
      if (columns == 0) {
        std::erase_if(headings, [](const Heading& heading) { return heading.is_comment; });
        headings.push_back({line, n, true});
      }
      continue;
    }
    if (const auto end = line.find('\r'); end < line.find_last_not_of(" \t\r")) {
      return ErrorAtLine(path, n,
                         "lines end with a carriage return alone; save them with line feeds");
    }
    if (line.find(';') != std::string::npos && line.find(',') != std::string::npos) {
      return ErrorAtLine(path, n,
                         "both ; and , in " + QuotedLine(line) + "; write decimals with a point");
    }
    if (HasDecimalCommas(line)) {
      return ErrorAtLine(path, n,
                         "both blanks and , between numbers in " + QuotedLine(line) +
                             "; write decimals with a point");
    }
    if (ParseNumbers(line, kMostColumns, numbers) < least) {
      const bool begins_a_number = std::strchr("0123456789+-.", line[first]) != nullptr;
      if (columns == 0 && numbers.empty() && !begins_a_number && headings.size() < kMostHeadings) {
        headings.push_back({line, n, false});
        continue;
      }
      return ErrorAtLine(path, n,
                         "expected " + std::string(least > 3 ? "x y z label" : "x y z") +
                             ", found " + QuotedLine(line));
    }
    if (file.eof() && numbers.size() < columns) {
      return ErrorAtLine(path, n, "the last line is cut off: " + QuotedLine(line));
    }
    columns = columns == 0 ? numbers.size() : columns;
    if (const Status taken = take(numbers, headings); !taken) {
      return taken;
    }
  }
  std::erase_if(headings, [](const Heading& heading) { return heading.is_comment; });
  if (columns == 0 && headings.size() > 1) {
    return ErrorAtLine(path, headings.front().number,
                       "expected x y z, found " + QuotedLine(headings.front().line));
  }
  return Ok();
}

/// By whichever of them names all; what another makes doubtful counts only where none does. The
/// first three where none is one of columns.
Result<PointColumns> ColumnsUnder(const std::filesystem::path& path,
                                  const std::vector<Heading>& headings, std::size_t row_numbers) {
  std::optional<Error> doubt;
  for (const Heading& heading : headings) {
    const auto named = ColumnsNamed(heading.line, row_numbers, heading.is_comment);
    if (named && *named) {
      return **named;
    }
    if (!named && !doubt) {
      doubt = ErrorAtLine(path, heading.number, named.error().message);
    }
  }
  return doubt ? Result<PointColumns>(*doubt) : PointColumns{0, 1, 2};
}

Result<Points> ReadText(const std::filesystem::path& path, std::ifstream& file) {
  Points points;
  PointColumns at = {0, 1, 2};
  const Status read = ReadLines(
      path, file, 3, [&](const std::vector<double>& numbers, const std::vector<Heading>& headings) {
        if (points.empty()) {
          const auto named = ColumnsUnder(path, headings, numbers.size());
          if (!named) {
            return Status(named.error());
          }
          at = *named;
        }
        const auto value = [&](std::size_t axis) {
          return at[axis] < numbers.size() ? numbers[at[axis]] : std::nan("");
        };
        points.emplace_back(value(0), value(1), value(2));
        return Ok();
      });
  if (!read) {
    return read.error();
  }
  return points;
}

Result<Points> ReadPly(const std::filesystem::path& path, std::ifstream& file) {
  const auto header = ReadPlyHeader(path, file);
  if (!header) {
    return header.error();
  }
  const auto vertex =
      std::find_if(header->elements.begin(), header->elements.end(),
                   [](const PlyElement& element) { return element.name == "vertex"; });
  if (vertex == header->elements.end()) {
    return InvalidError(path.string() + ": has no element vertex; it is no cloud of points");
  }
  if (std::any_of(header->elements.begin(), vertex,
                  [](const PlyElement& element) { return element.count > 0; })) {
    return ErrorAtLine(path, vertex->line,
                       "the vertices must come first; save the cloud without other data");
  }
  std::array<std::size_t, 3> column{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    constexpr const char* kNames[3] = {"x", "y", "z"};
    column[axis] = vertex->IndexOf(kNames[axis]);
    if (column[axis] == vertex->properties.size()) {
      return InvalidError(path.string() + ": needs vertex properties x, y, z");
    }
  }
  Points points;
  PlyRows rows(path, file, header->binary, *vertex, "point");
  for (std::size_t n = 0; n < vertex->count; ++n) {
    if (const Status read = rows.Next(); !read) {
      return read.error();
    }
    points.emplace_back(rows.Value(column[0]), rows.Value(column[1]), rows.Value(column[2]));
  }
  for (auto other = vertex + 1; other != header->elements.end(); ++other) {
    if (const Status read = PassOver(path, file, header->binary, *other); !read) {
      return read.error();
    }
  }
  if (const Status end = CheckPlyEnd(path, file, *header); !end) {
    return end.error();
  }
  return points;
}

}  // namespace

Result<std::vector<Eigen::Vector3d>> ReadPointFile(const std::filesystem::path& path) {
  std::ifstream file;
  if (const Status open = Open(path, file); !open) {
    return open.error();
  }
  std::string start(4, '\0');
  file.read(start.data(), 4);
  const bool ply = start.rfind("ply", 0) == 0;
  using std::string_literals::operator""s;
  const struct {
    std::string start;
    const char* what;
  } others[] = {{"LASF", "a LAS file; convert it to text of x y z, or to PLY"},
                {"II*\0"s, "a TIFF; an elevation model is given with --elevation"},
                {"MM\0*"s, "a TIFF; an elevation model is given with --elevation"},
                {"\x1F\x8B", "packed by gzip; unpack it first"},
                {"PK\3\4", "packed as ZIP; unpack it first"},
                {"\xFF\xFE", "UTF-16 text; save it as UTF-8"},
                {"\xFE\xFF", "UTF-16 text; save it as UTF-8"}};
  for (const auto& other : others) {
    if (start.rfind(other.start, 0) == 0) {
      return InvalidError(path.string() + " is " + other.what);
    }
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
  std::ifstream file;
  if (const Status open = Open(path, file); !open) {
    return open.error();
  }
  std::vector<LabelledPoint> points;
  const Status read = ReadLines(
      path, file, 4, [&](const std::vector<double>& numbers, const std::vector<Heading>&) {
        points.push_back({{numbers[0], numbers[1], numbers[2]}, numbers[3] == 1});
        return Ok();
      });
  if (!read) {
    return read.error();
  }
  return points;
}

}  // namespace palace
