// LimitSweeper: sweeps of one limit beside the flight, on a thread that yields to every other.
//
// The newest question is answered; one about another limit, or under other limits, gives up the
// sweep under way, a newer map waits for its end. The thread touches nothing of the engine: it
// reads the map and the places of one snapshot, which never change.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "engine/core/latest_value.h"
#include "engine/model/snapshot.h"
#include "engine/runtime/limit_sweep.h"

namespace palace {

/// What is asked of the decision in force, all other limits as they are previewed; nothing before
/// there is one, or where the limit cannot be swept.
std::optional<SweepRequest> SweepOf(const EngineSnapshot& snapshot, const SettingInfo& limit);

class LimitSweeper {
 public:
  LimitSweeper();
  ~LimitSweeper();
  LimitSweeper(const LimitSweeper&) = delete;
  LimitSweeper& operator=(const LimitSweeper&) = delete;

  /// Once a frame while somebody looks; returns at once. The same question of a newer map is asked
  /// again no sooner than two seconds after it was last.
  void Ask(const EngineSnapshot& snapshot, const SettingInfo& limit, double now_s);
  /// The last one that was not given up; of whatever limit was asked for then. Null: none yet.
  std::shared_ptr<const LimitSweep> Latest() const { return latest_.Load(); }

 private:
  /// What makes two sweeps of one map the same: its own value of the limit does not count.
  struct Question {
    std::string limit;
    Settings others;
    friend bool operator==(const Question&, const Question&) = default;
  };
  void Run(std::stop_token stop);

  std::optional<Question> asked_;
  Timestamp asked_of_;
  double asked_s_ = 0;

  LatestValue<LimitSweep> latest_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::optional<SweepRequest> waiting_;
  std::uint64_t question_ = 0;  ///< counts those that differ
  std::jthread thread_;         ///< last: joined before the rest goes
};

}  // namespace palace
