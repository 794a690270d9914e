#include "drivers/drive_startup.hpp"

#include "config/rates.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/cia402/objects.hpp"

namespace ivo::drivers {

DriveStartup::DriveStartup(const Robot& robot, Wheel wheel) noexcept
    : node_id_(robot.drives[static_cast<std::size_t>(wheel)].node_id),
      wheel_(wheel),
      steps_(startup_steps(robot, wheel)),
      standard_channels_(standard_channels(robot, wheel)),
      sdo_(node_id_),
      channels_(standard_channels_) {}

void DriveStartup::open() noexcept {
  phase_ = Phase::kResetting;
  booted_ = false;
  restarts_ = 0;
  stopped_ = false;
  heard_ = NmtState::kBootUp;
  fault_ = {};
  sdo_.forget();
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
    case Phase::kConfigured:
      if (restarts_ == kRestarts) {
        return fail(DriveFaultReason::kRebooted, phase_ == Phase::kConfiguring ? step().name : "NMT start", 0);
      }
      ++restarts_;
      booted_ = true;
      configure();
      break;
    case Phase::kStarting:
    case Phase::kConfirming:
      // The others are being started: it cannot join them any more.
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
    configure();
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

const char* DriveStartup::step_name() const noexcept {
  if (phase_ != Phase::kConfiguring) {
    return "";
  }
  return searching_ ? search_.step().name : step().name;
}

void DriveStartup::configure() noexcept {
  phase_ = Phase::kConfiguring;
  sdo_.forget();
  step_ = 0;
  searching_ = false;
  channels_ = standard_channels_;
  identity_ = {};
  mode_deadline_.reset();
  begin_step();
}

void DriveStartup::next_step() noexcept {
  stopped_ = stopped_ || step().object == object::kControlword;
  do {
    ++step_;
  } while (step_ < steps_.size() && left_out(step()));
  if (step_ == steps_.size()) {
    phase_ = Phase::kConfigured;
  } else {
    begin_step();
  }
}

bool DriveStartup::left_out(const StartupStep& step) const noexcept {
  if (step.action == StepAction::kSilencePdo) {
    const int number = step.object.index - object::tpdo_cob_id(1).index + 1;
    return cob_id::tpdo(static_cast<std::uint8_t>(number), node_id_) == channels_.feedback_id;
  }
  return (step.mode == StepMode::kProfileVelocity && mode_ != cia402::Mode::kProfileVelocity) ||
         (step.mode == StepMode::kCyclicSynchronousVelocity && mode_ != cia402::Mode::kCyclicSynchronousVelocity);
}

void DriveStartup::begin_step() noexcept {
  second_try_ = false;
  transfer(step());
}

void DriveStartup::transfer(const StartupStep& step) noexcept {
  switch (step.action) {
    case StepAction::kWrite:
      sdo_.start_download(step.object, step.bytes, second_try_ ? step.alternative : step.value);
      break;
    case StepAction::kWriteMode:
      sdo_.start_download(step.object, step.bytes, static_cast<std::uint8_t>(mode_));
      break;
    case StepAction::kVerify:
    case StepAction::kVerifyOneOf:
    case StepAction::kVerifyRange:
    case StepAction::kKeep:
    case StepAction::kChooseMode:
    case StepAction::kVerifyMode:
    case StepAction::kDisablePdo:
    case StepAction::kSilencePdo:
      sdo_.start_upload(step.object, step.bytes);
      break;
  }
}

void DriveStartup::fail(DriveFaultReason reason, const char* step, std::uint32_t code) noexcept {
  phase_ = Phase::kFailed;
  fault_ = {.reason = reason, .node_id = node_id_, .wheel = wheel_, .step = step, .code = code};
}

}  // namespace ivo::drivers
