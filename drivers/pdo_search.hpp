// A drive that will not be mapped as we wish: is one of its PDOs right as it is? The default set of CiA 402 has
// RPDO4 {6040h, 60FFh} and TPDO3 {6041h, 6064h}.
#pragma once

#include <array>
#include <cstdint>

#include "drivers/startup_steps.hpp"

namespace ivo::drivers {

/// Looks at the four RPDOs or TPDOs in turn: the two objects mapped first must be those that are wanted. Count,
/// transmission type 1 and the COB-ID of the predefined connection set are written where they are otherwise, and read
/// back. Nothing is written to a PDO that is right already. One SDO transfer a step.
class PdoSearch {
 public:
  enum class State : std::uint8_t { kSearching, kFound, kNone };

  /// Begins anew, with PDO 1; `role` is kCommand or kFeedback.
  void open(PdoRole role, std::uint8_t node_id) noexcept;

  [[nodiscard]] State state() const noexcept { return state_; }
  /// What to transfer now, while kSearching: kWrite, or kKeep to read a value.
  [[nodiscard]] StartupStep step() const noexcept;
  /// It was transferred; of a read, what was read.
  void on_done(std::uint32_t value) noexcept;
  /// The drive aborted it.
  void on_refused() noexcept;

  /// Of kFound.
  [[nodiscard]] std::uint8_t number() const noexcept { return number_; }
  [[nodiscard]] std::uint16_t cob_id() const noexcept { return static_cast<std::uint16_t>(cob_id_ & 0x7FF); }

 private:
  enum class Stage : std::uint8_t {
    kReadFirst,
    kReadSecond,
    kReadCount,
    kReadType,
    kReadCobId,
    kInvalidate,
    kWriteCount,
    kWriteType,
    kValidate,
    kCheckCount,
    kCheckType,
    kCheckCobId,
  };

  void next_stage() noexcept;
  void next_candidate() noexcept;
  void begin() noexcept;
  [[nodiscard]] bool reads() const noexcept { return stage_ <= Stage::kReadCobId || stage_ >= Stage::kCheckCount; }
  [[nodiscard]] bool needed() const noexcept;

  PdoRole role_ = PdoRole::kNone;
  std::uint8_t node_id_ = 0;
  State state_ = State::kNone;
  Stage stage_ = Stage::kReadFirst;
  std::uint8_t number_ = 1;
  std::uint32_t cob_id_ = 0;  // that candidate `number_` is to have
  // As it was found.
  std::uint32_t count_ = 0;
  std::uint32_t type_ = 0;
  std::uint32_t cob_id_found_ = 0;
};

}  // namespace ivo::drivers
