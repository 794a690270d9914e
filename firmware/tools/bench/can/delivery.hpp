// When all that was sent has arrived: the kernel may put off handing frames on to a thread of its own, and in lock step
// nobody waits for it.
#pragma once

#include <string>

#include "config/base/result.hpp"
#include "hal/api/file_descriptor.hpp"

namespace ivo::firmware::bench {

/// Two sockets on an interface that nothing breaks. The caller's thread must stay on one CPU (stay_on_one_cpu): frames
/// of all interfaces wait in one queue a CPU, first in, first out.
class Delivery {
 public:
  [[nodiscard]] static Result<Delivery> open(const std::string& interface);

  /// Sends a frame that nobody hears but this and waits for it: what was sent before it has arrived. Not what a
  /// queueing discipline holds back. Gives up after a second.
  void wait() const noexcept;

 private:
  Delivery(hal::FileDescriptor sender, hal::FileDescriptor hearer)
      : sender_(std::move(sender)), hearer_(std::move(hearer)) {}

  hal::FileDescriptor sender_;
  hal::FileDescriptor hearer_;
};

void stay_on_one_cpu() noexcept;

}  // namespace ivo::firmware::bench
