// Some lines that are drawn over themselves on a terminal.
#pragma once

#include <string>
#include <vector>

namespace ivo::firmware::wheels {

class LivePicture {
 public:
  /// Each line cut to the terminal's width.
  void draw(const std::vector<std::string>& lines);

 private:
  std::size_t drawn_ = 0;
};

}  // namespace ivo::firmware::wheels
