// Values as JSON text.
#pragma once

#include "firmware/web/ros/value_writer.hpp"

namespace ivo::firmware::web {

/// Numbers read back as the same; one that is none is null, as JSON knows none.
class JsonWriter final : public ValueWriter {
 public:
  using ValueWriter::begin_list;
  using ValueWriter::begin_object;
  void begin_object() override { open('{'); }
  void end_object() override { close('}'); }
  void begin_list() override { open('['); }
  void end_list() override { close(']'); }
  void key(std::string_view name) override;
  void text(std::string_view value) override;
  void number(double value) override;
  void whole(std::int64_t value) override;
  void flag(bool value) override;
  void bytes(std::span<const std::int8_t> values) override;
  void floats(std::span<const float> values) override;

  /// `json`: a value as it is.
  void raw(std::string_view json);
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void open(char bracket);
  void close(char bracket);

  std::string text_;
  bool behind_value_ = false;  // what comes next is set off by a comma
};

}  // namespace ivo::firmware::web
