// Keeps an eye on the interface of a bus from a thread of its own.
#pragma once

#include <thread>

#include "config/base/result.hpp"
#include "hal/api/file_descriptor.hpp"
#include "hal/linux/socketcan_bus.hpp"

namespace ivo::hal {

/// Looks (SocketCanBus::look_at_interface) when the kernel tells of a change of any link, and five times a second, for
/// changes of a controller's state are not told. Needs no privileges. The thread takes no signals and keeps the
/// scheduling of an ordinary one, whatever its creator's.
class InterfaceWatch {
 public:
  /// `bus` outlives this, stays where it is, and is looked at by nobody else.
  explicit InterfaceWatch(SocketCanBus& bus);
  InterfaceWatch(const InterfaceWatch&) = delete;
  InterfaceWatch& operator=(const InterfaceWatch&) = delete;
  /// Ends the thread; at most as long as one look takes.
  ~InterfaceWatch();

 private:
  void run();

  SocketCanBus& bus_;
  FileDescriptor changes_;  // an rtnetlink socket in the group of links; without it there is the looking alone
  FileDescriptor end_;
  std::thread thread_;
};

}  // namespace ivo::hal
