#include "drivers/pdo_search.hpp"

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/canopen/pdo.hpp"
#include "drivers/cia402/objects.hpp"

namespace ivo::drivers {
namespace {

constexpr std::uint32_t kMappedObjects = 2;

constexpr std::array<const char*, cob_id::kPdos> kRpdoNames{"RPDO1 as it is", "RPDO2 as it is", "RPDO3 as it is",
                                                            "RPDO4 as it is"};
constexpr std::array<const char*, cob_id::kPdos> kTpdoNames{"TPDO1 as it is", "TPDO2 as it is", "TPDO3 as it is",
                                                            "TPDO4 as it is"};

bool same_id(std::uint32_t one, std::uint32_t other) noexcept { return ((one ^ other) & cob_id::kPdoCompared) == 0; }

}  // namespace

void PdoSearch::open(PdoRole role, std::uint8_t node_id) noexcept {
  role_ = role;
  node_id_ = node_id;
  number_ = 1;
  state_ = State::kSearching;
  begin();
}

void PdoSearch::begin() noexcept {
  stage_ = Stage::kReadFirst;
  cob_id_ = role_ == PdoRole::kCommand ? cob_id::rpdo(number_, node_id_)
                                       : cob_id::tpdo(number_, node_id_) | cob_id::kPdoNoRemote;
}

StartupStep PdoSearch::step() const noexcept {
  const bool command = role_ == PdoRole::kCommand;
  const ObjectAddress count = command ? object::rpdo_count(number_) : object::tpdo_count(number_);
  const ObjectAddress cob_id = command ? object::rpdo_cob_id(number_) : object::tpdo_cob_id(number_);
  StartupStep step{.name = (command ? kRpdoNames : kTpdoNames)[number_ - 1U],
                   .action = reads() ? StepAction::kKeep : StepAction::kWrite};
  switch (stage_) {
    case Stage::kReadFirst:
    case Stage::kReadSecond:
      step.object = object::mapping_entry(count, stage_ == Stage::kReadFirst ? 1 : 2);
      step.bytes = 4;
      break;
    case Stage::kReadCount:
    case Stage::kWriteCount:
    case Stage::kCheckCount:
      step.object = count;
      step.bytes = 1;
      step.value = kMappedObjects;
      break;
    case Stage::kReadType:
    case Stage::kWriteType:
    case Stage::kCheckType:
      step.object = {cob_id.index, 2};
      step.bytes = 1;
      step.value = kEverySync;
      break;
    case Stage::kReadCobId:
    case Stage::kInvalidate:
    case Stage::kValidate:
    case Stage::kCheckCobId:
      step.object = cob_id;
      step.bytes = 4;
      step.value = stage_ == Stage::kInvalidate ? cob_id_found_ | cob_id::kPdoInvalid : cob_id_;
      break;
  }
  return step;
}

void PdoSearch::on_done(std::uint32_t value) noexcept {
  const bool command = role_ == PdoRole::kCommand;
  switch (stage_) {
    case Stage::kReadFirst:
      return value == object::mapped(command ? object::kControlword : object::kStatusword, 16) ? next_stage()
                                                                                               : next_candidate();
    case Stage::kReadSecond:
      return value == object::mapped(command ? object::kTargetVelocity : object::kPositionActual, 32)
                 ? next_stage()
                 : next_candidate();
    case Stage::kReadCount:
      count_ = value;
      break;
    case Stage::kReadType:
      type_ = value;
      break;
    case Stage::kReadCobId:
      cob_id_found_ = value;
      if (count_ == kMappedObjects && type_ == kEverySync && same_id(value, cob_id_)) {
        state_ = State::kFound;
        return;
      }
      break;
    case Stage::kCheckCount:
      return value == kMappedObjects ? next_stage() : next_candidate();
    case Stage::kCheckType:
      return value == kEverySync ? next_stage() : next_candidate();
    case Stage::kCheckCobId:
      if (!same_id(value, cob_id_)) {
        return next_candidate();
      }
      state_ = State::kFound;
      return;
    case Stage::kInvalidate:
    case Stage::kWriteCount:
    case Stage::kWriteType:
    case Stage::kValidate:
      break;
  }
  next_stage();
}

// A refused write is judged by what is read back; what cannot be read cannot be trusted.
void PdoSearch::on_refused() noexcept { reads() ? next_candidate() : next_stage(); }

void PdoSearch::next_stage() noexcept {
  do {
    stage_ = static_cast<Stage>(static_cast<int>(stage_) + 1);
  } while (!needed());
}

bool PdoSearch::needed() const noexcept {
  switch (stage_) {
    case Stage::kInvalidate:
      return (cob_id_found_ & cob_id::kPdoInvalid) == 0;
    case Stage::kWriteCount:
      return count_ != kMappedObjects;
    case Stage::kWriteType:
      return type_ != kEverySync;
    default:
      return true;
  }
}

void PdoSearch::next_candidate() noexcept {
  if (number_ == cob_id::kPdos) {
    state_ = State::kNone;
    return;
  }
  ++number_;
  begin();
}

}  // namespace ivo::drivers
