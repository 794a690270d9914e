#include "firmware/tools/frame_record.hpp"

#include <algorithm>
#include <utility>

namespace ivo::firmware {
namespace {

// canplayer plays the record of the virtual bus onto a real one of this name.
constexpr const char* kVirtualBus = "vcan0";

// How long a frame waits to be written in real time, which is what a kill can lose.
constexpr int kFollowMs = 20;

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
    : path_(options.record), bus_(world.bus(), ring_), log_(std::move(log)), following_(!world.own_time()) {
  if (following_.load()) {
    const auto every = std::chrono::milliseconds(std::clamp(static_cast<int>(kFollowMs / options.speed), 1, kFollowMs));
    writer_ = std::thread([this, every] { follow(every); });
  }
}

void FrameRecord::follow(std::chrono::milliseconds every) {
  try {
    while (following_.load(std::memory_order_relaxed)) {
      log_.drain(ring_);
      std::this_thread::sleep_for(every);
    }
  } catch (...) {  // out of memory, say: the search goes on, what the ring cannot hold is counted, close() tries again
  }
}

void FrameRecord::stop_following() {
  following_.store(false);
  if (writer_.joinable()) {
    writer_.join();
  }
}

void FrameRecord::drain() {
  if (!following_.load(std::memory_order_relaxed)) {
    log_.drain(ring_);
  }
}

Result<void> FrameRecord::close() {
  stop_following();
  drain();
  return log_.close(ring_);
}

std::string FrameRecord::summary() const { return std::to_string(log_.frames()) + " frames in " + path_; }

}  // namespace ivo::firmware
