#include "firmware/web/ros/cbor_writer.hpp"

#include <bit>
#include <cstddef>
#include <cstring>

namespace ivo::firmware::web {
namespace {

// Major types of RFC 8949, and tags of RFC 8746 for arrays of little-endian numbers.
constexpr unsigned kUnsigned = 0;
constexpr unsigned kNegative = 1;
constexpr unsigned kByteText = 2;
constexpr unsigned kUtf8Text = 3;
constexpr unsigned kTag = 6;
constexpr std::uint64_t kInt8Array = 72;
constexpr std::uint64_t kFloat32Array = 85;

static_assert(std::endian::native == std::endian::little);

}  // namespace

void CborWriter::head(unsigned major, std::uint64_t argument) {
  const int size = argument < 24 ? 0 : argument <= 0xFF ? 1 : argument <= 0xFFFF ? 2 : argument <= 0xFFFFFFFF ? 4 : 8;
  const unsigned form = size == 0 ? static_cast<unsigned>(argument)
                                  : 24U + static_cast<unsigned>(std::countr_zero(static_cast<unsigned>(size)));
  byte(major << 5U | form);
  for (int i = size - 1; i >= 0; --i) {
    byte(static_cast<unsigned>(argument >> (8 * i) & 0xFFU));
  }
}

void CborWriter::text(std::string_view value) {
  head(kUtf8Text, value.size());
  bytes_ += value;
}

void CborWriter::number(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  byte(0xFB);
  for (int i = 7; i >= 0; --i) {
    byte(static_cast<unsigned>(bits >> (8 * i) & 0xFFU));
  }
}

void CborWriter::whole(std::int64_t value) {
  head(value < 0 ? kNegative : kUnsigned, static_cast<std::uint64_t>(value < 0 ? -(value + 1) : value));
}

void CborWriter::bytes(std::span<const std::int8_t> values) {
  head(kTag, kInt8Array);
  head(kByteText, values.size());
  for (const std::int8_t value : values) {
    bytes_ += static_cast<char>(value);
  }
}

void CborWriter::floats(std::span<const float> values) {
  head(kTag, kFloat32Array);
  head(kByteText, values.size_bytes());
  const std::size_t at = bytes_.size();
  bytes_.resize(at + values.size_bytes());
  if (!values.empty()) {
    std::memcpy(bytes_.data() + at, values.data(), values.size_bytes());
  }
}

}  // namespace ivo::firmware::web
