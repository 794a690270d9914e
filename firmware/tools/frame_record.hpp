// `ivo run --record FILE`: the bus with a copy of every frame, and the file that they go to.
#pragma once

#include <memory>
#include <string>

#include "config/base/result.hpp"
#include "firmware/record/candump_log.hpp"
#include "firmware/record/recording_bus.hpp"
#include "firmware/tools/follower.hpp"
#include "firmware/tools/run_options.hpp"
#include "firmware/tools/run_world.hpp"

namespace ivo::firmware {

class FrameRecord {
 public:
  /// Holds the file; null when none was asked for. `options` and `world` outlive this.
  [[nodiscard]] static Result<std::unique_ptr<FrameRecord>> open(const RunOptions& options, RunWorld& world);
  FrameRecord(const FrameRecord&) = delete;
  FrameRecord& operator=(const FrameRecord&) = delete;
  ~FrameRecord() = default;

  /// What the loop is to send and receive by.
  [[nodiscard]] hal::CanBus& bus() noexcept { return bus_; }

  /// Nothing is refused any more: the file begins.
  void start();
  /// Between cycles, where time waits for it; elsewhere a thread of its own writes, which no terminal can block, and
  /// this does nothing.
  void drain();
  /// Once the loop has ended.
  [[nodiscard]] Result<void> close();
  /// "4711 frames in FILE"
  [[nodiscard]] std::string summary() const { return log_.summary(); }

 private:
  FrameRecord(const RunOptions& options, RunWorld& world, CandumpLog log);

  const RunOptions& options_;
  const RunWorld& world_;
  FrameRing ring_;
  RecordingBus bus_;
  CandumpLog log_;
  Follower writer_;  // last: it ends before what it writes to
};

}  // namespace ivo::firmware
