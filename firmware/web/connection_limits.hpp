// How many connections there may be: of all, and of one address, so that one machine cannot lock out the others, and
// all others together not the robot's own screen.
#pragma once

#include <map>
#include <string>

#include "firmware/web/client_address.hpp"

namespace ivo::firmware::web {

class ConnectionLimits {
 public:
  static constexpr int kMost = 64;
  static constexpr int kMostOfOne = 32;  ///< a browser opens six, and a WebSocket; a few of them may share an address
  static constexpr int kOfThisMachine = 8;  ///< of kMost, kept for it

  [[nodiscard]] bool allows(const ClientAddress& address) const {
    const auto found = of_.find(address.group);
    const bool room = all_ < kMost && (address.this_machine || others_ < kMost - kOfThisMachine);
    return room && (found == of_.end() || found->second < kMostOfOne);
  }
  void opened(const ClientAddress& address) {
    ++all_;
    others_ += address.this_machine ? 0 : 1;
    ++of_[address.group];
  }
  /// Of one that was opened.
  void closed(const ClientAddress& address) {
    --all_;
    others_ -= address.this_machine ? 0 : 1;
    if (--of_[address.group] == 0) {
      of_.erase(address.group);
    }
  }

 private:
  int all_ = 0;
  int others_ = 0;  // not of this machine
  std::map<std::string, int> of_;
};

}  // namespace ivo::firmware::web
