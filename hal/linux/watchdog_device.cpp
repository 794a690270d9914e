#include "hal/linux/watchdog_device.hpp"

#include <fcntl.h>
#include <linux/watchdog.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace ivo::hal {
namespace {

constexpr char kFood = '\0';
constexpr char kMagicClose = 'V';  // the last byte before an orderly close

bool put(int device, char byte) noexcept { return write(device, &byte, 1) == 1; }

Error refuse(const std::string& path, const std::string& what) { return Error{"watchdog " + path + ": " + what}; }

std::string in_seconds(int seconds) { return std::to_string(seconds) + " s"; }

// The timeout that the device has now, in seconds.
Result<int> set_timeout(const std::string& path, int device, int wanted) {
  int timeout = wanted;
  if (ioctl(device, WDIOC_SETTIMEOUT, &timeout) == 0) {
    return timeout;  // rounded by the device
  }
  const int refusal = errno;
  if (refusal == ENOTTY || refusal == ENOSYS) {  // the second of a kernel, or an emulation of one, without watchdogs
    return refuse(path, "not a watchdog; expected a device as /dev/watchdog");
  }
  if (refusal == EINVAL) {
    return refuse(path, "cannot take a timeout of " + in_seconds(wanted) + "; its own manual says what it can");
  }
  // One timeout only: it will do if it is no longer than what was asked for.
  if (ioctl(device, WDIOC_GETTIMEOUT, &timeout) == 0 && timeout > 0 && timeout <= wanted) {
    return timeout;
  }
  return refuse(path, "cannot be set to " + in_seconds(wanted) + ": " + std::strerror(refusal));
}

}  // namespace

Result<WatchdogDevice> WatchdogDevice::open(const std::string& path, std::chrono::seconds timeout) {
  struct stat facts {};
  // A plain file must not be written into, and a pipe would wait for a reader.
  if (stat(path.c_str(), &facts) == 0 && !S_ISCHR(facts.st_mode)) {
    return refuse(path, "not a device; expected one as /dev/watchdog");
  }
  FileDescriptor device(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!device.valid()) {
    return refuse(path, errno == EBUSY
                            ? "another process feeds it already; expected it free, or to be left to that process"
                            : std::string(std::strerror(errno)) + "; expected a device that this user may write to");
  }
  const Result<int> set = set_timeout(path, device.get(), static_cast<int>(timeout.count()));
  if (!set) {
    (void)put(device.get(), kMagicClose);  // it runs since it was opened
    return set.error();
  }
  return WatchdogDevice(std::move(device), std::chrono::seconds(set.value()));
}

bool WatchdogDevice::feed() noexcept { return device_.valid() && put(device_.get(), kFood); }

bool WatchdogDevice::end() noexcept {
  if (!device_.valid()) {
    return false;
  }
  const bool taken = put(device_.get(), kMagicClose);
  (void)FileDescriptor(std::move(device_));
  return taken;
}

}  // namespace ivo::hal
