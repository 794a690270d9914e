#include "firmware/tools/doctor/disk_trial.hpp"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "hal/api/file_descriptor.hpp"
#include "hal/linux/monotonic_clock.hpp"

namespace ivo::firmware::doctor {
namespace {

constexpr std::size_t kMostWrites = 50;
constexpr Duration kPatience = std::chrono::milliseconds(500);
constexpr std::size_t kBlockBytes = 4096;  // what a second of a search's state and events comes to, or more

namespace fs = std::filesystem;

Result<std::string> nearest_folder(const std::string& asked) {
  std::error_code unknown;
  fs::path path = fs::absolute(asked, unknown).lexically_normal();
  while (!fs::exists(path, unknown) && path.has_relative_path()) {
    path = path.parent_path();
  }
  if (!fs::is_directory(path, unknown)) {
    return Error{asked + ": " + path.string() + " is no folder; expected one, or none yet"};
  }
  return path.string();
}

/// A file that is gone when it is closed, whatever ends the program.
hal::FileDescriptor nameless_file(const std::string& folder) {
  hal::FileDescriptor file(::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600));
  if (file.valid() || (errno != EOPNOTSUPP && errno != EISDIR && errno != ENOENT)) {
    return file;
  }
  std::string name = folder + "/.ivo-doctor.XXXXXX";
  file = hal::FileDescriptor(::mkostemp(name.data(), O_CLOEXEC));
  if (file.valid()) {
    ::unlink(name.c_str());
  }
  return file;
}

bool in_memory(const std::string& folder) {
  constexpr std::array<std::uint32_t, 2> kMemory{0x01021994, 0x858458F6};  // tmpfs, ramfs (linux/magic.h)
  struct statfs system {};
  return ::statfs(folder.c_str(), &system) == 0 &&
         std::ranges::find(kMemory, static_cast<std::uint32_t>(system.f_type)) != kMemory.end();
}

}  // namespace

Result<DiskFacts> try_disk(const std::string& folder) {
  const Result<std::string> nearest = nearest_folder(folder);
  if (!nearest) {
    return nearest.error();
  }
  DiskFacts facts{.folder = nearest.value(), .in_memory = in_memory(nearest.value()), .writes = {}, .refusal = {}};
  struct statvfs room {};
  if (::statvfs(facts.folder.c_str(), &room) == 0) {
    facts.free_bytes = std::uint64_t{room.f_bavail} * room.f_frsize;
  }
  const hal::FileDescriptor file = nameless_file(facts.folder);
  std::array<char, kBlockBytes> block{};
  hal::MonotonicClock clock;
  const Instant begin = clock.now();
  for (Instant before = begin; facts.writes.size() < kMostWrites && before - begin < kPatience;) {
    if (!file.valid() || ::write(file.get(), block.data(), block.size()) != static_cast<ssize_t>(block.size()) ||
        ::fsync(file.get()) != 0) {
      facts.refusal = std::strerror(errno);
      break;
    }
    const Instant after = clock.now();
    facts.writes.push_back(after - before);
    before = after;
  }
  std::ranges::sort(facts.writes);
  return facts;
}

}  // namespace ivo::firmware::doctor
