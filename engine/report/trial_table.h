// The table of an experiment's trials as CSV text: whole, or one shard of it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace palace {

/// Rows of texts under named columns. The first two columns are `trial` and `seed`.
struct TrialTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  /// Position of a column; it must exist.
  std::size_t Index(std::string_view column) const;
  /// A column as numbers; NaN where the text is no number.
  std::vector<double> Numbers(std::string_view column) const;
  /// Of those numbers; NaN when one is.
  double Sum(std::string_view column) const;
  /// The rows whose `column` reads `text`.
  TrialTable Where(std::string_view column, std::string_view text) const;
  /// The other rows.
  TrialTable WhereNot(std::string_view column, std::string_view text) const;
  /// The different texts of a column, in the order of first appearance.
  std::vector<std::string> Values(std::string_view column) const;
};

/// Ten significant digits, "nan" for NaN: the form of every number in the CSV.
std::string CsvNumber(double value);
/// A text without what would end its cell: commas, quotes and line ends become semicolons.
std::string CsvText(std::string text);

/// The part of the trials one run does: those with trial % count == index - 1.
struct Shard {
  int index = 1;
  int count = 1;
  bool Holds(int trial) const { return trial % count == index - 1; }
  bool whole() const { return count == 1; }
  friend bool operator==(const Shard&, const Shard&) = default;
};
/// "2/4". Refuses anything else, and shards beyond 10,000.
Result<Shard> ParseShard(const std::string& text);

/// What was run; stands in the first line of the CSV.
struct TrialHeader {
  std::string experiment;
  std::string setup;
  std::uint64_t seed = 1;
  int trials = 0;
  Shard shard;
};

struct TrialFile {
  TrialHeader header;
  TrialTable table;
};

/// Texts with a comma or a line break are a bug of the experiment.
std::string TrialFileText(const TrialFile& file);
/// Errors name the file, the line and what was expected.
Result<TrialFile> ParseTrialFile(std::string_view text, const std::string& name);
/// One table of all shards, rows in the order of the trials. Refuses shards of different
/// experiments, seeds, setups or columns, and missing or double shards.
Result<TrialFile> MergeTrialFiles(const std::vector<TrialFile>& shards);

}  // namespace palace
