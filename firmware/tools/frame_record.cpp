#include "firmware/tools/frame_record.hpp"

#include <utility>

#include "firmware/tools/record_time.hpp"

namespace ivo::firmware {
namespace {

// canplayer plays the record of the virtual bus onto a real one of this name.
constexpr const char* kVirtualBus = "vcan0";

}  // namespace

Result<std::unique_ptr<FrameRecord>> FrameRecord::open(const RunOptions& options, RunWorld& world) {
  if (options.record.empty()) {
    return std::unique_ptr<FrameRecord>();
  }
  Result<CandumpLog> log = CandumpLog::create(options.record, options.can.empty() ? kVirtualBus : options.can,
                                              record_epoch(options, world), earlier_record(options));
  if (!log) {
    return log.error();
  }
  return std::unique_ptr<FrameRecord>(new FrameRecord(options, world, std::move(log).value()));
}

FrameRecord::FrameRecord(const RunOptions& options, RunWorld& world, CandumpLog log)
    : options_(options), world_(world), bus_(world.bus(), ring_), log_(std::move(log)) {}

void FrameRecord::start() {
  if (!world_.own_time()) {
    writer_.start("ivo-record", record_every(options_), [this] { log_.drain(ring_); });
  }
}

void FrameRecord::drain() {
  if (!writer_.running()) {
    log_.drain(ring_);
  }
}

Result<void> FrameRecord::close() {
  writer_.stop();
  drain();
  return log_.close(ring_);
}

}  // namespace ivo::firmware
