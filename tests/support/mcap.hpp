// The records of an MCAP file, read one after the other, and the numbers in them.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ivo {

/// Takes little-endian numbers and texts off the front of bytes.
class McapBytes {
 public:
  explicit McapBytes(std::string_view bytes) : bytes_(bytes) {}
  [[nodiscard]] std::uint64_t number(std::size_t size) {
    std::uint64_t value = 0;
    const std::string_view part = take(size);
    for (std::size_t i = 0; i < size; ++i) {
      value |= std::uint64_t{static_cast<unsigned char>(part[i])} << (8 * i);
    }
    return value;
  }
  [[nodiscard]] std::string text() { return std::string(take(number(4))); }
  [[nodiscard]] std::string rest() { return std::string(take(bytes_.size())); }
  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) {
      throw std::runtime_error("a record ends behind the file");
    }
    const std::string_view part = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return part;
  }

 private:
  std::string_view bytes_;
};

struct McapRecord {
  std::uint8_t op = 0;
  std::uint64_t at = 0;  // where it begins in the file
  std::string content;
};

inline constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";

/// `whole`: the magic at the end is there too.
inline std::vector<McapRecord> mcap_records(const std::string& file, bool whole) {
  McapBytes bytes(file);
  if (bytes.take(kMcapMagic.size()) != kMcapMagic) {
    throw std::runtime_error("no magic");
  }
  std::vector<McapRecord> records;
  std::size_t at = kMcapMagic.size();
  const std::size_t end = file.size() - (whole ? kMcapMagic.size() : 0);
  while (at < end) {
    McapRecord record;
    record.at = at;
    record.op = static_cast<std::uint8_t>(bytes.number(1));
    const std::uint64_t size = bytes.number(8);
    record.content = bytes.take(size);
    at += 9 + size;
    records.push_back(record);
  }
  if (whole && bytes.rest() != kMcapMagic) {
    throw std::runtime_error("no magic at the end");
  }
  return records;
}

}  // namespace ivo
