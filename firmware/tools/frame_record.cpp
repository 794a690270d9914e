#include "firmware/tools/frame_record.hpp"

#include <chrono>
#include <utility>

namespace ivo::firmware {
namespace {

// canplayer plays the record of the virtual bus onto a real one of this name.
constexpr const char* kVirtualBus = "vcan0";

/// What the clock on the wall says at Instant{}. Sampled once: a wall clock that is set meanwhile bends no record.
Duration epoch_of(hal::Clock& clock) {
  return std::chrono::system_clock::now().time_since_epoch() - clock.now().time_since_epoch();
}

}  // namespace

Result<std::unique_ptr<FrameRecord>> FrameRecord::open(const RunOptions& options, RunWorld& world) {
  if (options.record.empty()) {
    return std::unique_ptr<FrameRecord>();
  }
  const bool virtual_bus = options.can.empty();
  const Duration epoch = virtual_bus || options.lock_step ? Duration::zero() : epoch_of(world.clock());
  Result<CandumpLog> log = CandumpLog::create(options.record, virtual_bus ? kVirtualBus : options.can, epoch);
  if (!log) {
    return log.error();
  }
  return std::unique_ptr<FrameRecord>(new FrameRecord(options, world, std::move(log).value()));
}

FrameRecord::FrameRecord(const RunOptions& options, RunWorld& world, CandumpLog log)
    : path_(options.record), bus_(world.bus(), ring_), log_(std::move(log)) {}

Result<void> FrameRecord::close() {
  drain();
  return log_.close(ring_);
}

std::string FrameRecord::summary() const { return std::to_string(log_.frames()) + " frames in " + path_; }

}  // namespace ivo::firmware
