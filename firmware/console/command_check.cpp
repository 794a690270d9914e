#include "firmware/console/command_check.hpp"

#include <algorithm>
#include <cstring>

namespace ivo::firmware::console {
namespace {

bool from_client(Kind kind) noexcept { return kind >= Kind::kPing && kind <= Kind::kClearFault; }

Verdict form_of(const Command& command) noexcept {
  if (command.header.magic != kMagic) {
    return Verdict::kWrongMagic;
  }
  if (command.header.version != kVersion) {
    return Verdict::kWrongVersion;
  }
  if (!from_client(command.header.kind)) {
    return Verdict::kUnknownKind;
  }
  if (command.header.size != sizeof(Command)) {
    return Verdict::kWrongSize;
  }
  return command.zero == 0 ? Verdict::kAccepted : Verdict::kNotZero;
}

}  // namespace

bool RateLimit::allows(Clock::time_point now) noexcept {
  const Clock::time_point paid = std::max(all_paid_, now) + kOne;
  if (paid > now + kCommandsPerSecond * kOne) {
    return false;
  }
  all_paid_ = paid;
  return true;
}

Verdict CommandCheck::judge(std::span<const std::byte> message, std::size_t size, RateLimit::Clock::time_point now,
                            Command& command) noexcept {
  if (size != sizeof(Command) || message.size() < sizeof(Command)) {
    return Verdict::kWrongSize;
  }
  Command read;
  std::memcpy(&read, message.data(), sizeof(read));
  if (const Verdict form = form_of(read); form != Verdict::kAccepted) {
    return form;
  }
  // Packets of one connection are neither lost nor overtaken: whoever counts otherwise repeats or forges.
  if (read.header.sequence <= last_) {
    return Verdict::kReplayed;
  }
  if (read.header.sequence != last_ + 1) {
    return Verdict::kOutOfOrder;
  }
  last_ = read.header.sequence;
  if (!rate_.allows(now) && read.header.kind != Kind::kStop) {
    return Verdict::kTooOften;
  }
  command = read;
  return Verdict::kAccepted;
}

std::uint32_t claimed_sequence(std::span<const std::byte> message) noexcept {
  Header header;
  if (message.size() < sizeof(header)) {
    return 0;
  }
  std::memcpy(&header, message.data(), sizeof(header));
  return header.sequence;
}

}  // namespace ivo::firmware::console
