// Where each key of a file stands, so that a complaint that comes later still names its line.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "config/base/result.hpp"

namespace ivo::firmware {

class Lines {
 public:
  Lines() = default;
  /// `lines` by key path, as "planner.cell_m" and "agent[1].start_m".
  Lines(std::string path, std::map<std::string, int, std::less<>> lines);

  /// "PATH:LINE: KEY: WHAT". A key that the file does not have gets the line of the table it would stand in.
  [[nodiscard]] Error at(std::string_view key_path, std::string_view what) const;

  /// The line that at() names; 1 for what belongs to the whole file.
  [[nodiscard]] int line_of(std::string_view key_path) const;

 private:
  std::string path_;
  std::map<std::string, int, std::less<>> lines_;
};

}  // namespace ivo::firmware
