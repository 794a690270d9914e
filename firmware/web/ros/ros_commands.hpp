// What a ROS client's session may do: ask as a page does, under the same rules, and show what it sees.
#pragma once

#include <cstdint>

#include "firmware/web/layer.hpp"
#include "firmware/web/request.hpp"
#include "firmware/web/verdict.hpp"

namespace ivo::firmware::web {

class RosCommands {
 public:
  RosCommands() = default;
  RosCommands(const RosCommands&) = delete;
  RosCommands& operator=(const RosCommands&) = delete;
  virtual ~RosCommands() = default;

  /// Returns the number under which RosSession::answered will be told the verdict: later, never from within. Counts
  /// on from 1.
  virtual std::uint32_t ask(const Request& request) = 0;
  /// Replaces the layer of that name on every page.
  virtual void show(const Layer& layer) = 0;
  /// Its token is an operator's.
  [[nodiscard]] virtual bool may_operate() const = 0;
  /// Counts what the session itself has refused.
  virtual void refused(Verdict verdict) = 0;
};

}  // namespace ivo::firmware::web
