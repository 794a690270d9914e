#include "firmware/record/candump_log.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace ivo::firmware {
namespace {

constexpr std::size_t kBlock = 65536;

Error failure(const std::string& path) { return Error{path + ": cannot be written: " + std::strerror(errno)}; }

/// Whether `file` is new, or holds what this program or candump wrote: a slip of the keyboard must not cost a mission.
Result<void> may_be_replaced(int file, const std::string& path) {
  struct stat status {};
  if (::fstat(file, &status) != 0) {
    return failure(path);
  }
  if (!S_ISREG(status.st_mode)) {
    return Error{path + ": cannot be written: it is a pipe or a device; expected a file"};
  }
  char first = '(';
  if (::pread(file, &first, 1, 0) < 0) {
    return failure(path);
  }
  if (first != '(') {
    return Error{path + ": is there already and is no record of frames; expected a new file, or a record to replace"};
  }
  return {};
}

}  // namespace

std::string candump_line(const RecordedFrame& recorded, const std::string& interface, Duration epoch) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  constexpr long long kSecond = 1'000'000;
  const long long us = (epoch + recorded.at.time_since_epoch()).count() / 1000;
  std::array<char, 64> stamp{};
  (void)std::snprintf(stamp.data(), stamp.size(), "(%010lld.%06lld) ", us / kSecond, us % kSecond);
  std::string line = stamp.data() + interface + ' ';
  const hal::CanFrame& frame = recorded.frame;
  for (const int shift : {8, 4, 0}) {
    line += kDigits[frame.id >> shift & 0xF];
  }
  line += '#';
  for (std::size_t i = 0; i < frame.size; ++i) {
    line += kDigits[frame.data[i] >> 4];
    line += kDigits[frame.data[i] & 0xF];
  }
  return line + '\n';
}

Result<CandumpLog> CandumpLog::create(const std::string& path, const std::string& interface, Duration epoch) {
  // Without O_TRUNC: what is there is looked at first. Without waiting: a pipe may have nobody at its other end.
  CandumpLog log(::open(path.c_str(), O_RDWR | O_CREAT | O_NONBLOCK | O_CLOEXEC, 0644), path, interface, epoch);
  if (log.file_.fd() < 0) {
    return failure(path);
  }
  if (const Result<void> replaceable = may_be_replaced(log.file_.fd(), path); !replaceable) {
    return replaceable.error();
  }
  // Held until the process ends, however it ends.
  if (::flock(log.file_.fd(), LOCK_EX | LOCK_NB) != 0) {
    return Error{path + ": another run is writing here; expected a file of its own for each run"};
  }
  if (::ftruncate(log.file_.fd(), 0) != 0) {
    return failure(path);
  }
  return log;
}

CandumpLog::CandumpLog(int file, std::string path, std::string interface, Duration epoch)
    : file_(file), path_(std::move(path)), interface_(std::move(interface)), epoch_(epoch) {}

bool CandumpLog::File::close() noexcept {
  const int fd = std::exchange(fd_, -1);
  return fd < 0 || ::close(fd) == 0;
}

void CandumpLog::drain(FrameRing& ring) {
  for (RecordedFrame recorded; ring.pop(recorded);) {
    append(recorded);
  }
  write_out();
}

void CandumpLog::append(const RecordedFrame& recorded) {
  if (failure_ != 0) {
    ++missing_;
    return;
  }
  lines_ += candump_line(recorded, interface_, epoch_);
  ++lines_held_;
  if (lines_.size() >= kBlock) {
    write_out();
  }
}

void CandumpLog::write_out() {
  std::string_view left = lines_;
  while (!left.empty() && failure_ == 0) {
    const ssize_t written = ::write(file_.fd(), left.data(), left.size());
    if (written > 0) {
      left.remove_prefix(static_cast<std::size_t>(written));
    } else if (written < 0 && errno != EINTR) {
      failure_ = errno;
    }
  }
  std::uint64_t unwritten = 0;
  if (failure_ != 0 && !left.empty()) {
    // The line that was cut goes, with all after it.
    const std::size_t taken = lines_.size() - left.size();
    const std::size_t whole = taken == 0 ? 0 : lines_.rfind('\n', taken - 1) + 1;  // npos + 1 is 0
    const off_t end = ::lseek(file_.fd(), 0, SEEK_CUR);
    if (end >= 0) {
      (void)::ftruncate(file_.fd(), end - static_cast<off_t>(taken - whole));
    }
    for (const char c : std::string_view(lines_).substr(whole)) {
      unwritten += c == '\n' ? 1 : 0;
    }
  }
  frames_ += lines_held_ - unwritten;
  missing_ += unwritten;
  lines_.clear();
  lines_held_ = 0;
}

Result<void> CandumpLog::close(const FrameRing& ring) {
  // A disk may say only now that it was full.
  if (failure_ == 0 && ::fsync(file_.fd()) != 0) {
    failure_ = errno;
  }
  if (!file_.close() && failure_ == 0) {
    failure_ = errno;
  }
  if (failure_ != 0) {
    return Error{path_ + ": the record ends early, " + std::to_string(missing_ + ring.lost()) +
                 " frames are missing: " + std::strerror(failure_)};
  }
  if (ring.lost() > 0) {
    return Error{path_ + ": " + std::to_string(ring.lost()) +
                 " frames are missing in between; expected a disk and a terminal that keep up"};
  }
  return {};
}

}  // namespace ivo::firmware
