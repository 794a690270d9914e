#include "firmware/tools/wheels/frame_bits.hpp"

namespace ivo::firmware {
namespace {

constexpr int kUnstuffed = 13;  // CRC and ACK delimiters, ACK, end of frame, intermission: 1 + 1 + 1 + 7 + 3

/// The bits from start of frame to the CRC, as they go out.
class StuffedBits {
 public:
  void put(std::uint32_t value, int bits) noexcept {
    for (int i = bits - 1; i >= 0; --i) {
      put_bit((value >> i & 1) != 0, true);
    }
  }
  void put_crc() noexcept {
    const std::uint32_t crc = crc_;
    for (int i = 14; i >= 0; --i) {
      put_bit((crc >> i & 1) != 0, false);
    }
  }
  [[nodiscard]] int sent() const noexcept { return sent_; }

 private:
  void put_bit(bool bit, bool counts_for_crc) noexcept {
    if (counts_for_crc) {
      constexpr std::uint32_t kPolynomial = 0x4599;
      const bool next = ((crc_ >> 14 & 1) != 0) != bit;
      crc_ = crc_ << 1 & 0x7FFF;
      crc_ = next ? crc_ ^ kPolynomial : crc_;
    }
    run_ = sent_ > 0 && bit == last_ ? run_ + 1 : 1;
    last_ = bit;
    ++sent_;
    if (run_ == 5) {  // a bit of the other kind follows, and counts for the next run
      ++sent_;
      last_ = !bit;
      run_ = 1;
    }
  }

  std::uint32_t crc_ = 0;
  bool last_ = true;
  int run_ = 0;
  int sent_ = 0;
};

}  // namespace

int frame_bits(const hal::CanFrame& frame) noexcept {
  StuffedBits bits;
  bits.put(0, 1);  // start of frame
  bits.put(frame.id, 11);
  bits.put(0, 3);  // a data frame, base format, reserved bit
  bits.put(frame.size, 4);
  for (std::size_t i = 0; i < frame.size; ++i) {
    bits.put(frame.data[i], 8);
  }
  bits.put_crc();
  return bits.sent() + kUnstuffed;
}

}  // namespace ivo::firmware
