#include "firmware/record/state_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>

#include "firmware/record/crc32.hpp"
#include "firmware/record/plain_bytes.hpp"
#include "hal/api/file_descriptor.hpp"

namespace ivo::firmware {
namespace {

constexpr std::string_view kStateMagic = "IVOstate";
constexpr std::size_t kUntilSum = 12;  // magic and sum, which the sum does not cover

Error failure(const std::string& path, const char* what) {
  return Error{path + ": " + what + ": " + std::strerror(errno)};
}

std::string slot_path(const std::string& path, int slot) { return path + "." + std::to_string(slot); }

std::string slot_bytes(std::uint32_t version, std::uint64_t sequence, std::string_view state) {
  ByteWriter summed;
  summed.u32(version);
  summed.u64(sequence);
  summed.u32(static_cast<std::uint32_t>(state.size()));
  ByteWriter slot;
  slot.u32(crc32(state, crc32(summed.bytes())));
  std::string bytes(kStateMagic);
  bytes += slot.bytes();
  bytes += summed.bytes();
  bytes += state;
  return bytes;
}

struct Slot {
  bool there = false;  // and not empty: a slot that is made has nothing in it at first
  bool whole = false;
  std::uint32_t version = 0;
  std::uint64_t sequence = 0;
  std::string state;
};

Slot parse(std::string_view bytes) {
  Slot slot;
  slot.there = !bytes.empty();
  if (bytes.size() < StateFile::kHeader || !bytes.starts_with(kStateMagic)) {
    return slot;
  }
  ByteReader header(bytes.substr(kStateMagic.size(), StateFile::kHeader - kStateMagic.size()));
  const std::uint32_t sum = header.u32();
  slot.version = header.u32();
  slot.sequence = header.u64();
  const std::uint32_t length = header.u32();
  if (length > bytes.size() - StateFile::kHeader ||
      crc32(bytes.substr(kUntilSum, StateFile::kHeader - kUntilSum + length)) != sum) {
    return slot;
  }
  slot.whole = true;
  slot.state = bytes.substr(StateFile::kHeader, length);
  return slot;
}

Result<Slot> read_slot(const std::string& path) {
  const hal::FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) {
    return errno == ENOENT ? Result<Slot>(Slot{}) : failure(path, "cannot be read");
  }
  std::string bytes;
  std::array<char, 16384> block{};
  for (;;) {
    const ssize_t got = ::read(file.get(), block.data(), block.size());
    if (got == 0 || bytes.size() > StateFile::kHeader + StateFile::kLongest) {
      return parse(bytes);
    }
    if (got < 0 && errno != EINTR) {
      return failure(path, "cannot be read");
    }
    bytes.append(block.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
  }
}

bool write_all(int fd, std::string_view bytes) noexcept {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (written == 0 || errno != EINTR) {
      return false;
    }
  }
  return true;
}

// Over what is there, without cutting it off first: a file that keeps its blocks needs no room on a full disk.
Result<void> write_over(const std::string& path, std::string_view bytes) {
  const hal::FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644));
  if (file.get() < 0 || !write_all(file.get(), bytes) || ::fdatasync(file.get()) != 0) {
    return failure(path, "cannot be written");
  }
  return {};
}

// A new name survives a power cut only when its folder is synced too.
Result<void> sync_folder_of(const std::string& path) {
  const std::size_t end = path.rfind('/');
  const std::string folder = end == std::string::npos ? "." : path.substr(0, end + 1);
  const hal::FileDescriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.get() < 0 || ::fsync(directory.get()) != 0) {
    return failure(folder, "cannot be synced");
  }
  return {};
}

}  // namespace

Result<FoundState> StateFile::read(const std::string& path, std::uint32_t version) {
  std::array<Slot, 2> slots;
  for (int i = 0; i < 2; ++i) {
    Result<Slot> slot = read_slot(slot_path(path, i));
    if (!slot) {
      return slot.error();
    }
    slots[static_cast<std::size_t>(i)] = std::move(slot).value();
  }
  FoundState found;
  if (!slots[0].whole && !slots[1].whole) {
    found.kind = slots[0].there || slots[1].there ? FoundState::Kind::kDamaged : FoundState::Kind::kNone;
    return found;
  }
  const bool second = slots[1].whole && (!slots[0].whole || slots[1].sequence > slots[0].sequence);
  Slot& newest = slots[second ? 1 : 0];
  const Slot& other = slots[second ? 0 : 1];
  found.kind = newest.version == version ? FoundState::Kind::kWhole : FoundState::Kind::kForeign;
  found.state = std::move(newest.state);
  found.version = newest.version;
  found.sequence = newest.sequence;
  found.slot = second ? 1 : 0;
  found.other_torn = other.there && !other.whole;
  return found;
}

Result<StateFile> StateFile::create(const std::string& path, std::uint32_t version, const FoundState& found,
                                    std::string_view state) {
  FoundState begun;
  begun.sequence = found.sequence + 1;
  begun.slot = 0;
  // Renamed into place, so that even the first one is never seen in part.
  const std::string temporary = path + ".new";
  (void)::unlink(temporary.c_str());
  if (const Result<void> written = write_over(temporary, slot_bytes(version, begun.sequence, state)); !written) {
    (void)::unlink(temporary.c_str());
    return written.error();
  }
  if (std::rename(temporary.c_str(), slot_path(path, 0).c_str()) != 0) {
    const Error error = failure(slot_path(path, 0), "cannot be written");
    (void)::unlink(temporary.c_str());
    return error;
  }
  // Afterwards: until now the other one may have been the newest.
  if (::unlink(slot_path(path, 1).c_str()) != 0 && errno != ENOENT) {
    return failure(slot_path(path, 1), "cannot be removed");
  }
  if (const Result<void> synced = sync_folder_of(path); !synced) {
    return synced.error();
  }
  return StateFile(path, version, begun);
}

StateFile::StateFile(std::string path, std::uint32_t version, const FoundState& found)
    : path_(std::move(path)), version_(version), sequence_(found.sequence), slot_(found.slot) {}

Result<void> StateFile::keep(std::string_view state) {
  const int slot = 1 - slot_;
  const std::string name = slot_path(path_, slot);
  if (state.size() > kLongest) {
    return Error{name + ": cannot be written: the state is " + std::to_string(state.size()) +
                 " bytes long; expected at most " + std::to_string(kLongest)};
  }
  struct stat there {};
  const bool fresh = ::stat(name.c_str(), &there) != 0;
  if (Result<void> written = write_over(name, slot_bytes(version_, sequence_ + 1, state)); !written) {
    return written;
  }
  if (fresh) {
    if (Result<void> synced = sync_folder_of(path_); !synced) {
      return synced;
    }
  }
  ++sequence_;
  slot_ = slot;
  return {};
}

Result<void> StateFile::set_aside(const std::string& path, const std::string& previous) {
  for (int i = 0; i < 2; ++i) {
    const std::string to = slot_path(previous, i);
    if (::unlink(to.c_str()) != 0 && errno != ENOENT) {
      return failure(to, "cannot be removed");
    }
    if (std::rename(slot_path(path, i).c_str(), to.c_str()) != 0 && errno != ENOENT) {
      return failure(to, "cannot be written");
    }
  }
  return sync_folder_of(path);
}

}  // namespace ivo::firmware
