#include "firmware/tools/record_time.hpp"

#include <algorithm>

namespace ivo::firmware {
namespace {

constexpr int kFollowMs = 20;  // of real time

}  // namespace

Duration record_epoch(const RunOptions& options, RunWorld& world) {
  if (options.can.empty() || options.lock_step) {
    return Duration::zero();
  }
  return std::chrono::system_clock::now().time_since_epoch() - world.clock().now().time_since_epoch();
}

std::chrono::milliseconds record_every(const RunOptions& options) {
  return std::chrono::milliseconds(std::clamp(static_cast<int>(kFollowMs / options.speed), 1, kFollowMs));
}

RecordFile::Earlier earlier_record(const RunOptions& options) {
  return options.resume ? RecordFile::Earlier::kSetAside : RecordFile::Earlier::kReplaced;
}

}  // namespace ivo::firmware
