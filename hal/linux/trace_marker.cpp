#include "hal/linux/trace_marker.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "config/base/realtime.hpp"

namespace ivo::hal {

Result<TraceMarker> TraceMarker::open(std::span<const std::string_view> phases, const std::string& path) {
  FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!file.valid()) {
    return Error{path + ": cannot be written: " + std::strerror(errno) +
                 "; expected tracefs to be mounted there, and root"};
  }
  return TraceMarker(std::move(file), phases);
}

TraceMarker::TraceMarker(FileDescriptor file, std::span<const std::string_view> phases) : file_(std::move(file)) {
  const std::string pid = std::to_string(::getpid());
  begin_cycle_ = "B|" + pid + "|cycle\n";
  end_ = "E|" + pid + "\n";
  for (const std::string_view phase : phases) {
    begin_.push_back("B|" + pid + "|" + std::string(phase) + "\n");
  }
}

void TraceMarker::begin_cycle() noexcept {
  write(begin_cycle_);
  if (!begin_.empty()) {
    write(begin_.front());
  }
}

void TraceMarker::end_phase(std::size_t phase) noexcept {
  write(end_);
  if (phase + 1 < begin_.size()) {
    write(begin_[phase + 1]);
  }
}

// The kernel takes a line whole: what is cut is as good as lost.
void TraceMarker::write(const std::string& line) noexcept {
  const KnownNotToWait exempt;  // tracefs: the kernel copies the line into a ring of its own, or drops it
  if (::write(file_.get(), line.data(), line.size()) != static_cast<ssize_t>(line.size())) {
    ++lost_;
  }
}

}  // namespace ivo::hal
