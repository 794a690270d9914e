// Owner of one file descriptor, closed once.
#pragma once

#include <utility>

namespace ivo::hal {

class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int fd) noexcept : fd_(fd) {}
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~FileDescriptor() { close(); }

  /// Before the end of its life; again does nothing. By the operating system's side: hal/linux.
  void close() noexcept;
  [[nodiscard]] int get() const noexcept { return fd_; }
  /// The descriptor, which the caller owns from now on.
  [[nodiscard]] int release() noexcept { return std::exchange(fd_, -1); }
  [[nodiscard]] bool valid() const noexcept { return fd_ >= 0; }

 private:
  int fd_ = -1;
};

}  // namespace ivo::hal
