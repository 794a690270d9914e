// State that survives the end of a program at any moment, also in the middle of writing, and a power cut: two slots,
// PATH.0 and PATH.1, written in turn. While one is written the other is whole.
//
// A slot is magic (8 bytes), CRC-32 of all that follows (4), version (4), sequence (8), length (4), and `length` bytes
// of state; little-endian. What lies behind that is left of a longer one and means nothing.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "config/base/result.hpp"

namespace ivo::firmware {

/// What the two slots of a path hold.
struct FoundState {
  enum class Kind : std::uint8_t {
    kNone,     ///< neither is there
    kWhole,    ///< `state` is the newest that is whole
    kForeign,  ///< the newest whole one is of another `version` than was asked for
    kDamaged,  ///< there is something, and nothing of it is whole: no crash does that, a disk does
  };
  Kind kind = Kind::kNone;
  std::string state;
  std::uint32_t version = 0;
  std::uint64_t sequence = 0;
  int slot = 0;             ///< in which `state` is
  bool other_torn = false;  ///< the other slot is not whole: the program ended while it wrote it, or the disk lost it
};

class StateFile {
 public:
  static constexpr std::size_t kHeader = 28;
  static constexpr std::size_t kLongest = std::size_t{64} << 20;

  /// Fails when a slot is there and cannot be read, in one line that names it. Waits for the disk.
  [[nodiscard]] static Result<FoundState> read(const std::string& path, std::uint32_t version);

  /// Begins with `state`, in place of what `found` was. It is on the disk when this returns.
  [[nodiscard]] static Result<StateFile> create(const std::string& path, std::uint32_t version, const FoundState& found,
                                                std::string_view state);
  /// Goes on after `found`, a whole one; writes nothing.
  StateFile(std::string path, std::uint32_t version, const FoundState& found);

  /// Keeps `state` (at most kLongest) over the older slot. Waits for the disk; when it returns well, the disk has it.
  /// On failure, in one line, the newer slot is as it was.
  [[nodiscard]] Result<void> keep(std::string_view state);

  /// Both slots under another name, over what has it: PREVIOUS.0 and PREVIOUS.1.
  [[nodiscard]] static Result<void> set_aside(const std::string& path, const std::string& previous);

 private:
  std::string path_;
  std::uint32_t version_;
  std::uint64_t sequence_;
  int slot_;  // of the newest
};

}  // namespace ivo::firmware
