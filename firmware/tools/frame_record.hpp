// `ivo run --record FILE`: the bus with a copy of every frame, and the file that they go to.
#pragma once

#include <memory>
#include <string>

#include "config/base/result.hpp"
#include "firmware/record/candump_log.hpp"
#include "firmware/record/recording_bus.hpp"
#include "firmware/tools/run_options.hpp"
#include "firmware/tools/run_world.hpp"

namespace ivo::firmware {

class FrameRecord {
 public:
  /// Begins the file, if one was asked for. `world` outlives this.
  [[nodiscard]] static Result<std::unique_ptr<FrameRecord>> open(const RunOptions& options, RunWorld& world);

  /// What the loop is to send and receive by.
  [[nodiscard]] hal::CanBus& bus() noexcept { return bus_; }

  /// From the thread that looks at the loop from outside, several times a second.
  void drain() { log_.drain(ring_); }
  /// Once the loop has ended.
  [[nodiscard]] Result<void> close();
  /// "4711 frames in FILE"
  [[nodiscard]] std::string summary() const;

 private:
  FrameRecord(const RunOptions& options, RunWorld& world, CandumpLog log);

  std::string path_;
  FrameRing ring_;
  RecordingBus bus_;
  CandumpLog log_;
};

}  // namespace ivo::firmware
