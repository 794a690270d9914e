// One WebSocket message.
#pragma once

#include <string>

namespace ivo::firmware::web {

struct Frame {
  std::string bytes;
  bool binary = false;
};

}  // namespace ivo::firmware::web
