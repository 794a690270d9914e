// A local socket by its path: to listen there, or to connect to who does. Start-up only.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "config/base/result.hpp"
#include "hal/api/file_descriptor.hpp"

namespace ivo::firmware::console {

/// Listens while it is there, and takes its path away with it.
class Listener {
 public:
  /// Listens at `path`, for owner and group alone (mode 0660). The socket of a process that died is replaced; one that
  /// is listened at, and any other file, is refused by name. The descriptor does not block.
  [[nodiscard]] static Result<Listener> at(const std::string& path);
  Listener(Listener&& other) noexcept = default;
  Listener& operator=(Listener&&) = delete;
  ~Listener() { close(); }

  /// Again: nothing. The path goes when it is still ours.
  void close();
  [[nodiscard]] int get() const noexcept { return socket_.get(); }

 private:
  Listener(std::string path, hal::FileDescriptor socket);

  std::string path_;
  std::uint64_t inode_ = 0;
  hal::FileDescriptor socket_;
};

/// A connection to who listens at `path`, which blocks. Fails with who is not there, or may not be asked.
[[nodiscard]] Result<hal::FileDescriptor> connect_to(const std::string& path);
/// The same without ever waiting, neither now nor later.
[[nodiscard]] Result<hal::FileDescriptor> connect_at_once(const std::string& path);

}  // namespace ivo::firmware::console
