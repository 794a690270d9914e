// Plain values as bytes and back: little-endian, no padding, the same on every processor.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace ivo::firmware {

class ByteWriter {
 public:
  void u8(std::uint8_t value) { bytes_ += static_cast<char>(value); }
  void u32(std::uint32_t value) { whole(value, 4); }
  void u64(std::uint64_t value) { whole(value, 8); }
  void i64(std::int64_t value) { u64(static_cast<std::uint64_t>(value)); }
  void real(double value) { u64(std::bit_cast<std::uint64_t>(value)); }
  void flag(bool value) { u8(value ? 1 : 0); }
  void text(std::string_view value) {
    u32(static_cast<std::uint32_t>(value.size()));
    bytes_ += value;
  }
  [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }

 private:
  void whole(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) {
      u8(static_cast<std::uint8_t>(value >> (8 * i)));
    }
  }
  std::string bytes_;
};

/// After the first value that is not there the answers are 0 and ok() is false.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) noexcept : bytes_(bytes) {}

  [[nodiscard]] std::uint8_t u8() noexcept { return static_cast<std::uint8_t>(whole(1)); }
  [[nodiscard]] std::uint32_t u32() noexcept { return static_cast<std::uint32_t>(whole(4)); }
  [[nodiscard]] std::uint64_t u64() noexcept { return whole(8); }
  [[nodiscard]] std::int64_t i64() noexcept { return static_cast<std::int64_t>(u64()); }
  [[nodiscard]] double real() noexcept { return std::bit_cast<double>(u64()); }
  [[nodiscard]] bool flag() noexcept { return u8() != 0; }
  [[nodiscard]] std::string text() {
    const std::uint32_t size = u32();
    return std::string(take(size));
  }
  [[nodiscard]] bool ok() const noexcept { return ok_; }
  [[nodiscard]] bool at_end() const noexcept { return bytes_.empty(); }

 private:
  [[nodiscard]] std::string_view take(std::size_t size) noexcept {
    ok_ = ok_ && size <= bytes_.size();
    if (!ok_) {
      return {};
    }
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  [[nodiscard]] std::uint64_t whole(std::size_t size) noexcept {
    std::uint64_t value = 0;
    int place = 0;
    for (const char c : take(size)) {
      value |= std::uint64_t{static_cast<unsigned char>(c)} << (8 * place++);
    }
    return value;
  }
  std::string_view bytes_;
  bool ok_ = true;
};

}  // namespace ivo::firmware
