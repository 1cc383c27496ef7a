#include "engine/capture/euroc/euroc_tables.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "engine/camera/files/keyed_text.h"
#include "engine/capture/euroc/euroc_frames.h"
#include "engine/core/files.h"
#include "engine/core/plain_text.h"
#include "engine/core/text.h"

namespace palace {
namespace {

constexpr std::size_t kLargestFile = std::size_t{256} << 20;
constexpr std::int64_t kLeastStep_ns = 1000;  // our stamps are microseconds
constexpr double kMostPlace_m = 1e6;
constexpr double kMostSpeed_mps = 1e4;
constexpr double kMostForce_mps2 = 1e4;
constexpr double kMostTurn_radps = 1e3;
constexpr double kQuaternionTolerance = 0.01;  // of its length: files may hold few digits

/// One row of a table, and how to complain about it.
class Row {
 public:
  Row(const std::string& file, int line, std::string_view text) : file_(file), line_(line) {
    for (std::size_t from = 0; from <= text.size();) {
      const std::size_t comma = std::min(text.find(',', from), text.size());
      words_.push_back(Trimmed(text.substr(from, comma - from)));
      from = comma + 1;
    }
  }

  std::size_t values() const { return words_.size() - 1; }
  std::string_view Word(std::size_t value) const { return words_[value + 1]; }
  Error Wrong(const std::string& what) const {
    return InvalidError(file_ + ":" + std::to_string(line_) + ": " + Printable(what));
  }
  Error WrongCount(const char* columns) const {
    return Wrong(std::to_string(words_.size()) + " columns; a row has " + columns);
  }

  Result<std::int64_t> Time() const {
    const std::string_view word = words_.front();
    std::int64_t time_ns = 0;
    const auto [next, error] = std::from_chars(word.data(), word.data() + word.size(), time_ns);
    if (error != std::errc() || next != word.data() + word.size() || time_ns < 0) {
      return Wrong("timestamp = " + std::string(word.substr(0, 40)) +
                   " must be whole nanoseconds from 0 to 9223372036854775807");
    }
    return time_ns;
  }

  /// Three values from the one with that number on, each within -most .. most.
  Result<Eigen::Vector3d> Vector(std::size_t first, const char* name, double most) const {
    Eigen::Vector3d vector;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = Number(first + i, name + std::string("_") + "xyz"[i], most);
      if (!value) {
        return value.error();
      }
      vector[static_cast<Eigen::Index>(i)] = *value;
    }
    return vector;
  }

  Result<double> Number(std::size_t at, const std::string& name, double most) const {
    std::string_view word = Word(at);
    const std::string told = name + " = " + std::string(word.substr(0, 40));
    if (word.starts_with('+') && !word.starts_with("+-")) {
      word.remove_prefix(1);
    }
    double value = NAN;
    const auto [next, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || next != word.data() + word.size() || !std::isfinite(value)) {
      return Wrong(told + " is no finite number");
    }
    if (std::abs(value) > most) {
      return Wrong(told + " is outside " + NumberText(-most) + " .. " + NumberText(most));
    }
    return value;
  }

 private:
  const std::string& file_;
  int line_;
  std::vector<std::string_view> words_;
};

/// Every row of the table by `read`, stamps checked.
template <typename T, typename Read>
Result<std::vector<T>> ReadRows(const std::filesystem::path& path, const Read& read) {
  const auto file = ReadTextFile(path, kLargestFile);
  if (!file) {
    return file.error();
  }
  const std::string name = path.string();
  std::string_view text = *file;
  if (text.substr(0, 3) == "\xEF\xBB\xBF") {
    text.remove_prefix(3);
  }
  std::vector<T> rows;
  int line = 0, last_line = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view content = Trimmed(text.substr(0, std::min(text.find('#'), end)));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line;
    if (content.empty()) {
      continue;
    }
    const Row row(name, line, content);
    const auto time_ns = row.Time();
    if (!time_ns) {
      return time_ns.error();
    }
    if (!rows.empty() && *time_ns - rows.back().time_ns < kLeastStep_ns) {
      return row.Wrong("timestamp = " + std::to_string(*time_ns) + " does not come after the " +
                       std::to_string(rows.back().time_ns) + " of line " +
                       std::to_string(last_line) +
                       "; rows stand in order of time, at least 1000 ns apart");
    }
    Result<T> value = read(row);
    if (!value) {
      return value.error();
    }
    value->time_ns = *time_ns;
    rows.push_back(std::move(value).value());
    last_line = line;
  }
  if (rows.empty()) {
    return InvalidError(name + ": no row; is the file cut short?");
  }
  return rows;
}

