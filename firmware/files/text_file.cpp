#include "firmware/files/text_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace ivo::firmware {
namespace {

constexpr std::size_t kLongest = std::size_t{256} << 20;

class Descriptor {
 public:
  explicit Descriptor(int fd) noexcept : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) {
      ::close(fd_);
    }
  }
  [[nodiscard]] int get() const noexcept { return fd_; }
  /// Errors of delayed writes surface at close on some file systems.
  [[nodiscard]] bool close() noexcept {
    const int fd = fd_;
    fd_ = -1;
    return ::close(fd) == 0;
  }

 private:
  int fd_;
};

Error failure(const std::string& path, std::string_view what) {
  return Error{path + ": " + std::string(what) + ": " + std::strerror(errno)};
}

bool write_all(int fd, std::string_view contents) noexcept {
  while (!contents.empty()) {
    const ssize_t written = ::write(fd, contents.data(), contents.size());
    if (written > 0) {
      contents.remove_prefix(static_cast<std::size_t>(written));
    } else if (written < 0 && errno != EINTR) {
      return false;
    }
  }
  return true;
}

/// A folder cannot be replaced by a file, and a device must not be.
Result<void> no_other_thing(const std::string& path) {
  std::error_code unknown;  // says for itself when it is written
  const std::filesystem::file_status there = std::filesystem::status(path, unknown);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there)) {
    return Error{path + ": cannot be written: it is " +
                 (std::filesystem::is_directory(there) ? "a folder" : "a pipe or a device") + "; expected a file"};
  }
  return {};
}

/// Of a new file beside `path`.
std::string temporary_name(const std::string& folder, const std::string& path) {
  return folder + "/." + std::filesystem::path(path).filename().string() + ".XXXXXX";
}

std::string folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

Result<void> write_as(const std::string& path, std::string_view contents, mode_t mode) {
  if (Result<void> replaceable = no_other_thing(path); !replaceable) {
    return replaceable;
  }
  const std::string folder = folder_of(path);
  std::string temporary = temporary_name(folder, path);
  Descriptor file(::mkostemp(temporary.data(), O_CLOEXEC));
  if (file.get() < 0) {
    return failure(path, "cannot be written");
  }
  // mkostemp hides the file from others, whom results are for too.
  if (::fchmod(file.get(), mode) != 0 || !write_all(file.get(), contents) || ::fsync(file.get()) != 0 ||
      !file.close() || std::rename(temporary.c_str(), path.c_str()) != 0) {
    const Error error = failure(path, "cannot be written");
    ::unlink(temporary.c_str());
    return error;
  }
  // The new name survives a power cut only when the folder is synced too.
  const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.get() < 0 || ::fsync(directory.get()) != 0) {
    return failure(folder, "cannot be synced");
  }
  return {};
}

}  // namespace

Result<std::string> read_file(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) {
    return failure(path, "cannot be read");
  }
  std::string contents;
  char block[65536];
  for (;;) {
    const ssize_t got = ::read(file.get(), block, sizeof block);
    if (got == 0) {
      return contents;
    }
    if (got < 0) {
      if (errno == EINTR) {
        continue;
      }
      return failure(path, "cannot be read");
    }
    contents.append(block, static_cast<std::size_t>(got));
    if (contents.size() > kLongest) {
      return Error{path + ": longer than 256 MiB; expected a file that fits in memory"};
    }
  }
}

Result<void> write_file(const std::string& path, std::string_view contents) { return write_as(path, contents, 0644); }

Result<void> write_private_file(const std::string& path, std::string_view contents) {
  return write_as(path, contents, 0600);
}

Result<void> check_writable(const std::string& path) {
  if (Result<void> replaceable = no_other_thing(path); !replaceable) {
    return replaceable;
  }
  std::string temporary = temporary_name(folder_of(path), path);
  const Descriptor file(::mkostemp(temporary.data(), O_CLOEXEC));
  if (file.get() < 0) {
    return failure(path, "cannot be written");
  }
  ::unlink(temporary.c_str());
  return {};
}

Result<void> make_folder(const std::string& path) {
  std::error_code status;
  std::filesystem::create_directories(path, status);
  if (status) {
    return Error{path + ": cannot be made: " + status.message()};
  }
  // A file of that name is not an error to create_directories on every library.
  if (!std::filesystem::is_directory(path, status)) {
    return Error{path + ": cannot be made: it is a file; expected a folder"};
  }
  return {};
}

std::string beside(const std::string& file, const std::string& relative) {
  return (std::filesystem::path(file).parent_path() / relative).lexically_normal().string();
}

}  // namespace ivo::firmware
