#include "drivers/drive_startup.hpp"

#include "config/rates.hpp"
#include "drivers/cia402/objects.hpp"

namespace ivo::drivers {

DriveStartup::DriveStartup(const DriveParameters& drive, Wheel wheel, std::uint8_t master_node_id) noexcept
    : node_id_(drive.node_id), wheel_(wheel), steps_(startup_steps(drive, master_node_id)), sdo_(drive.node_id) {}

void DriveStartup::open() noexcept {
  phase_ = Phase::kResetting;
  booted_ = false;
  booted_twice_ = false;
  stopped_ = false;
  heard_ = NmtState::kBootUp;
  mode_deadline_.reset();
  fault_ = {};
}

void DriveStartup::start() noexcept {
  if (phase_ == Phase::kConfigured) {
    phase_ = Phase::kStarting;
  }
}

void DriveStartup::on_boot_up() noexcept {
  switch (phase_) {
    case Phase::kBooting:
      booted_ = true;
      break;
    case Phase::kConfiguring:
      // A node that was just booting when it was reset boots twice: the first answer was not to the reset.
      if (step_ == 0 && !booted_twice_) {
        booted_twice_ = true;
        begin_step();
      } else {
        fail(DriveFaultReason::kRebooted, step().name, 0);
      }
      break;
    case Phase::kConfigured:
    case Phase::kStarting:
    case Phase::kConfirming:
      fail(DriveFaultReason::kRebooted, "NMT start", 0);
      break;
    case Phase::kClosed:
    case Phase::kResetting:
    case Phase::kOperational:
    case Phase::kFailed:
      break;
  }
}

void DriveStartup::on_heartbeat(NmtState state) noexcept {
  heard_ = state;
  if (phase_ == Phase::kConfirming && state == NmtState::kOperational) {
    phase_ = Phase::kOperational;
  }
}

void DriveStartup::update(Instant now) noexcept {
  if (phase_ == Phase::kBooting && (booted_ || now >= deadline_)) {
    phase_ = Phase::kConfiguring;
    step_ = 0;
    begin_step();
  } else if (phase_ == Phase::kConfiguring) {
    judge_answer(now);
  } else if (phase_ == Phase::kConfirming && now >= deadline_) {
    fail(DriveFaultReason::kNotOperational, "NMT start", static_cast<std::uint32_t>(heard_));
  }
}

std::optional<hal::CanFrame> DriveStartup::next_frame(Instant now) noexcept {
  switch (phase_) {
    case Phase::kResetting:
      phase_ = Phase::kBooting;
      deadline_ = now + rates::kBootTimeout;
      return nmt_frame({NmtCommand::kResetCommunication, node_id_});
    case Phase::kStarting:
      phase_ = Phase::kConfirming;
      deadline_ = now + rates::kStateChangeTimeout;
      return nmt_frame({NmtCommand::kStart, node_id_});
    case Phase::kConfiguring:
    case Phase::kFailed:  // an abort may still have to close the channel
      return sdo_.poll(now);
    case Phase::kClosed:
    case Phase::kBooting:
    case Phase::kConfigured:
    case Phase::kConfirming:
    case Phase::kOperational:
      break;
  }
  return std::nullopt;
}

bool DriveStartup::awaiting_answer() const noexcept {
  return phase_ == Phase::kBooting || phase_ == Phase::kConfirming ||
         (phase_ == Phase::kConfiguring && sdo_.awaiting_answer());
}

void DriveStartup::next_step() noexcept {
  stopped_ = stopped_ || step().object == object::kControlword;
  if (++step_ == steps_.size()) {
    phase_ = Phase::kConfigured;
  } else {
    begin_step();
  }
}

void DriveStartup::begin_step() noexcept {
  switch (step().action) {
    case StepAction::kWrite:
      sdo_.start_download(step().object, step().bytes, step().value);
      break;
    case StepAction::kWriteMode:
      sdo_.start_download(step().object, step().bytes, static_cast<std::uint8_t>(mode_));
      break;
    case StepAction::kVerify:
    case StepAction::kVerifyOneOf:
    case StepAction::kChooseMode:
    case StepAction::kVerifyMode:
      sdo_.start_upload(step().object, step().bytes);
      break;
  }
}

void DriveStartup::judge_answer(Instant now) noexcept {
  switch (sdo_.status()) {
    case SdoStatus::kIdle:
    case SdoStatus::kBusy:
      break;
    case SdoStatus::kDone:
      judge_value(now);
      break;
    case SdoStatus::kAborted:
    case SdoStatus::kTimedOut:
      judge_failure();
      break;
  }
}

void DriveStartup::judge_failure() noexcept {
  if (sdo_.status() == SdoStatus::kTimedOut) {
    const bool silent = step_ == 0 && !booted_;
    fail(silent ? DriveFaultReason::kNoAnswer : DriveFaultReason::kSdoTimedOut, step().name, 0);
    return;
  }
  if (step().may_refuse) {
    next_step();
  } else {
    fail(DriveFaultReason::kSdoAborted, step().name, static_cast<std::uint32_t>(sdo_.abort_code()));
  }
}

void DriveStartup::judge_value(Instant now) noexcept {
  const std::uint32_t value = sdo_.value();
  switch (step().action) {
    case StepAction::kWrite:
    case StepAction::kWriteMode:
      break;
    case StepAction::kVerify:
      if ((value & step().mask) != step().value) {
        return fail(DriveFaultReason::kUnexpectedValue, step().name, value);
      }
      break;
    case StepAction::kVerifyOneOf:
      if (value >= 32 || (step().value >> value & 1) == 0) {
        return fail(DriveFaultReason::kUnexpectedValue, step().name, value);
      }
      break;
    case StepAction::kChooseMode: {
      const std::optional<cia402::Mode> mode = cia402::velocity_mode(value);
      if (!mode.has_value()) {
        return fail(DriveFaultReason::kUnexpectedValue, step().name, value);
      }
      mode_ = *mode;
      break;
    }
    case StepAction::kVerifyMode:
      if (value != static_cast<std::uint8_t>(mode_)) {
        mode_deadline_ = mode_deadline_.value_or(now + rates::kStateChangeTimeout);
        return now < *mode_deadline_ ? begin_step() : fail(DriveFaultReason::kUnexpectedValue, step().name, value);
      }
      break;
  }
  next_step();
}

void DriveStartup::fail(DriveFaultReason reason, const char* step, std::uint32_t code) noexcept {
  phase_ = Phase::kFailed;
  fault_ = {.reason = reason, .node_id = node_id_, .wheel = wheel_, .step = step, .code = code};
}

}  // namespace ivo::drivers
