// The objects of the drive profile (CiA 402-2) that the product reads or writes.
#pragma once

#include "drivers/canopen/object_address.hpp"

namespace ivo::drivers::object {

inline constexpr ObjectAddress kAbortConnectionOption{0x6007, 0};
inline constexpr ObjectAddress kErrorCode{0x603F, 0};
inline constexpr ObjectAddress kControlword{0x6040, 0};
inline constexpr ObjectAddress kStatusword{0x6041, 0};
inline constexpr ObjectAddress kQuickStopOption{0x605A, 0};
inline constexpr ObjectAddress kShutdownOption{0x605B, 0};
inline constexpr ObjectAddress kDisableOperationOption{0x605C, 0};
inline constexpr ObjectAddress kHaltOption{0x605D, 0};
inline constexpr ObjectAddress kFaultReactionOption{0x605E, 0};
inline constexpr ObjectAddress kModeOfOperation{0x6060, 0};
inline constexpr ObjectAddress kModeDisplay{0x6061, 0};
inline constexpr ObjectAddress kPositionActual{0x6064, 0};
inline constexpr ObjectAddress kVelocityActual{0x606C, 0};
inline constexpr ObjectAddress kProfileAcceleration{0x6083, 0};
inline constexpr ObjectAddress kProfileDeceleration{0x6084, 0};
inline constexpr ObjectAddress kQuickStopDeceleration{0x6085, 0};
inline constexpr ObjectAddress kInterpolationPeriod{0x60C2, 1};  // of 10^kInterpolationExponent seconds
inline constexpr ObjectAddress kInterpolationExponent{0x60C2, 2};
inline constexpr ObjectAddress kTargetVelocity{0x60FF, 0};
inline constexpr ObjectAddress kSupportedModes{0x6502, 0};

}  // namespace ivo::drivers::object

namespace ivo::drivers::cia402 {

inline constexpr std::uint16_t kProfileNumber = 0x0192;      // low word of 1000h: 402
inline constexpr std::uint8_t kQuickStopRampThenOff = 2;     // 605Ah: quick-stop ramp, then Switch On Disabled
inline constexpr std::uint8_t kFirstQuickStopThatStays = 5;  // 605Ah: from here on Quick Stop Active is kept
inline constexpr std::uint8_t kRampThenOff = 1;              // 605Bh, 605Ch: slow-down ramp 6084h
inline constexpr std::uint8_t kHaltRamp = 1;                 // 605Dh: ditto
inline constexpr std::uint8_t kQuickStopRampOnFault = 2;     // 605Eh: ramp 6085h
inline constexpr std::uint8_t kQuickStopOnLostMaster = 3;    // 6007h

// Sets of values, bit n for value n.
inline constexpr std::uint32_t kQuickStopsWithRamp = 1U << 1 | 1U << 2 | 1U << 5 | 1U << 6;  // 605Ah
inline constexpr std::uint32_t kShutdowns = 1U << 0 | 1U << 1;                               // 605Bh, 605Ch: off, ramp
inline constexpr std::uint32_t kHalts = 1U << 1 | 1U << 2 | 1U << 3 | 1U << 4;               // 605Dh: ramps, limits
inline constexpr std::uint32_t kFaultReactions = kHalts | 1U << 0;  // 605Eh: ditto, or off at once
inline constexpr std::uint32_t kStopsOnLostMaster =
    1U << 1 | 1U << 2 | 1U << 3;  // 6007h: fault, voltage off, quick stop

}  // namespace ivo::drivers::cia402
