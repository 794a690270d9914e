#include "drivers/sim/sim_drives.hpp"

#include <algorithm>
#include <span>

#include "config/limits.hpp"
#include "drivers/canopen/cob_id.hpp"

namespace ivo::drivers {
namespace {

constexpr std::size_t kFramesPerRound = kWheels * 2 * SimDrive::kFramesPerCall;
static_assert(kFramesPerRound <= SimDrive::Outbox::capacity());

}  // namespace

SimDrives::SimDrives(hal::CanBus& bus, const Robot& robot, TimeFrom time_from, const Scripts& scripts,
                     const Dictionaries& dictionaries) noexcept
    : bus_(bus),
      time_from_(time_from),
      drives_{SimDrive(robot.drives[0], scripts[0], *dictionaries[0]),
              SimDrive(robot.drives[1], scripts[1], *dictionaries[1]),
              SimDrive(robot.drives[2], scripts[2], *dictionaries[2]),
              SimDrive(robot.drives[3], scripts[3], *dictionaries[3])} {}

void SimDrives::open() noexcept {
  for (SimDrive& drive : drives_) {
    drive.open(out_);
  }
  flush(drives_.front().now());
}

void SimDrives::update(Instant now) noexcept {
  if (time_from_ == TimeFrom::kClock) {
    for (SimDrive& drive : drives_) {
      drive.advance_to(now, out_);
    }
    hear_each_other();
  }
  std::array<hal::ReceivedFrame, limits::kFramesPerCycle> frames;
  const std::size_t count = bus_.receive(frames, now);
  for (const hal::ReceivedFrame& received : std::span(frames).first(count)) {
    if (SimDrive::Outbox::capacity() - out_.size() < kFramesPerRound) {
      flush(now);
    }
    handle(received.frame);
  }
  flush(now);
}

void SimDrives::handle(const hal::CanFrame& frame) noexcept {
  for (SimDrive& drive : drives_) {
    if (time_from_ == TimeFrom::kSync && frame.id == drive.sync_id()) {
      drive.advance_to(drive.now() + drive.sync_period(), out_);
    }
    drive.on_frame(frame, out_);
  }
  hear_each_other();
}

void SimDrives::hear_each_other() noexcept {
  const std::size_t sent = out_.size();
  for (; heard_ < sent; ++heard_) {
    const hal::CanFrame frame = out_[heard_];
    if (frame.id != cob_id::kNmt && frame.id != cob_id::kSync) {
      continue;
    }
    if (SimDrive::Outbox::capacity() - out_.size() < kWheels * SimDrive::kFramesPerCall) {
      break;
    }
    for (SimDrive& drive : drives_) {
      drive.on_frame(frame, out_);
    }
  }
  heard_ = out_.size();
}

void SimDrives::flush(Instant now) noexcept {
  if (!out_.empty()) {
    bus_.send(out_.span(), now);
    out_.clear();
    heard_ = 0;
  }
}

}  // namespace ivo::drivers
