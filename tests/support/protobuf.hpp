// A protobuf message read field by field, without a schema.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ivo {

struct ProtoMessage {
  struct Field {
    std::uint64_t number = 0;
    std::uint64_t value = 0;  // of a varint
    std::string bytes;        // of what has a length
  };
  std::vector<Field> fields;

  explicit ProtoMessage(std::string_view text) {
    while (!text.empty()) {
      const std::uint64_t key = varint(text);
      Field field{key >> 3U, 0, {}};
      if ((key & 7U) == 0) {
        field.value = varint(text);
      } else if ((key & 7U) == 2) {
        const std::uint64_t size = varint(text);
        if (size > text.size()) {
          throw std::runtime_error("a field ends behind its message");
        }
        field.bytes = text.substr(0, size);
        text.remove_prefix(size);
      } else {
        throw std::runtime_error("a wire type that is not ours");
      }
      fields.push_back(field);
    }
  }

  [[nodiscard]] bool has(std::uint64_t number) const { return !all(number).empty(); }
  [[nodiscard]] std::uint64_t number(std::uint64_t field) const { return all(field).at(0).value; }
  [[nodiscard]] std::string text(std::uint64_t field) const { return all(field).at(0).bytes; }
  [[nodiscard]] ProtoMessage message(std::uint64_t field) const { return ProtoMessage(text(field)); }
  [[nodiscard]] std::vector<Field> all(std::uint64_t number) const {
    std::vector<Field> found;
    for (const Field& field : fields) {
      if (field.number == number) {
        found.push_back(field);
      }
    }
    return found;
  }

 private:
  static std::uint64_t varint(std::string_view& text) {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      if (text.empty()) {
        throw std::runtime_error("a number ends behind its message");
      }
      const auto byte = static_cast<unsigned char>(text.front());
      text.remove_prefix(1);
      value |= std::uint64_t{byte & 0x7FU} << shift;
      if (byte < 0x80) {
        return value;
      }
    }
    throw std::runtime_error("a number without end");
  }
};

}  // namespace ivo
