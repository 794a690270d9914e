#include "drivers/cia402/statusword.hpp"

#include <array>

#include "config/base/contract.hpp"

namespace ivo::drivers::cia402 {
namespace {

struct Pattern {
  std::uint16_t mask;
  std::uint16_t bits;
};

constexpr std::array<Pattern, 8> kPatterns{{
    {0x4F, 0x00},  // not ready to switch on
    {0x4F, 0x40},  // switch on disabled
    {0x6F, 0x21},  // ready to switch on
    {0x6F, 0x23},  // switched on
    {0x6F, 0x27},  // operation enabled
    {0x6F, 0x07},  // quick stop active
    {0x4F, 0x0F},  // fault reaction active
    {0x4F, 0x08},  // fault
}};

}  // namespace

PowerState power_state(std::uint16_t statusword) noexcept {
  for (std::size_t i = 0; i < kPatterns.size(); ++i) {
    if ((statusword & kPatterns[i].mask) == kPatterns[i].bits) {
      return static_cast<PowerState>(i);
    }
  }
  return PowerState::kUnknown;
}

std::uint16_t statusword_bits(PowerState state) noexcept {
  IVO_CONTRACT(state != PowerState::kUnknown);
  return kPatterns[static_cast<std::size_t>(state)].bits;
}

}  // namespace ivo::drivers::cia402
