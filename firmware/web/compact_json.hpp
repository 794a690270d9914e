// Writes compact JSON, member by member: twenty times a second to every screen, so without a tree in between.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ivo::firmware::web {

class CompactJson {
 public:
  CompactJson& open(char bracket);            ///< { or [
  CompactJson& close(char bracket);           ///< } or ]
  CompactJson& key(std::string_view name);    ///< then its value
  CompactJson& text(std::string_view value);  ///< what is not UTF-8 becomes a question mark
  CompactJson& flag(bool value);
  CompactJson& count(std::uint64_t value);
  CompactJson& number(double value);  ///< reads back as the same; null when it is none
  CompactJson& null();
  CompactJson& raw(std::string_view json);  ///< is JSON already

  [[nodiscard]] const std::string& written() const noexcept { return written_; }

 private:
  void separate();

  std::string written_;
  bool first_ = true;
};

}  // namespace ivo::firmware::web
