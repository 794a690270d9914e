#include "drivers/startup_pdo_steps.hpp"

#include <array>
#include <chrono>
#include <cstddef>

#include "config/base/contract.hpp"
#include "config/rates.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/canopen/pdo.hpp"
#include "drivers/canopen/pdo_layout.hpp"
#include "drivers/cia402/objects.hpp"

namespace ivo::drivers {
namespace {

enum NameOf : std::size_t {  // of a step of one PDO
  kDisable,
  kClear,
  kFirst,
  kSecond,
  kCount,
  kFirstInForce,
  kSecondInForce,
  kCountInForce,
  kType,
  kTypeInForce,
  kDeadline,
  kEnable,
  kEnableInForce,
  kNames,
};
using Names = std::array<const char*, kNames>;

constexpr Names kCommandNames{"disable RPDO1 1400h:1",
                              "clear RPDO1 mapping 1600h:0",
                              "map controlword 1600h:1",
                              "map target velocity 1600h:2",
                              "count RPDO1 mapping 1600h:0",
                              "read back controlword in 1600h:1",
                              "read back target velocity in 1600h:2",
                              "read back RPDO1 mapping 1600h:0",
                              "RPDO1 transmission type 1400h:2",
                              "read back RPDO1 transmission type 1400h:2",
                              "RPDO1 deadline 1400h:5",
                              "enable RPDO1 1400h:1",
                              "read back RPDO1 COB-ID 1400h:1"};
constexpr Names kFirstTargetNames{
    "disable RPDO2 1401h:1",           "clear RPDO2 mapping 1601h:0",
    "map target velocity 1601h:1",     "map dummy 0007h or 0004h 1601h:2, to share targets with another drive",
    "count RPDO2 mapping 1601h:0",     "read back target velocity in 1601h:1",
    "read back dummy in 1601h:2",      "read back RPDO2 mapping 1601h:0",
    "RPDO2 transmission type 1401h:2", "read back RPDO2 transmission type 1401h:2",
    "RPDO2 deadline 1401h:5",          "enable RPDO2 1401h:1",
    "read back RPDO2 COB-ID 1401h:1"};
constexpr Names kSecondTargetNames{"disable RPDO2 1401h:1",
                                   "clear RPDO2 mapping 1601h:0",
                                   "map dummy 0007h or 0004h 1601h:1, to share targets with another drive",
                                   "map target velocity 1601h:2",
                                   "count RPDO2 mapping 1601h:0",
                                   "read back dummy in 1601h:1",
                                   "read back target velocity in 1601h:2",
                                   "read back RPDO2 mapping 1601h:0",
                                   "RPDO2 transmission type 1401h:2",
                                   "read back RPDO2 transmission type 1401h:2",
                                   "RPDO2 deadline 1401h:5",
                                   "enable RPDO2 1401h:1",
                                   "read back RPDO2 COB-ID 1401h:1"};
constexpr Names kFeedbackNames{"disable TPDO1 1800h:1",
                               "clear TPDO1 mapping 1A00h:0",
                               "map statusword 1A00h:1",
                               "map position 1A00h:2",
                               "count TPDO1 mapping 1A00h:0",
                               "read back statusword in 1A00h:1",
                               "read back position in 1A00h:2",
                               "read back TPDO1 mapping 1A00h:0",
                               "TPDO1 transmission type 1800h:2",
                               "read back TPDO1 transmission type 1800h:2",
                               "",
                               "enable TPDO1 1800h:1",
                               "read back TPDO1 COB-ID 1800h:1"};

// The names again for the case that no other PDO would do either.
using LongName = std::array<char, 112>;

constexpr std::array<LongName, kNames> with(const Names& names, const char* rest) noexcept {
  std::array<LongName, kNames> longer{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::size_t length = 0;
    for (const char* part : {names[i], rest}) {
      for (; *part != '\0'; ++part) {
        longer[i][length++] = *part;
      }
    }
    longer[i][length] = '\0';
  }
  return longer;
}

constexpr std::array<LongName, kNames> kCommandRefused =
    with(kCommandNames, "; nor does any of RPDO1 to RPDO4 hold 6040h and 60FFh as it is");
constexpr std::array<LongName, kNames> kFeedbackRefused =
    with(kFeedbackNames, "; nor does any of TPDO1 to TPDO4 hold 6041h and 6064h as it is");

constexpr std::array<const char*, cob_id::kPdos> kSilenceNames{"silence TPDO1 1800h:1", "silence TPDO2 1801h:1",
                                                               "silence TPDO3 1802h:1", "silence TPDO4 1803h:1"};

constexpr std::uint32_t kDummy = object::mapped(object::kDummyUnsigned32, 32);
constexpr std::uint32_t kOtherDummy = object::mapped(object::kDummyInteger32, 32);

struct Pdo {
  const Names* names = nullptr;
  const std::array<LongName, kNames>* refused = nullptr;  // none: no other PDO will do
  PdoRole role = PdoRole::kNone;
  ObjectAddress cob_id_object;
  ObjectAddress type_object;
  ObjectAddress count_object;
  std::uint32_t cob_id = 0;
  std::array<std::uint32_t, 2> mapped{};
  std::uint8_t count = 2;
  std::uint32_t deadline_ms = 0;  // 0: none is written
};

/// Adds the steps of one PDO.
class PdoSteps {
 public:
  PdoSteps(StartupSteps& steps, const Pdo& pdo) noexcept : steps_(steps), pdo_(pdo) {}

