// A CAN interface of the Linux kernel.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "config/base/realtime.hpp"
#include "config/base/result.hpp"
#include "config/base/time.hpp"
#include "hal/api/can_bus.hpp"
#include "hal/api/file_descriptor.hpp"
#include "hal/api/transmit_table.hpp"
#include "hal/linux/error_frame.hpp"
#include "hal/linux/interface_facts.hpp"

namespace ivo::hal {

/// One system call for each receive() and at most one for each send(); none else. Other sockets of this host are heard
/// as any node is, with their origin.
///
/// A frame counts as confirmed when the interface shows it to us again, which a driver does once it has left. Until
/// then a newer frame of its COB-ID waits here (transmit_table.hpp), so send() is to be called each cycle, with nothing
/// to say too.
///
/// Bus-off, down or removed: what waits is forgotten, and nothing is sent but the attempts that find the interface up
/// again. It comes back without restart: from bus-off by the driver's own (restart-ms); from down with the first frame
/// that it takes, or with the next look; removed, and there again under its name, with the next look. Looks are made
/// outside of the loop: by an InterfaceWatch in real time, else by who calls look_at_interface().
class SocketCanBus final : public CanBus {
 public:
  struct Options {
    /// COB-IDs that are heard, at most 512; none: every one. Those that we send belong to them: without its own frames
    /// a bus takes them for confirmed once they are handed over, and does not hear who else sends them.
    std::span<const std::uint16_t> ids{};
    std::uint32_t bit_rate_bps = 0;  ///< that the interface must run at, if it has one; 0: any
    /// False: frames count as confirmed when handed over, and two of one COB-ID may queue, as answers of a simulated
    /// drive.
    bool confirm = true;
    /// Of the kernel's queue of arrivals, about 770 a frame and half of it overhead; 0: room for 300 ms.
    int receive_bytes = 0;
  };

  /// What is counted beside BusCounters.
  struct Details {
    ErrorCounters errors;
    std::uint64_t queue_full = 0;      ///< sends that the interface did not take whole
    std::uint64_t echo_lost = 0;       ///< frames whose leaving was not seen though later ones left
    std::uint64_t stamps_clamped = 0;  ///< arrivals that a set wall clock had moved (arrival_stamps.hpp)
    std::uint64_t malformed = 0;       ///< messages that are no CAN frame
    std::uint64_t reopened = 0;        ///< times that a removed interface was back
  };

  /// Opens interface `name`, which must exist, be a CAN interface, be up and, if it has a bit rate, run at
  /// `bit_rate_bps`.
  [[nodiscard]] static Result<SocketCanBus> open(const std::string& name, const Options& options);
  [[nodiscard]] static Result<SocketCanBus> open(const std::string& name) { return open(name, Options{}); }

  /// A bus on any datagram socket that carries whole `can_frame`s: for tests where the kernel has no CAN. It has no
  /// echo: what is handed over counts as confirmed.
  explicit SocketCanBus(FileDescriptor socket);

  SocketCanBus(SocketCanBus&&) noexcept;
  SocketCanBus& operator=(SocketCanBus&&) noexcept;
  ~SocketCanBus() override;

  std::size_t receive(std::span<ReceivedFrame> frames, Instant now) noexcept IVO_REALTIME override;
  std::size_t send(std::span<const CanFrame> frames, Instant now) noexcept IVO_REALTIME override;
  [[nodiscard]] std::span<const CanFrame> handed_over() const noexcept override;
  [[nodiscard]] BusState state() const noexcept override;
  [[nodiscard]] BusCounters counters() const noexcept override;
  [[nodiscard]] Details details() const noexcept;
  /// The last send() handed over a frame with this COB-ID, given then or left over.
  [[nodiscard]] bool just_sent(std::uint16_t id) const noexcept;
  /// Frames handed over and not yet seen to leave.
  [[nodiscard]] std::size_t in_flight() const noexcept;
  /// What the kernel said of the interface when it was opened; default-made without interface.
  [[nodiscard]] const InterfaceFacts& facts() const noexcept;

  /// Sees whether the interface is up, removed or back; the next receive() acts on it. System calls and heap: outside
  /// of the loop, in one thread. Nothing on a datagram socket.
  void look_at_interface();

  enum class Woken : std::uint8_t { kByFrame, kBySignal, kByTime };
  /// Waits until there is something to receive, a signal came or `limit` has passed. The only call here that waits: for
  /// lock-step time and simulated drives, never for the loop in real time.
  [[nodiscard]] Woken wait(Duration limit) const noexcept;
  [[nodiscard]] bool wait_readable(Duration limit) const noexcept { return wait(limit) == Woken::kByFrame; }

 private:
  struct State;
  explicit SocketCanBus(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace ivo::hal