Result<EurocState> ReadState(const Row& row) {
  constexpr std::size_t kPose = 7, kVelocity = 10, kBiases = 16;
  if (row.values() != kPose && row.values() != kVelocity && row.values() != kBiases) {
    return row.WrongCount("8 (pose), 11 (and velocity) or 17 (and biases)");
  }
  EurocState state;
  const auto place = row.Vector(0, "p_RS_R", kMostPlace_m);
  if (!place) {
    return place.error();
  }
  std::array<double, 4> q{};
  double square = 0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const auto value = row.Number(3 + i, std::string("q_RS_") + "wxyz"[i], 2);
    if (!value) {
      return value.error();
    }
    q[i] = *value;
    square += *value * *value;
  }
  if (!(std::abs(std::sqrt(square) - 1) < kQuaternionTolerance)) {
    return row.Wrong("q_RS has length " + NumberText(std::sqrt(square)) +
                     ", it must be 1 within 0.01");
  }
  if (row.values() > kPose) {
    const auto velocity = row.Vector(kPose, "v_RS_R", kMostSpeed_mps);
    if (!velocity) {
      return velocity.error();
    }
    state.v_RI = *velocity;
  }
  state.X_RI = {Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix(), *place};
  return state;
}

Result<EurocInertial> ReadInertial(const Row& row) {
  if (row.values() != 6) {
    return row.WrongCount("7 (timestamp, w_RS_S x y z, a_RS_S x y z)");
  }
  EurocInertial sample;
  const auto turn = row.Vector(0, "w_RS_S", kMostTurn_radps);
  const auto force = row.Vector(3, "a_RS_S", kMostForce_mps2);
  if (!turn || !force) {
    return turn ? force.error() : turn.error();
  }
  sample.angular_rate_I = *turn;
  sample.specific_force_I = *force;
  return sample;
}

Result<EurocPicture> ReadPicture(const Row& row) {
  if (row.values() != 1) {
    return row.WrongCount("2 (timestamp, filename)");
  }
  EurocPicture picture;
  picture.file = std::string(row.Word(0));
  constexpr std::size_t kLongestName = 255;
  if (picture.file.empty() || picture.file.size() > kLongestName ||
      picture.file.find_first_of("/\\") != std::string::npos || picture.file.front() == '.') {
    return row.Wrong("filename = " + picture.file.substr(0, 60) +
                     " must be the name of a file in the folder data beside this one, of at most "
                     "255 letters");
  }
  return picture;
}

}  // namespace

Result<std::vector<EurocPicture>> ReadEurocPictures(const std::filesystem::path& data_csv) {
  return ReadRows<EurocPicture>(data_csv, ReadPicture);
}

Result<std::vector<EurocState>> ReadEurocStates(const std::filesystem::path& data_csv) {
  return ReadRows<EurocState>(data_csv, ReadState);
}

Result<std::vector<EurocInertial>> ReadEurocInertials(const std::filesystem::path& data_csv) {
  return ReadRows<EurocInertial>(data_csv, ReadInertial);
}

std::optional<EurocState> StateAt(const std::vector<EurocState>& states, std::int64_t time_ns) {
  const auto after = std::lower_bound(
      states.begin(), states.end(), time_ns,
      [](const EurocState& state, std::int64_t time) { return state.time_ns < time; });
  if (after == states.end()) {
    return std::nullopt;
  }
  if (after->time_ns == time_ns) {
    return *after;
  }
  if (after == states.begin()) {
    return std::nullopt;
  }
  const EurocState& before = *(after - 1);
  if (after->time_ns - before.time_ns > kLongestStateGap_ns) {
    return std::nullopt;
  }
  const double share = static_cast<double>(time_ns - before.time_ns) /
                       static_cast<double>(after->time_ns - before.time_ns);
  return EurocState{time_ns, PoseBetween(before.X_RI, after->X_RI, share),
                    (1 - share) * before.v_RI + share * after->v_RI};
}

}  // namespace palace
