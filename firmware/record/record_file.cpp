#include "firmware/record/record_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

namespace ivo::firmware {
namespace {

constexpr std::size_t kBlock = 65536;

Error failure(const std::string& path) { return Error{path + ": cannot be written: " + std::strerror(errno)}; }

/// Whether `file` is new, or of that kind.
Result<void> may_be_replaced(int file, const std::string& path, std::string_view begins, const RecordFile::Kind& kind) {
  struct stat status {};
  if (::fstat(file, &status) != 0) {
    return failure(path);
  }
  if (!S_ISREG(status.st_mode)) {
    return Error{path + ": cannot be written: it is a pipe or a device; expected a file"};
  }
  std::string first(begins.size(), '\0');
  const ssize_t got = ::pread(file, first.data(), first.size(), 0);
  if (got < 0) {
    return failure(path);
  }
  if (got > 0 && first != begins) {
    return Error{path + ": is there already and is no " + kind.record + " of " + kind.of +
                 "; expected a new file, or a " + kind.record + " to replace"};
  }
  return {};
}

/// Whether `path` leads to `file` yet: whoever held it may have moved or removed it before it was ours.
bool is_at(int file, const std::string& path) {
  struct stat held {};
  struct stat named {};
  return ::fstat(file, &held) == 0 && ::stat(path.c_str(), &named) == 0 && held.st_dev == named.st_dev &&
         held.st_ino == named.st_ino;
}

bool may_be_set_aside(const std::filesystem::path& path) {
  return ::access(path.has_parent_path() ? path.parent_path().c_str() : ".", W_OK | X_OK) == 0;
}

/// Where nothing is yet.
std::string name_aside(const std::filesystem::path& path) {
  for (int number = 1;; ++number) {
    std::filesystem::path aside = path;
    aside.replace_extension(".previous" + (number > 1 ? "-" + std::to_string(number) : std::string()) +
                            path.extension().string());
    std::error_code unknown;
    if (!std::filesystem::exists(aside, unknown)) {
      return aside.string();
    }
  }
}

}  // namespace

Result<RecordFile> RecordFile::create(const std::string& path, std::string_view begins, const Kind& kind,
                                      Earlier earlier) {
  // Without O_TRUNC: what is there is looked at first. Without waiting: a pipe may have nobody at its other end.
  constexpr int kFlags = O_RDWR | O_CREAT | O_NONBLOCK | O_CLOEXEC;
  int fd = ::open(path.c_str(), kFlags | O_EXCL, 0644);
  const bool is_new = fd >= 0;
  if (fd < 0 && errno == EEXIST) {
    fd = ::open(path.c_str(), kFlags, 0644);
  }
  RecordFile file(fd, path, kind, earlier);
  if (file.fd_ < 0) {
    return failure(path);
  }
  if (const Result<void> replaceable = may_be_replaced(file.fd_, path, begins, kind); !replaceable) {
    return replaceable.error();
  }
  // Held until the process ends, however it ends.
  if (::flock(file.fd_, LOCK_EX | LOCK_NB) != 0 || !is_at(file.fd_, path)) {
    return Error{path + ": another run is writing here; expected a file of its own for each run"};
  }
  if (earlier == Earlier::kSetAside && !may_be_set_aside(path)) {
    return failure(path);
  }
  file.is_new_ = is_new;
  return file;
}

// With the first bytes that are written, and no sooner: a run that is refused meanwhile leaves what was there.
bool RecordFile::begin() {
  begun_ = true;
  if (earlier_ == Earlier::kReplaced || ::lseek(fd_, 0, SEEK_END) <= 0) {
    return ::ftruncate(fd_, 0) == 0 && ::lseek(fd_, 0, SEEK_SET) == 0;
  }
  std::string aside = name_aside(path_);
  if (std::rename(path_.c_str(), aside.c_str()) != 0) {
    return false;
  }
  set_aside_ = std::move(aside);
  (void)close_file();  // it was written by another run
  fd_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  return fd_ >= 0 && ::flock(fd_, LOCK_EX | LOCK_NB) == 0;
}

RecordFile::RecordFile(RecordFile&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)),
      path_(std::move(other.path_)),
      set_aside_(std::move(other.set_aside_)),
      kind_(other.kind_),
      earlier_(other.earlier_),
      is_new_(std::exchange(other.is_new_, false)),
      begun_(other.begun_),
      buffer_(std::move(other.buffer_)),
      ends_(std::move(other.ends_)),
      count_(other.count_),
      missing_(other.missing_),
      bytes_(other.bytes_),
      failure_(other.failure_) {}

RecordFile::~RecordFile() {
  if (is_new_ && !begun_) {
    ::unlink(path_.c_str());
  }
  (void)close_file();
}

std::string RecordFile::where() const {
  return set_aside_.empty() ? path_ : path_ + ", the one before in " + set_aside_;
}

bool RecordFile::close_file() noexcept {
  const int fd = std::exchange(fd_, -1);
  return fd < 0 || ::close(fd) == 0;
}

void RecordFile::append(std::string_view record, std::uint64_t holds) {
  if (failure_ != 0) {
    missing_ += holds;
    return;
  }
  buffer_ += record;
  bytes_ += record.size();
  ends_.push_back({buffer_.size(), holds});
  if (begun_ && buffer_.size() >= kBlock) {
    write_out();
  }
}

void RecordFile::write_out() {
  if (!begun_ && failure_ == 0 && !begin()) {
    failure_ = errno;
  }
  std::string_view left = buffer_;
  while (!left.empty() && failure_ == 0) {
    const ssize_t written = ::write(fd_, left.data(), left.size());
    if (written > 0) {
      left.remove_prefix(static_cast<std::size_t>(written));
    } else if (written < 0 && errno != EINTR) {
      failure_ = errno;
    }
  }
  const std::size_t taken = buffer_.size() - left.size();
  if (!left.empty()) {
    cut(taken);
  }
  for (const End& end : ends_) {
    (end.at <= taken ? count_ : missing_) += end.holds;
  }
  buffer_.clear();
  ends_.clear();
}

// The record of which only a part was taken goes.
void RecordFile::cut(std::size_t taken) {
  std::size_t whole = 0;
  for (const End& end : ends_) {
    whole = end.at <= taken ? end.at : whole;
  }
  const off_t end = ::lseek(fd_, 0, SEEK_CUR);
  if (end >= 0) {
    (void)::ftruncate(fd_, end - static_cast<off_t>(taken - whole));
  }
}

Result<void> RecordFile::close(std::uint64_t lost_before) {
  write_out();
  // A disk may say only now that it was full.
  if (failure_ == 0 && ::fsync(fd_) != 0) {
    failure_ = errno;
  }
  if (!close_file() && failure_ == 0) {
    failure_ = errno;
  }
  if (failure_ != 0) {
    return Error{path_ + ": the " + kind_.record + " ends early, " + std::to_string(missing_ + lost_before) + " " +
                 kind_.of + " are missing: " + std::strerror(failure_)};
  }
  if (lost_before > 0) {
    return Error{path_ + ": " + std::to_string(lost_before) + " " + kind_.of +
                 " are missing in between; expected a disk and a terminal that keep up"};
  }
  return {};
}

}  // namespace ivo::firmware
