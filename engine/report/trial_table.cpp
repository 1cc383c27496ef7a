#include "engine/report/trial_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <set>

#include "engine/core/check.h"
#include "engine/core/plain_text.h"

namespace palace {
namespace {

constexpr int kMostShards = 10000;
constexpr int kMostTrials = 10'000'000;
constexpr std::string_view kMark = "# palace evaluate ";

template <typename T>
bool ReadWhole(std::string_view text, T& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

std::vector<std::string> SplitCommas(std::string_view line) {
  std::vector<std::string> cells;
  while (true) {
    const auto comma = line.find(',');
    cells.emplace_back(line.substr(0, comma));
    if (comma == std::string_view::npos) {
      return cells;
    }
    line.remove_prefix(comma + 1);
  }
}

std::string JoinCommas(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    PALACE_CHECK(cells[i].find_first_of(",\r\n") == std::string::npos, cells[i]);
    line += (i == 0 ? "" : ",") + cells[i];
  }
  return line + "\n";
}

/// "name; seed 1; trials 10; shard 1/1; setup text".
std::optional<TrialHeader> ParseHeader(std::string_view line) {
  if (!line.starts_with(kMark)) {
    return std::nullopt;
  }
  line.remove_prefix(kMark.size());
  std::vector<std::string_view> parts;
  for (int i = 0; i < 4; ++i) {
    const auto end = line.find("; ");
    if (end == std::string_view::npos) {
      return std::nullopt;
    }
    parts.push_back(line.substr(0, end));
    line.remove_prefix(end + 2);
  }
  TrialHeader header;
  header.experiment = parts[0];
  header.setup = line;
  const auto after = [](std::string_view part, std::string_view word) {
    return part.starts_with(word) ? part.substr(word.size()) : std::string_view{};
  };
  const Result<Shard> shard = ParseShard(std::string(after(parts[3], "shard ")));
  if (!shard || !ReadWhole(after(parts[1], "seed "), header.seed) ||
      !ReadWhole(after(parts[2], "trials "), header.trials) || header.trials < 1 ||
      header.trials > kMostTrials) {
    return std::nullopt;
  }
  header.shard = *shard;
  return header;
}

Error At(const std::string& name, int line, const std::string& text) {
  return InvalidError(name + ":" + std::to_string(line) + ": " + Printable(text));
}

}  // namespace

std::size_t TrialTable::Index(std::string_view column) const {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] == column) {
      return i;
    }
  }
  PALACE_CHECK(false, column);
  return 0;
}

double TrialTable::Sum(std::string_view column) const {
  double sum = 0;
  for (const double value : Numbers(column)) {
    sum += value;
  }
  return sum;
}

std::vector<double> TrialTable::Numbers(std::string_view column) const {
  const std::size_t index = Index(column);
  std::vector<double> numbers;
  numbers.reserve(rows.size());
  for (const auto& row : rows) {
    double value = NAN;
    const std::string& text = row[index];
    if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc()) {
      value = NAN;
    }
    numbers.push_back(value);
  }
  return numbers;
}

TrialTable TrialTable::Where(std::string_view column, std::string_view text) const {
  const std::size_t index = Index(column);
  TrialTable part{columns, {}};
  for (const auto& row : rows) {
    if (row[index] == text) {
      part.rows.push_back(row);
    }
  }
  return part;
}

TrialTable TrialTable::WhereNot(std::string_view column, std::string_view text) const {
  const std::size_t index = Index(column);
  TrialTable part = *this;
  std::erase_if(part.rows, [&](const auto& row) { return row[index] == text; });
  return part;
}

std::vector<std::string> TrialTable::Values(std::string_view column) const {
  const std::size_t index = Index(column);
  std::vector<std::string> values;
  for (const auto& row : rows) {
    if (std::find(values.begin(), values.end(), row[index]) == values.end()) {
      values.push_back(row[index]);
    }
  }
  return values;
}

std::string CsvText(std::string text) {
  for (char& c : text) {
    c = c == ',' || c == '\n' || c == '"' ? ';' : c;
  }
  return text;
}

