// Values as CBOR (RFC 8949), lists of small numbers as typed arrays (RFC 8746), as rosbridge's clients read them.
#pragma once

#include "firmware/web/ros/value_writer.hpp"

namespace ivo::firmware::web {

/// Objects and lists are of indefinite length.
class CborWriter final : public ValueWriter {
 public:
  using ValueWriter::begin_list;
  using ValueWriter::begin_object;
  void begin_object() override { byte(0xBF); }
  void end_object() override { byte(0xFF); }
  void begin_list() override { byte(0x9F); }
  void end_list() override { byte(0xFF); }
  void key(std::string_view name) override { text(name); }
  void text(std::string_view value) override;
  void number(double value) override;
  void whole(std::int64_t value) override;
  void flag(bool value) override { byte(value ? 0xF5 : 0xF4); }
  void bytes(std::span<const std::int8_t> values) override;
  void floats(std::span<const float> values) override;

  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  void byte(unsigned value) { bytes_ += static_cast<char>(value); }
  void head(unsigned major, std::uint64_t argument);

  std::string bytes_;
};

}  // namespace ivo::firmware::web
