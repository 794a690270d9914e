#include "drivers/startup_steps.hpp"

#include <chrono>

#include "config/base/contract.hpp"
#include "config/rates.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/canopen/pdo.hpp"
#include "drivers/cia402/controlword.hpp"
#include "drivers/cia402/objects.hpp"

namespace ivo::drivers {
namespace {

constexpr std::uint32_t milliseconds(Duration d) noexcept {
  return static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::milliseconds>(d).count());
}

constexpr std::uint32_t microseconds(Duration d) noexcept {
  return static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::microseconds>(d).count());
}

void add(StartupSteps& steps, const StartupStep& step) noexcept { IVO_CONTRACT(steps.push_back(step)); }

void add_identity(StartupSteps& steps, const DriveParameters& drive) noexcept {
  add(steps, {.name = "device type 1000h",
              .action = StepAction::kVerify,
              .object = object::kDeviceType,
              .bytes = 4,
              .value = cia402::kProfileNumber,
              .mask = 0xFFFF});
  if (drive.vendor_id != 0) {
    add(steps, {.name = "vendor-ID 1018h:1",
                .action = StepAction::kVerify,
                .object = object::kVendorId,
                .bytes = 4,
                .value = drive.vendor_id});
  }
  if (drive.product_code != 0) {
    add(steps, {.name = "product code 1018h:2",
                .action = StepAction::kVerify,
                .object = object::kProductCode,
                .bytes = 4,
                .value = drive.product_code});
  }
}

void add_stop(StartupSteps& steps) noexcept {
  add(steps, {.name = "target velocity 60FFh", .object = object::kTargetVelocity, .bytes = 4, .value = 0});
  add(steps, {.name = "controlword 6040h",
              .object = object::kControlword,
              .bytes = 2,
              .value = cia402::controlword::kDisableVoltage});
}

void add_mode_choice(StartupSteps& steps) noexcept {
  add(steps, {.name = "supported drive modes 6502h",
              .action = StepAction::kChooseMode,
              .object = object::kSupportedModes,
              .bytes = 4});
}

void add_supervision(StartupSteps& steps, std::uint8_t master_node_id) noexcept {
  add(steps, {.name = "consumer heartbeat time 1016h:1",
              .object = object::kConsumerHeartbeat,
              .bytes = 4,
              .value = std::uint32_t{master_node_id} << 16 | milliseconds(rates::kMasterHeartbeatTimeout)});
  add(steps, {.name = "producer heartbeat time 1017h",
              .object = object::kProducerHeartbeat,
              .bytes = 2,
              .value = milliseconds(rates::kDriveHeartbeat)});
  add(steps, {.name = "communication cycle period 1006h",
              .object = object::kCyclePeriod,
              .bytes = 4,
              .value = microseconds(rates::kCycle)});
  add(steps, {.name = "quick stop option code 605Ah",
              .object = object::kQuickStopOption,
              .bytes = 2,
              .value = cia402::kQuickStopRampThenOff,
              .may_refuse = true});
  add(steps, {.name = "quick stop option code 605Ah in force: 1, 2, 5 or 6, a ramp",
              .action = StepAction::kVerifyOneOf,
              .object = object::kQuickStopOption,
              .bytes = 2,
              .value = cia402::kQuickStopsWithRamp});
  add(steps, {.name = "abort connection option code 6007h",
              .object = object::kAbortConnectionOption,
              .bytes = 2,
              .value = cia402::kQuickStopOnLostMaster,
              .may_refuse = true});
  add(steps, {.name = "abort connection option code 6007h in force: 1, 2 or 3, or the drive would go on moving without "
                      "its master",
              .action = StepAction::kVerifyOneOf,
              .object = object::kAbortConnectionOption,
              .bytes = 2,
              .value = cia402::kStopsOnLostMaster});
}

struct PdoNames {
  const char* disable = "";
  const char* clear = "";
  const char* first = "";
  const char* second = "";
  const char* count = "";
  const char* check = "";
  const char* type = "";
  const char* enable = "";
};

