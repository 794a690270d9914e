// How many connections there may be: of all, and of one address, so that one machine cannot lock out the others.
#pragma once

#include <map>
#include <string>

namespace ivo::firmware::web {

class ConnectionLimits {
 public:
  static constexpr int kMost = 64;
  static constexpr int kMostOfOne = 16;  ///< a browser opens six, and a WebSocket

  [[nodiscard]] bool allows(const std::string& address) const {
    const auto found = of_.find(address);
    return all_ < kMost && (found == of_.end() || found->second < kMostOfOne);
  }
  void opened(const std::string& address) {
    ++all_;
    ++of_[address];
  }
  /// Of one that was opened.
  void closed(const std::string& address) {
    --all_;
    if (--of_[address] == 0) {
      of_.erase(address);
    }
  }

 private:
  int all_ = 0;
  std::map<std::string, int> of_;
};

}  // namespace ivo::firmware::web
