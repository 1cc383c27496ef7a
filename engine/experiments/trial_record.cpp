#include "engine/experiments/trial_record.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/hash.h"

namespace palace {
namespace {

constexpr std::string_view kDone = "# trial ";
constexpr std::string_view kDoneEnd = " done ";  // a check sum of its rows follows

/// Of the program that runs: another build may count otherwise.
std::string ProgramHash() {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(program), {}};
  ContentHash hash;
  hash.Add(bytes);
  return ShortHash(hash.value());
}

std::string HeadOf(const TrialRecord::Run& run) {
  const TrialHeader& header = run.header;
  std::string head = "# palace trials of " + header.experiment + "; seed " +
                     std::to_string(header.seed) + "; shard " + std::to_string(header.shard.index) +
                     "/" + std::to_string(header.shard.count) + "; program " + ProgramHash() +
                     "; " + header.setup + run.inputs + ";";
  for (const std::string& column : run.columns) {
    head += " " + column;
  }
  return head;
}

std::string RowText(const std::vector<std::string>& row) {
  std::string text;
  for (std::size_t i = 0; i < row.size(); ++i) {
    text += (i == 0 ? "" : ",") + row[i];
  }
  return text + "\n";
}

std::vector<std::string> RowFrom(std::string_view line) {
  std::vector<std::string> row;
  for (auto comma = line.find(','); comma != std::string_view::npos; comma = line.find(',')) {
    row.emplace_back(line.substr(0, comma));
    line.remove_prefix(comma + 1);
  }
  row.emplace_back(line);
  return row;
}

/// The line that ends a trial of such rows.
std::string DoneLine(int trial, std::string_view rows) {
  ContentHash hash;
  hash.Add(rows);
  return std::string(kDone) + std::to_string(trial) + std::string(kDoneEnd) +
         ShortHash(hash.value());
}

/// The trial of a line that ends one; -1 of any other.
int TrialDone(std::string_view line) {
  const auto done = line.find(kDoneEnd);
  if (!line.starts_with(kDone) || done == std::string_view::npos) {
    return -1;
  }
  const std::string_view number = line.substr(kDone.size(), done - kDone.size());
  int trial = -1;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), trial);
  return error == std::errc() && end == number.data() + number.size() ? trial : -1;
}

std::string TrialText(int trial, const TrialRecord::Rows& rows) {
  std::string text;
  for (const auto& row : rows) {
    text += RowText(row);
  }
  return text + DoneLine(trial, text) + "\n";
}

/// Whether another program writes that record now.
bool IsHeld(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    return false;
  }
  const bool held = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return held;
}

Error CannotWrite(const std::filesystem::path& path) {
  return UnavailableError("cannot write " + path.string() +
                          "; choose a folder you may write to, with free space");
}

}  // namespace

Result<TrialRecord> TrialRecord::Open(const std::filesystem::path& path, const Run& run,
                                      bool resume) {
  TrialRecord record;
  record.path_ = path;
  if (IsHeld(path)) {
    return UsageError(path.string() +
                      ": another run writes here now; wait for it, or choose another --out");
  }
  const std::string head = HeadOf(run);
  if (const Status read = record.Read(head, run.columns.size(), resume); !read) {
    return read.error();
  }
  std::string text = head + "\n";
  for (const auto& [trial, rows] : record.done_) {
    text += TrialText(trial, rows);
  }
  std::filesystem::path whole = path;
  whole += ".new";
  record.file_.reset(std::fopen(whole.c_str(), "wb"));
  std::error_code error;
  const bool written =
      record.file_ != nullptr &&
      std::fwrite(text.data(), 1, text.size(), record.file_.get()) == text.size() &&
      std::fflush(record.file_.get()) == 0;
  if (written) {
    // Held until this program ends, however it does. A folder that knows no locks has none.
    static_cast<void>(::flock(fileno(record.file_.get()), LOCK_EX | LOCK_NB));
    std::filesystem::rename(whole, path, error);
  }
  if (!written || error) {
    std::filesystem::remove(whole, error);
    return CannotWrite(path);
  }
  return record;
}

Status TrialRecord::Read(const std::string& head, std::size_t columns, bool resume) {
  std::ifstream in(path_, std::ios::binary);
  if (!in) {
    return Ok();
  }
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!resume) {
    return text.find(kDoneEnd) == std::string::npos
               ? Ok()
               : UsageError(path_.string() +
                            " keeps trials of a run that was ended: --resume goes on with them; "
                            "add --overwrite, or choose another --out, to begin anew");
  }
  std::string_view rest = text;
  Rows rows;
  std::string told;  // the lines of these rows
  for (int number = 1; !rest.empty(); ++number) {
    const auto end = rest.find('\n');
    if (end == std::string_view::npos) {
      break;
    }
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    if (number == 1) {
      if (line != head) {
        return UsageError(
            "--resume: " + path_.string() + " is of another run or another build:\n  " +
            std::string(line) + "\nthis one is\n  " + head +
            "\nchoose another --out, or give --overwrite in place of --resume to begin anew");
      }
    } else if (const int trial = TrialDone(line); trial >= 0) {
      if (line != DoneLine(trial, told) || done_.contains(trial)) {
        return InvalidError(path_.string() + ":" + std::to_string(number) +
                            ": the rows above are not those that trial " + std::to_string(trial) +
                            " wrote; remove the file to begin anew");
      }
      done_[trial] = std::exchange(rows, {});
      told.clear();
    } else {
      told += std::string(line) + "\n";
      rows.push_back(RowFrom(line));
      if (rows.back().size() != columns) {
        return InvalidError(path_.string() + ":" + std::to_string(number) + ": " +
                            std::to_string(rows.back().size()) + " values, there are " +
                            std::to_string(columns) + " columns; remove it to begin anew");
      }
    }
  }
  return Ok();
}

const TrialRecord::Rows* TrialRecord::Done(int trial) const {
  const auto found = done_.find(trial);
  return found == done_.end() ? nullptr : &found->second;
}

Status TrialRecord::Add(int trial, Rows rows) {
  PALACE_CHECK(file_ != nullptr && !done_.contains(trial), trial);
  const std::string text = TrialText(trial, rows);
  done_[trial] = std::move(rows);
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size() ||
      std::fflush(file_.get()) != 0 || fdatasync(fileno(file_.get())) != 0) {
    return CannotWrite(path_);
  }
  return Ok();
}

void TrialRecord::Finish(int trials) {
  file_.reset();
  if (done_.empty() || done_.rbegin()->first < trials) {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
}

}  // namespace palace