struct PdoSteps {
  PdoNames names;
  ObjectAddress cob_id_object;
  ObjectAddress type_object;
  ObjectAddress count_object;
  std::uint32_t cob_id = 0;
  std::uint32_t first = 0;
  std::uint32_t second = 0;
};

void add_pdo(StartupSteps& steps, const PdoSteps& pdo) noexcept {
  add(steps,
      {.name = pdo.names.disable, .object = pdo.cob_id_object, .bytes = 4, .value = pdo.cob_id | cob_id::kPdoInvalid});
  add(steps, {.name = pdo.names.clear, .object = pdo.count_object, .bytes = 1, .value = 0});
  add(steps,
      {.name = pdo.names.first, .object = object::mapping_entry(pdo.count_object, 1), .bytes = 4, .value = pdo.first});
  add(steps, {.name = pdo.names.second,
              .object = object::mapping_entry(pdo.count_object, 2),
              .bytes = 4,
              .value = pdo.second});
  add(steps, {.name = pdo.names.count, .object = pdo.count_object, .bytes = 1, .value = 2});
  add(steps,
      {.name = pdo.names.check, .action = StepAction::kVerify, .object = pdo.count_object, .bytes = 1, .value = 2});
  add(steps, {.name = pdo.names.type, .object = pdo.type_object, .bytes = 1, .value = kEverySync});
  add(steps, {.name = pdo.names.enable, .object = pdo.cob_id_object, .bytes = 4, .value = pdo.cob_id});
}

constexpr PdoNames kRpdoNames{"disable RPDO1 1400h:1",           "clear RPDO1 mapping 1600h:0",
                              "map controlword 1600h:1",         "map target velocity 1600h:2",
                              "count RPDO1 mapping 1600h:0",     "read back RPDO1 mapping 1600h:0",
                              "RPDO1 transmission type 1400h:2", "enable RPDO1 1400h:1"};
constexpr PdoNames kTpdoNames{"disable TPDO1 1800h:1",           "clear TPDO1 mapping 1A00h:0",
                              "map statusword 1A00h:1",          "map position 1A00h:2",
                              "count TPDO1 mapping 1A00h:0",     "read back TPDO1 mapping 1A00h:0",
                              "TPDO1 transmission type 1800h:2", "enable TPDO1 1800h:1"};

}  // namespace

StartupSteps startup_steps(const DriveParameters& drive, std::uint8_t master_node_id) noexcept {
  StartupSteps steps;
  add_identity(steps, drive);
  add_stop(steps);
  add_mode_choice(steps);
  add_supervision(steps, master_node_id);
  add_pdo(steps, {.names = kRpdoNames,
                  .cob_id_object = object::kRpdo1CobId,
                  .type_object = object::kRpdo1Type,
                  .count_object = object::kRpdo1Count,
                  .cob_id = cob_id::rpdo1(drive.node_id),
                  .first = object::mapped(object::kControlword, 16),
                  .second = object::mapped(object::kTargetVelocity, 32)});
  add_pdo(steps, {.names = kTpdoNames,
                  .cob_id_object = object::kTpdo1CobId,
                  .type_object = object::kTpdo1Type,
                  .count_object = object::kTpdo1Count,
                  .cob_id = cob_id::tpdo1(drive.node_id) | cob_id::kPdoNoRemote,
                  .first = object::mapped(object::kStatusword, 16),
                  .second = object::mapped(object::kPositionActual, 32)});
  add(steps, {.name = "mode of operation 6060h",
              .action = StepAction::kWriteMode,
              .object = object::kModeOfOperation,
              .bytes = 1});
  add(steps, {.name = "mode of operation 6061h",
              .action = StepAction::kVerifyMode,
              .object = object::kModeDisplay,
              .bytes = 1});
  return steps;
}

}  // namespace ivo::drivers
