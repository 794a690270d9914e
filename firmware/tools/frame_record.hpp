// `ivo run --record FILE`: the bus with a copy of every frame, and the file that they go to.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "config/base/result.hpp"
#include "firmware/record/candump_log.hpp"
#include "firmware/record/recording_bus.hpp"
#include "firmware/tools/run_options.hpp"
#include "firmware/tools/run_world.hpp"

namespace ivo::firmware {

class FrameRecord {
 public:
  /// Begins the file; null when none was asked for. `world` outlives this.
  [[nodiscard]] static Result<std::unique_ptr<FrameRecord>> open(const RunOptions& options, RunWorld& world);
  FrameRecord(const FrameRecord&) = delete;
  FrameRecord& operator=(const FrameRecord&) = delete;
  ~FrameRecord() { stop_following(); }

  /// What the loop is to send and receive by.
  [[nodiscard]] hal::CanBus& bus() noexcept { return bus_; }

  /// Between cycles, where time waits for it; elsewhere a thread of its own writes, which no terminal can block, and
  /// this does nothing.
  void drain();
  /// Once the loop has ended.
  [[nodiscard]] Result<void> close();
  /// "4711 frames in FILE"
  [[nodiscard]] std::string summary() const;

 private:
  FrameRecord(const RunOptions& options, RunWorld& world, CandumpLog log);
  void follow(std::chrono::milliseconds every);
  void stop_following();

  std::string path_;
  FrameRing ring_;
  RecordingBus bus_;
  CandumpLog log_;
  std::atomic<bool> following_{false};
  std::thread writer_;
};

}  // namespace ivo::firmware
