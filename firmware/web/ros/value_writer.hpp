// A tree of values written as it is made, without being held as a tree: a grid of a million cells is as large as its
// text.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace ivo::firmware::web {

class ValueWriter {
 public:
  ValueWriter() = default;
  ValueWriter(const ValueWriter&) = delete;
  ValueWriter& operator=(const ValueWriter&) = delete;
  virtual ~ValueWriter() = default;

  virtual void begin_object() = 0;
  virtual void end_object() = 0;
  virtual void begin_list() = 0;
  virtual void end_list() = 0;
  virtual void key(std::string_view name) = 0;  ///< of the value that comes next, in an object
  virtual void text(std::string_view value) = 0;
  virtual void number(double value) = 0;
  virtual void whole(std::int64_t value) = 0;
  virtual void flag(bool value) = 0;
  virtual void bytes(std::span<const std::int8_t> values) = 0;  ///< a list of numbers
  virtual void floats(std::span<const float> values) = 0;       ///< a list of numbers

  // A member of an object.
  ValueWriter& add(std::string_view name, std::string_view value) { return key(name), text(value), *this; }
  ValueWriter& add(std::string_view name, const char* value) { return add(name, std::string_view(value)); }
  ValueWriter& add(std::string_view name, double value) { return key(name), number(value), *this; }
  ValueWriter& add(std::string_view name, std::int64_t value) { return key(name), whole(value), *this; }
  ValueWriter& add(std::string_view name, int value) { return add(name, std::int64_t{value}); }
  ValueWriter& add(std::string_view name, bool value) { return key(name), flag(value), *this; }
  ValueWriter& begin_object(std::string_view name) { return key(name), begin_object(), *this; }
  ValueWriter& begin_list(std::string_view name) { return key(name), begin_list(), *this; }
};

}  // namespace ivo::firmware::web
