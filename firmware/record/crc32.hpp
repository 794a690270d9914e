// CRC-32 as zip, PNG and Ethernet have it: reflected polynomial EDB88320h, all ones before and after.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace ivo::firmware {

namespace crc32_detail {

constexpr std::array<std::uint32_t, 256> make_table() noexcept {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) {
      rest = (rest >> 1U) ^ ((rest & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    table[byte] = rest;
  }
  return table;
}

inline constexpr std::array<std::uint32_t, 256> kTable = make_table();

}  // namespace crc32_detail

/// Of `bytes`; with the answer of what came before as `before`, of both together.
[[nodiscard]] constexpr std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0) noexcept {
  std::uint32_t rest = ~before;
  for (const char c : bytes) {
    rest = (rest >> 8U) ^ crc32_detail::kTable[(rest ^ static_cast<unsigned char>(c)) & 0xFFU];
  }
  return ~rest;
}

static_assert(crc32("123456789") == 0xCBF43926U, "the check value of the catalogue of CRCs");

}  // namespace ivo::firmware
