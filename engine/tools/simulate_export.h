// palacectl simulate --export: a simulated session as a folder in EuRoC's layout.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "engine/capture/euroc/euroc_writer.h"
#include "engine/core/result.h"
#include "engine/runtime/source.h"
#include "engine/simulation/session.h"

namespace palace {

/// A session's bundles as they are, each written on its way: pictures with true depth, IMU, truth
/// and the vehicle's navigation. A folder that cannot be written is the source's error.
class ExportingSource final : public Source {
 public:
  /// `hand` is held while a bundle is written, not while it is made; it outlives this.
  static Result<std::unique_ptr<ExportingSource>> Create(const SimulatedSession& session,
                                                         const std::filesystem::path& folder,
                                                         std::mutex& hand);

  Result<std::shared_ptr<const FrameBundle>> Next(std::stop_token stop) override;
  bool IsLockstep() const override { return true; }
  SourceStatus Status() const override { return simulator_->Status(); }
  void Control(const PlaybackControl& control) override { simulator_->Control(control); }

  /// After the last bundle. Tells the number of pairs.
  Result<std::uint64_t> Close();
  /// In place of Close(): nothing of it stays.
  void Remove() { writer_->Remove(); }

 private:
  ExportingSource(const SimulatedSession& session, std::unique_ptr<EurocWriter> writer,
                  std::mutex& hand)
      : simulator_(session.simulator),
        scene_(session.scene),
        writer_(std::move(writer)),
        hand_(hand) {}

  const std::shared_ptr<Simulator> simulator_;
  const World scene_;
  const std::unique_ptr<EurocWriter> writer_;
  std::mutex& hand_;
};

/// Flies a whole mission without a window, a scripted operator in command (as headless palace
/// does), until it has landed or the session's time is over.
Status FlyMission(const SimulatedSession& session, std::shared_ptr<Source> source,
                  std::stop_token stop);

}  // namespace palace
