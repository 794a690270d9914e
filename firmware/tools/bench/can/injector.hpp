// Another program's raw socket on the bus: sends what no part of the product would.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>

#include "config/base/result.hpp"
#include "hal/api/file_descriptor.hpp"

namespace ivo::firmware::bench {

/// Hears nothing. A frame that the kernel does not take is lost: who injects looks at what came of it.
class Injector {
 public:
  [[nodiscard]] static Result<Injector> open(const std::string& interface);

  /// `id` with the flags of linux/can.h: extended, remote and error frames as well.
  void send(std::uint32_t id, std::initializer_list<std::uint8_t> data) const noexcept;
  /// The same frame `count` times.
  void flood(int count, std::uint32_t id, std::initializer_list<std::uint8_t> data) const noexcept;
  /// A remote request for `size` bytes.
  void send_remote(std::uint16_t id, std::uint8_t size) const noexcept;
  /// A CAN FD frame.
  void send_fd(std::uint16_t id, std::initializer_list<std::uint8_t> data) const noexcept;

 private:
  explicit Injector(hal::FileDescriptor socket) : socket_(std::move(socket)) {}

  hal::FileDescriptor socket_;
};

}  // namespace ivo::firmware::bench
