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

void DriveStartup::judge_answer(Instant now) noexcept {
  switch (sdo_.status()) {
    case SdoStatus::kIdle:
    case SdoStatus::kBusy:
      break;
    case SdoStatus::kDone:
      if (searching_) {
        search_.on_done(sdo_.value());
        return follow_search();
      }
      return judge_value(now);
    case SdoStatus::kAborted:
      if (searching_) {
        search_.on_refused();
        return follow_search();
      }
      return judge_abort();
    case SdoStatus::kTimedOut: {
      const bool silent = step_ == 0 && !booted_;
      return fail(silent ? DriveFaultReason::kNoAnswer : DriveFaultReason::kSdoTimedOut, step_name(), 0);
    }
  }
}

void DriveStartup::judge_abort() noexcept {
  if (step().action == StepAction::kWrite && step().alternative != 0 && !second_try_) {
    second_try_ = true;
    transfer(step());
  } else if (forgiven(sdo_.abort_code())) {
    next_step();
  } else {
    refuse(DriveFaultReason::kSdoAborted, static_cast<std::uint32_t>(sdo_.abort_code()));
  }
}

bool DriveStartup::forgiven(SdoAbort code) const noexcept {
  const bool missing = code == SdoAbort::kNoObject || code == SdoAbort::kNoSubIndex;
  return step().may_refuse || (step().may_be_missing && missing);
}

void DriveStartup::judge_value(Instant now) noexcept {
  const std::uint32_t value = sdo_.value();
  const StartupStep& wanted = step();
  bool right = true;
  switch (wanted.action) {
    case StepAction::kWrite:
    case StepAction::kWriteMode:
      break;
    case StepAction::kVerify:
      right = (value & wanted.mask) == wanted.value || (wanted.alternative != 0 && value == wanted.alternative);
      break;
    case StepAction::kVerifyOneOf:
      right = value < 32 && (wanted.value >> value & 1) != 0;
      break;
    case StepAction::kVerifyRange:
      right = value >= wanted.value && value <= wanted.highest;
      break;
    case StepAction::kKeep:
      keep(value);
      break;
    case StepAction::kChooseMode: {
      const std::optional<cia402::Mode> mode = cia402::velocity_mode(value);
      right = mode.has_value();
      mode_ = mode.value_or(mode_);
      break;
    }
    case StepAction::kVerifyMode:
      if (value != static_cast<std::uint8_t>(mode_)) {
        mode_deadline_ = mode_deadline_.value_or(now + rates::kStateChangeTimeout);
        if (now < *mode_deadline_) {
          return begin_step();
        }
        right = false;
      }
      break;
    case StepAction::kDisablePdo:
    case StepAction::kSilencePdo:
      if (!second_try_ && (value & cob_id::kPdoInvalid) == 0) {
        return disable_pdo(value);
      }
      break;
  }
  right ? next_step() : refuse(DriveFaultReason::kUnexpectedValue, value);
}

// While a PDO is valid, nothing of its COB-ID but the bit that says so may change (CiA 301, 7.5.2.35).
void DriveStartup::disable_pdo(std::uint32_t cob_id) noexcept {
  second_try_ = true;
  sdo_.start_download(step().object, step().bytes, cob_id | cob_id::kPdoInvalid);
}

void DriveStartup::keep(std::uint32_t value) noexcept {
  const ObjectAddress object = step().object;
  if (object == object::kVendorId) {
    identity_.vendor_id = value;
  } else if (object == object::kProductCode) {
    identity_.product_code = value;
  } else if (object == object::kRevisionNumber) {
    identity_.revision = value;
  } else if (object == object::kSerialNumber) {
    identity_.serial_number = value;
  }
}

void DriveStartup::refuse(DriveFaultReason reason, std::uint32_t code) noexcept {
  if (step().role == PdoRole::kNone) {
    return fail(reason, step().name, code);
  }
  refused_ = {.reason = reason, .node_id = node_id_, .wheel = wheel_, .step = step().refused_name, .code = code};
  searching_ = true;
  search_.open(step().role, node_id_);
  second_try_ = false;
  transfer(search_.step());
}

void DriveStartup::follow_search() noexcept {
  if (search_.state() == PdoSearch::State::kSearching) {
    return transfer(search_.step());
  }
  if (search_.state() == PdoSearch::State::kNone) {
    return fail(refused_.reason, refused_.step, refused_.code);
  }
  const PdoRole role = step().role;
  (role == PdoRole::kCommand ? channels_.command_id : channels_.feedback_id) = search_.cob_id();
  searching_ = false;
  while (steps_[step_ + 1].role == role) {
    ++step_;
  }
  next_step();
}

void DriveStartup::fail(DriveFaultReason reason, const char* step, std::uint32_t code) noexcept {
  phase_ = Phase::kFailed;
  fault_ = {.reason = reason, .node_id = node_id_, .wheel = wheel_, .step = step, .code = code};
}

}  // namespace ivo::drivers
