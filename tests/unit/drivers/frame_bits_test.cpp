#include "drivers/canopen/frame_bits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ivo::drivers {
namespace {

TEST(FrameBits, AreThoseOfTheStandardWithoutAndWithTheMostStuffing) {
  const std::array<int, 9> unstuffed{47, 55, 63, 71, 79, 87, 95, 103, 111};
  const std::array<int, 9> longest{55, 65, 75, 85, 95, 105, 115, 125, 135};
  for (int bytes = 0; bytes <= 8; ++bytes) {
    EXPECT_EQ(unstuffed_bits(bytes), unstuffed[static_cast<std::size_t>(bytes)]);
    EXPECT_EQ(longest_bits(bytes), longest[static_cast<std::size_t>(bytes)]);
  }
}

// The catalogue's check value of CRC-15/CAN.
TEST(FrameBits, CrcIsThatOfCan) {
  std::vector<bool> bits;
  for (const char c : std::string_view("123456789")) {
    for (int bit = 7; bit >= 0; --bit) {
      bits.push_back((c >> bit & 1) != 0);
    }
  }
  std::array<bool, 72> plain{};
  std::copy(bits.begin(), bits.end(), plain.begin());
  EXPECT_EQ(can_crc(plain), 0x059E);
}

// 19 bits of 0 and their CRC, 0 as well: a stuff bit after each fifth of 34.
TEST(FrameBits, OfZerosAreStuffedAtEveryFifth) {
  EXPECT_EQ(bits_on_wire({.id = 0, .size = 0, .data = {}}), 47 + 6);
  EXPECT_EQ(bits_on_wire({.id = 0, .size = 0, .data = {0xFF}}), 47 + 6) << "bytes beyond the size are not sent";
}

// The line of SYNC written out as text: the CRC by long division, the stuff bits one by one.
TEST(FrameBits, OfSyncAreThoseOfItsLineWrittenOut) {
  // Start, identifier, three dominant bits, length 0; divided by x^15+x^14+x^10+x^8+x^7+x^4+x^3+1.
  std::uint64_t remainder = std::uint64_t{0b0000'1000'0000'0000'000} << 15;
  for (int bit = 33; bit >= 15; --bit) {
    if ((remainder >> bit & 1) != 0) {
      remainder ^= std::uint64_t{0b1100'0101'1001'1001} << (bit - 15);
    }
  }
  std::string line = "0000100000000000000";
  for (int bit = 14; bit >= 0; --bit) {
    line += (remainder >> bit & 1) != 0 ? '1' : '0';
  }
  int stuffed = 0;
  for (std::size_t i = 4; i < line.size(); ++i) {
    const std::string five = line.substr(i - 4, 5);
    if (five == "00000" || five == "11111") {
      line.insert(i + 1, five[0] == '0' ? "1" : "0");
      ++stuffed;
    }
  }
  EXPECT_EQ(bits_on_wire({.id = 0x080, .size = 0, .data = {}}), 47 + stuffed);
}

TEST(FrameBits, OfRandomFramesLieBetweenTheirBoundsAndOnAverageWhereComputed) {
  constexpr unsigned kSeed = 20;
  std::mt19937 random(kSeed);
  const std::array<std::pair<std::uint8_t, double>, 6> averages{
      {{0, 48.9}, {1, 57.0}, {2, 65.2}, {4, 81.3}, {6, 97.8}, {8, 114.2}}};
  for (const auto& [bytes, average] : averages) {
    constexpr int kFrames = 20'000;
    double sum = 0;
    for (int i = 0; i < kFrames; ++i) {
      hal::CanFrame frame{.id = static_cast<std::uint16_t>(random() & 0x7FF), .size = bytes, .data = {}};
      for (std::uint8_t& byte : frame.data) {
        byte = static_cast<std::uint8_t>(random());
      }
      const int bits = bits_on_wire(frame);
      ASSERT_GE(bits, unstuffed_bits(bytes));
      ASSERT_LE(bits, longest_bits(bytes));
      sum += bits;
    }
    EXPECT_NEAR(sum / kFrames, average, 0.15) << int{bytes} << " bytes, seed " << kSeed;
  }
}

// 8 bytes of 3Ch: 1111 0000 over and over is as bad as data can be but for where it begins.
TEST(FrameBits, OfAnEvilFrameComeNearTheLongest) {
  hal::CanFrame frame{.id = 0x078, .size = 8, .data = {}};
  frame.data.fill(0x3C);
  EXPECT_GE(bits_on_wire(frame), longest_bits(8) - 8);
}

}  // namespace
}  // namespace ivo::drivers