std::string CsvNumber(double value) {
  if (!std::isfinite(value)) {
    return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

Result<Shard> ParseShard(const std::string& text) {
  Shard shard;
  const auto slash = text.find('/');
  const std::string_view view = text;
  if (slash == std::string::npos || !ReadWhole(view.substr(0, slash), shard.index) ||
      !ReadWhole(view.substr(slash + 1), shard.count) || shard.count < 1 ||
      shard.count > kMostShards || shard.index < 1 || shard.index > shard.count) {
    return UsageError("--shard " + text + ": give i/n with 1 <= i <= n <= 10000, e.g. 2/4");
  }
  return shard;
}

std::string TrialFileText(const TrialFile& file) {
  const TrialHeader& h = file.header;
  std::string text = std::string(kMark) + h.experiment + "; seed " + std::to_string(h.seed) +
                     "; trials " + std::to_string(h.trials) + "; shard " +
                     std::to_string(h.shard.index) + "/" + std::to_string(h.shard.count) + "; " +
                     h.setup + "\n" + JoinCommas(file.table.columns);
  for (const auto& row : file.table.rows) {
    PALACE_CHECK(row.size() == file.table.columns.size(), row.size(), file.table.columns.size());
    text += JoinCommas(row);
  }
  return text;
}

Result<TrialFile> ParseTrialFile(std::string_view text, const std::string& name) {
  TrialFile file;
  int line = 0;
  std::set<int> trials;
  while (!text.empty()) {
    const auto end = text.find('\n');
    if (end == std::string_view::npos) {
      return At(name, line + 1, "the file is cut off within this line; run the shard again");
    }
    std::string_view content = text.substr(0, end);
    text = text.substr(end + 1);
    content = content.ends_with('\r') ? content.substr(0, content.size() - 1) : content;
    ++line;
    if (line == 1) {
      const auto header = ParseHeader(content);
      if (!header) {
        return At(name, 1,
                  "this is no table of `palacectl evaluate`: its first line names no experiment");
      }
      file.header = *header;
    } else if (line == 2) {
      file.table.columns = SplitCommas(content);
      if (file.table.columns.size() < 2 || file.table.columns[0] != "trial") {
        return At(name, 2, "the columns must begin with trial,seed");
      }
    } else if (!content.empty()) {
      std::vector<std::string> row = SplitCommas(content);
      int trial = -1;
      if (row.size() != file.table.columns.size()) {
        return At(name, line,
                  std::to_string(row.size()) + " values, there are " +
                      std::to_string(file.table.columns.size()) + " columns");
      }
      if (!ReadWhole(row[0], trial) || trial < 0 || trial >= file.header.trials ||
          !file.header.shard.Holds(trial)) {
        return At(name, line, "trial = " + row[0] + " does not belong to this shard");
      }
      trials.insert(trial);
      file.table.rows.push_back(std::move(row));
    }
  }
  if (line < 2) {
    return At(name, line, "the file ends before its columns");
  }
  for (int trial = file.header.shard.index - 1; trial < file.header.trials;
       trial += file.header.shard.count) {
    if (!trials.contains(trial)) {
      return At(name, line, "trial " + std::to_string(trial) + " has no row; run the shard again");
    }
  }
  return file;
}

Result<TrialFile> MergeTrialFiles(const std::vector<TrialFile>& shards) {
  if (shards.empty()) {
    return UsageError("merge: give the folders or CSV files of the shards");
  }
  const TrialHeader& first = shards.front().header;
  TrialFile merged{first, {shards.front().table.columns, {}}};
  merged.header.shard = Shard{};
  std::map<int, const TrialFile*> by_index;
  for (const TrialFile& shard : shards) {
    const TrialHeader& h = shard.header;
    if (h.experiment != first.experiment || h.seed != first.seed || h.trials != first.trials ||
        h.setup != first.setup || h.shard.count != first.shard.count ||
        shard.table.columns != merged.table.columns) {
      return InvalidError(
          "merge: shard " + std::to_string(h.shard.index) + " of " + h.experiment + " (seed " +
          std::to_string(h.seed) + ", " + std::to_string(h.trials) + " trials, " + h.setup +
          ") and shard " + std::to_string(first.shard.index) + " of " + first.experiment +
          " (seed " + std::to_string(first.seed) + ", " + std::to_string(first.trials) +
          " trials, " + first.setup + ") are not of one run");
    }
    if (!by_index.emplace(h.shard.index, &shard).second) {
      return InvalidError("merge: shard " + std::to_string(h.shard.index) + " is given twice");
    }
  }
  for (int i = 1; i <= first.shard.count; ++i) {
    if (!by_index.contains(i)) {
      return InvalidError("merge: shard " + std::to_string(i) + "/" +
                          std::to_string(first.shard.count) +
                          " is missing; run it, or give its folder");
    }
  }
  for (const auto& [index, shard] : by_index) {
    merged.table.rows.insert(merged.table.rows.end(), shard->table.rows.begin(),
                             shard->table.rows.end());
  }
  std::stable_sort(merged.table.rows.begin(), merged.table.rows.end(),
                   [](const auto& a, const auto& b) {
                     int left = 0, right = 0;
                     ReadWhole(std::string_view(a[0]), left);
                     ReadWhole(std::string_view(b[0]), right);
                     return left < right;
                   });
  return merged;
}

}  // namespace palace
