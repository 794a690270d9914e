#include "drivers/canopen/frame_bits.hpp"

#include "config/base/contract.hpp"
#include "config/base/static_vector.hpp"

namespace ivo::drivers {
namespace {

constexpr std::size_t kMostStuffable = 34 + 64;
constexpr int kAlikeBeforeStuffing = 5;
constexpr int kCrcBits = 15;

using Bits = StaticVector<bool, kMostStuffable>;

void put(Bits& bits, unsigned value, int count) noexcept {
  for (int bit = count - 1; bit >= 0; --bit) {
    IVO_CONTRACT(bits.push_back((value >> bit & 1U) != 0));
  }
}

int stuff_bits(std::span<const bool> bits) noexcept {
  int stuffed = 0;
  int alike = 0;
  bool last = true;  // the bus was idle, recessive
  for (const bool bit : bits) {
    alike = bit == last ? alike + 1 : 1;
    last = bit;
    if (alike == kAlikeBeforeStuffing) {
      ++stuffed;
      last = !bit;
      alike = 1;
    }
  }
  return stuffed;
}

}  // namespace

std::uint16_t can_crc(std::span<const bool> bits) noexcept {
  unsigned crc = 0;
  for (const bool bit : bits) {
    const bool divide = bit != ((crc >> (kCrcBits - 1) & 1U) != 0);
    crc = crc << 1 & 0x7FFF;
    crc ^= divide ? 0x4599U : 0U;
  }
  return static_cast<std::uint16_t>(crc);
}

int bits_on_wire(const hal::CanFrame& frame) noexcept {
  Bits bits;
  put(bits, 0, 1);  // start of frame
  put(bits, frame.id, 11);
  put(bits, 0, 3);  // a data frame, base format, reserved bit
  put(bits, frame.size, 4);
  for (std::size_t i = 0; i < frame.size; ++i) {
    put(bits, frame.data[i], 8);
  }
  put(bits, can_crc({&bits[0], bits.size()}), kCrcBits);
  return unstuffed_bits(frame.size) + stuff_bits({&bits[0], bits.size()});
}

}  // namespace ivo::drivers
