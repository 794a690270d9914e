#include "drivers/canopen/emcy_text.hpp"

#include <array>
#include <cstdio>

namespace ivo::drivers {
namespace {

struct Class {
  std::uint16_t code;
  std::uint16_t mask;
  std::string_view name;
};

// The first that fits counts, so the exact ones come first.
constexpr std::array kClasses{
    Class{0x0000, 0xFFFF, "errors gone"},
    Class{0x8110, 0xFFFF, "CAN overrun, frames lost"},
    Class{0x8120, 0xFFFF, "CAN error passive"},
    Class{0x8130, 0xFFFF, "heartbeat or node guarding lost"},
    Class{0x8140, 0xFFFF, "recovered from bus-off"},
    Class{0x8150, 0xFFFF, "CAN identifier collision"},
    Class{0x8210, 0xFFFF, "PDO not processed, wrong length"},
    Class{0x8220, 0xFFFF, "PDO too long"},
    Class{0x8230, 0xFFFF, "destination object not available"},
    Class{0x8240, 0xFFFF, "unexpected SYNC length"},
    Class{0x8250, 0xFFFF, "RPDO timed out"},
    Class{0x8400, 0xFF00, "velocity control"},
    Class{0x8500, 0xFF00, "position control"},
    Class{0x8611, 0xFFFF, "following error"},
    Class{0x8600, 0xFF00, "positioning"},
    Class{0x8100, 0xFF00, "communication"},
    Class{0x8200, 0xFF00, "protocol"},
    Class{0x8000, 0xF000, "monitoring"},
    Class{0x1000, 0xF000, "generic"},
    Class{0x2100, 0xFF00, "current, input side"},
    Class{0x2200, 0xFF00, "current, inside the device"},
    Class{0x2310, 0xFFFF, "continuous over-current, output side"},
    Class{0x2320, 0xFFFF, "short circuit or earth leakage, output side"},
    Class{0x2300, 0xFF00, "current, output side"},
    Class{0x2000, 0xF000, "current"},
    Class{0x3100, 0xFF00, "mains voltage"},
    Class{0x3210, 0xFFFF, "DC link over-voltage"},
    Class{0x3220, 0xFFFF, "DC link under-voltage"},
    Class{0x3200, 0xFF00, "voltage inside the device, DC link"},
    Class{0x3300, 0xFF00, "output voltage"},
    Class{0x3000, 0xF000, "voltage"},
    Class{0x4100, 0xFF00, "ambient temperature"},
    Class{0x4310, 0xFFFF, "drive too hot"},
    Class{0x4000, 0xF000, "temperature"},
    Class{0x5000, 0xF000, "device hardware"},
    Class{0x6000, 0xF000, "device software"},
    Class{0x7121, 0xFFFF, "motor blocked"},
    Class{0x7100, 0xFF00, "power module"},
    Class{0x7300, 0xFF00, "sensor"},
    Class{0x7000, 0xF000, "additional modules"},
    Class{0x9000, 0xF000, "external"},
    Class{0xF000, 0xFF00, "additional functions"},
    Class{0xFF00, 0xFF00, "device specific"},
};

constexpr std::array<std::string_view, 8> kRegisterBits{"generic",       "current",        "voltage",  "temperature",
                                                        "communication", "device profile", "reserved", "manufacturer"};

std::string hexadecimal(unsigned value, int digits) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%0*X", digits, value);
  return text.data();
}

}  // namespace

std::string_view emergency_class(std::uint16_t code) noexcept {
  for (const Class& known : kClasses) {
    if ((code & known.mask) == known.code) {
      return known.name;
    }
  }
  return "unknown error";
}

std::string describe(const EmcyEntry& entry) {
  const Emergency& emergency = entry.emergency;
  std::string text = "emergency " + hexadecimal(emergency.code, 4) + "h, " +
                     std::string(emergency_class(emergency.code)) + " (error register " +
                     hexadecimal(emergency.error_register, 2) + "h";
  const char* before = ": ";
  for (std::size_t bit = 0; bit < kRegisterBits.size(); ++bit) {
    if ((emergency.error_register >> bit & 1) != 0) {
      text += before + std::string(kRegisterBits[bit]);
      before = ", ";
    }
  }
  text += "; vendor";
  for (const std::uint8_t byte : emergency.vendor) {
    text += " " + hexadecimal(byte, 2);
  }
  text += ")";
  return entry.count > 1 ? text + ", " + std::to_string(entry.count) + " times" : text;
}

}  // namespace ivo::drivers
