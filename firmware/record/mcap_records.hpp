// How records of an MCAP file (mcap.dev/spec) are put together.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace ivo::firmware::mcap {

enum class Op : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F
};

/// Little-endian, as all numbers of the format.
template <std::unsigned_integral Number>
void put(std::string& out, Number value) {
  for (std::size_t byte = 0; byte < sizeof value; ++byte) {
    out += static_cast<char>(value >> (8 * byte) & 0xFFU);
  }
}
/// With its length before it, as all texts, arrays and maps.
inline void put(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}
[[nodiscard]] inline std::string record(Op op, std::string_view content) {
  std::string out(1, static_cast<char>(op));
  put(out, std::uint64_t{content.size()});
  out += content;
  return out;
}

}  // namespace ivo::firmware::mcap