  void add_all() noexcept {
    add(kDisable, {.action = StepAction::kDisablePdo, .object = pdo_.cob_id_object, .bytes = 4});
    write(kClear, pdo_.count_object, 1, 0);
    map(kFirst, StepAction::kWrite);
    write(kCount, pdo_.count_object, 1, pdo_.count);
    map(kFirstInForce, StepAction::kVerify);
    verify(kCountInForce, pdo_.count_object, 1, pdo_.count);
    write(kType, pdo_.type_object, 1, kEverySync);
    verify(kTypeInForce, pdo_.type_object, 1, kEverySync);
    if (pdo_.deadline_ms != 0) {
      add(kDeadline,
          {.object = {pdo_.cob_id_object.index, 5}, .bytes = 2, .value = pdo_.deadline_ms, .may_refuse = true});
    }
    write(kEnable, pdo_.cob_id_object, 4, pdo_.cob_id);
    add(kEnableInForce, {.action = StepAction::kVerify,
                         .object = pdo_.cob_id_object,
                         .bytes = 4,
                         .value = pdo_.cob_id & cob_id::kPdoCompared,
                         .mask = cob_id::kPdoCompared});
  }

 private:
  void map(NameOf first_name, StepAction action) noexcept {
    for (std::uint8_t n = 0; n < pdo_.count; ++n) {
      const std::uint32_t entry = pdo_.mapped[n];
      add(static_cast<NameOf>(first_name + n),
          {.action = action,
           .object = object::mapping_entry(pdo_.count_object, static_cast<std::uint8_t>(n + 1)),
           .bytes = 4,
           .value = entry,
           .alternative = entry == kDummy ? kOtherDummy : 0});
    }
  }
  void write(NameOf name, ObjectAddress object, std::uint8_t bytes, std::uint32_t value) noexcept {
    add(name, {.object = object, .bytes = bytes, .value = value});
  }
  void verify(NameOf name, ObjectAddress object, std::uint8_t bytes, std::uint32_t value) noexcept {
    add(name, {.action = StepAction::kVerify, .object = object, .bytes = bytes, .value = value});
  }
  void add(NameOf name, StartupStep step) noexcept {
    step.name = (*pdo_.names)[name];
    step.role = pdo_.role;
    step.refused_name = pdo_.refused != nullptr ? (*pdo_.refused)[name].data() : step.name;
    IVO_CONTRACT(steps_.push_back(step));
  }

  StartupSteps& steps_;
  const Pdo& pdo_;
};

}  // namespace

void add_pdo_steps(StartupSteps& steps, const Robot& robot, Wheel wheel) noexcept {
  const auto drive = static_cast<std::size_t>(wheel);
  const PdoChannels channels = standard_channels(robot, wheel);
  const bool shared = robot.pdo_layout == PdoLayout::kShared;
  // As for our heartbeat: commands that stay away are a master that is gone.
  const auto deadline_ms = static_cast<std::uint32_t>(
      std::chrono::duration_cast<std::chrono::milliseconds>(rates::kMasterHeartbeatTimeout).count());
  const std::uint32_t controlword = object::mapped(object::kControlword, 16);
  const std::uint32_t target = object::mapped(object::kTargetVelocity, 32);

  Pdo command{.names = &kCommandNames,
              .refused = shared ? nullptr : &kCommandRefused,
              .role = shared ? PdoRole::kNone : PdoRole::kCommand,
              .cob_id_object = object::rpdo_cob_id(1),
              .type_object = object::rpdo_type(1),
              .count_object = object::rpdo_count(1),
              .cob_id = channels.command_id,
              .mapped = {controlword, target},
              .count = static_cast<std::uint8_t>(shared ? 1 : 2),
              .deadline_ms = deadline_ms};
  PdoSteps(steps, command).add_all();
  if (shared) {
    const bool first = drive == first_of_pair(drive);
    const Pdo targets{.names = first ? &kFirstTargetNames : &kSecondTargetNames,
                      .cob_id_object = object::rpdo_cob_id(2),
                      .type_object = object::rpdo_type(2),
                      .count_object = object::rpdo_count(2),
                      .cob_id = channels.targets_id,
                      .mapped = {first ? target : kDummy, first ? kDummy : target},
                      .deadline_ms = deadline_ms};
    PdoSteps(steps, targets).add_all();
  }
  const Pdo feedback{.names = &kFeedbackNames,
                     .refused = &kFeedbackRefused,
                     .role = PdoRole::kFeedback,
                     .cob_id_object = object::tpdo_cob_id(1),
                     .type_object = object::tpdo_type(1),
                     .count_object = object::tpdo_count(1),
                     .cob_id = channels.feedback_id | cob_id::kPdoNoRemote,
                     .mapped = {object::mapped(object::kStatusword, 16), object::mapped(object::kPositionActual, 32)}};
  PdoSteps(steps, feedback).add_all();
  for (std::uint8_t number = 1; number <= cob_id::kPdos; ++number) {
    IVO_CONTRACT(steps.push_back({.name = kSilenceNames[number - 1U],
                                  .action = StepAction::kSilencePdo,
                                  .object = object::tpdo_cob_id(number),
                                  .bytes = 4,
                                  .may_refuse = true}));
  }
}

}  // namespace ivo::drivers
