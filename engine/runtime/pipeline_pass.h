// What one call of the pipeline works on. For the pipeline's own files only.
#pragma once

#include <exception>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/time.h"
#include "engine/runtime/pipeline.h"

namespace palace {

/// One pass: the snapshot under construction and what only this pass needs.
struct Pipeline::Pass {
  std::shared_ptr<const FrameBundle> bundle;
  std::vector<EngineCommand> commands;
  const SessionStatus& session;
  std::shared_ptr<EngineSnapshot> snapshot;
  RectifiedPair pair{};
  std::shared_ptr<const TerrainDecision> decision_of_record{};
  bool new_map = false;
  bool new_stereo = false;  // the pair was judged; near the ground without ranges or a map
  bool forgotten = false;   // another frame of the position, or another rig: maps began anew
  bool settings_moved = false;

  void Note(DiagnosticLevel level, std::string stage, std::string message) {
    snapshot->session.Edit().diagnostics.push_back({level, std::move(stage), std::move(message)});
  }
  /// Runs and times a stage that the pass can do without: a library's exception becomes a stage
  /// fault. When memory is short no stage can be relied on: that ends the pass.
  template <typename Stage>
  void Run(const char* name, Stage&& stage) {
    Must(name, [&] {
      try {
        stage();
      } catch (const std::bad_alloc&) {
        throw;
      } catch (const std::exception& error) {
        Note(DiagnosticLevel::kError, name, std::string("stage failed: ") + error.what());
      }
    });
  }
  /// Runs and times a stage that watches the descent. What it throws ends the pass: the engine then
  /// holds the vehicle and begins anew, rather than fly on with what stood before.
  template <typename Stage>
  void Must(const char* name, Stage&& stage) {
    const double start_s = MonotonicSeconds();
    stage();
    snapshot->session.Edit().timings.push_back({name, (MonotonicSeconds() - start_s) * 1e3});
  }
};

}  // namespace palace
