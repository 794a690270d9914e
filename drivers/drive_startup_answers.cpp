// What start-up makes of a drive's answers: from step to step, to another PDO, or to the end.
#include "config/rates.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/drive_startup.hpp"

namespace ivo::drivers {

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

}  // namespace ivo::drivers
