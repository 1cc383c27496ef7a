#include "engine/runtime/limit_sweeper.h"

#include <sys/resource.h>

#include <exception>
#include <utility>

#include "engine/core/log.h"
#include "engine/core/units.h"

namespace palace {
namespace {

constexpr double kAgainAfter_s = 2;
constexpr int kNice = 10;  // the engine and its maps go before

SiteContext ContextOf(const EngineSnapshot& snapshot, const TerrainDecision& decision) {
  SiteContext context;
  context.time = decision.map_time;
  context.glide_slope_rad = Rad(snapshot.session->preview_settings.mission.glide_slope_deg);
  const auto& range = snapshot.terrain->range;
  const auto& rig = snapshot.sensors->rig;
  if (range && range->pose && rig && range->time == decision.map_time) {
    context.X_WC = range->pose->X_WC;
    context.camera = range->camera;
    context.p_WB = (context.X_WC * rig->X_BC().Inverse()).p;
  } else if (snapshot.sensors->pose) {
    context.p_WB = snapshot.sensors->pose->X_WB.p;
  }
  return context;
}

}  // namespace

std::optional<SweepRequest> SweepOf(const EngineSnapshot& snapshot, const SettingInfo& limit) {
  const std::shared_ptr<const TerrainDecision>& decision = snapshot.terrain->applied;
  if (!decision || !decision->elevation || !MaySweep(limit)) {
    return std::nullopt;
  }
  return SweepRequest{&limit, decision, snapshot.session->preview_settings,
                      ContextOf(snapshot, *decision), snapshot.flight->mission.refused_sites};
}

LimitSweeper::LimitSweeper() : thread_([this](std::stop_token stop) { Run(stop); }) {}

LimitSweeper::~LimitSweeper() = default;

void LimitSweeper::Ask(const EngineSnapshot& snapshot, const SettingInfo& limit, double now_s) {
  std::optional<SweepRequest> request = SweepOf(snapshot, limit);
  if (!request) {
    return;
  }
  Question question{limit.name, request->settings};
  if (!SetSettingValue(question.others, limit.name, limit.default_value)) {
    return;
  }
  const bool same = asked_ == question;
  if (same && (asked_of_ == request->decision->map_time || now_s < asked_s_ + kAgainAfter_s)) {
    return;
  }
  asked_ = std::move(question);
  asked_of_ = request->decision->map_time;
  asked_s_ = now_s;
  {
    const std::lock_guard lock(mutex_);
    question_ += same ? 0 : 1;
    waiting_ = std::move(request);
  }
  wake_.notify_one();
}

void LimitSweeper::Run(std::stop_token stop) {
  setpriority(PRIO_PROCESS, 0, kNice);  // of this thread alone
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [&] { return waiting_.has_value(); })) {
    const SweepRequest request = *std::exchange(waiting_, std::nullopt);
    const std::uint64_t question = question_;
    lock.unlock();
    try {
      LimitSweep sweep = SweepLimit(request, [&] {
        const std::lock_guard asked(mutex_);
        return !stop.stop_requested() && question == question_;
      });
      if (!sweep.values.empty()) {
        latest_.Store(std::make_shared<const LimitSweep>(std::move(sweep)));
      }
    } catch (const std::exception& error) {
      LogError(std::string("a limit could not be swept: ") + error.what());
    } catch (...) {
      LogError("a limit could not be swept: unknown exception");
    }
    lock.lock();
  }
}

}  // namespace palace
