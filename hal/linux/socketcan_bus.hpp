// A CAN interface of the Linux kernel: a non-blocking CAN_RAW socket that hears plain 11-bit data frames and error
// frames.
#pragma once

#include <memory>
#include <string>

#include "config/base/result.hpp"
#include "config/base/time.hpp"
#include "hal/api/can_bus.hpp"
#include "hal/linux/file_descriptor.hpp"

namespace ivo::hal {

/// One system call for each receive() and each send(). Own frames are not heard; other sockets of the same host are.
/// The interface may go down and come up again under the same object (kDown, then kActive); removed, it stays kRemoved.
class SocketCanBus final : public CanBus {
 public:
  /// Opens interface `name`, which must exist, be a CAN interface and be up.
  [[nodiscard]] static Result<SocketCanBus> open(const std::string& name);

  /// A bus on any datagram socket that carries whole `can_frame`s: for tests where the kernel has no CAN.
  explicit SocketCanBus(FileDescriptor socket);

  SocketCanBus(SocketCanBus&&) noexcept;
  SocketCanBus& operator=(SocketCanBus&&) noexcept;
  ~SocketCanBus() override;

  std::size_t receive(std::span<ReceivedFrame> frames, Instant now) noexcept override;
  std::size_t send(std::span<const CanFrame> frames, Instant now) noexcept override;
  [[nodiscard]] BusState state() const noexcept override { return state_; }
  [[nodiscard]] BusCounters counters() const noexcept override { return counters_; }

  /// Waits until there is something to receive, a signal came or `limit` has passed; true in the first case. The only
  /// call here that waits: for lock-step time and simulated drives, never for the loop in real time.
  [[nodiscard]] bool wait_readable(Duration limit) const noexcept;

 private:
  struct Messages;

  void note_error(int error) noexcept;
  void note_interface_works() noexcept;

  FileDescriptor socket_;
  std::unique_ptr<Messages> messages_;
  BusState state_ = BusState::kActive;
  BusCounters counters_;
};

}  // namespace ivo::hal
