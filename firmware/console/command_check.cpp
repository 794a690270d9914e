#include "firmware/console/command_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ivo::firmware::console {
namespace {

constexpr double kFarthest_m = 1e6;  // no map is as large
constexpr double kOldest_s = 10.0;

std::size_t size_of(Kind kind) noexcept {
  switch (kind) {
    case Kind::kPutArea:
      return sizeof(AreaCommand);
    case Kind::kPose:
      return sizeof(PoseCommand);
    default:
      return sizeof(Command);
  }
}

bool from_client(Kind kind) noexcept { return kind >= Kind::kPing && kind <= Kind::kPose; }

bool has_argument(Kind kind) noexcept {
  switch (kind) {
    case Kind::kConsent:
    case Kind::kReplan:
    case Kind::kEnough:
    case Kind::kAccept:
    case Kind::kFound:
    case Kind::kRemoveArea:
      return true;
    default:
      return false;
  }
}

Verdict form_of(const Header& header, std::size_t size) noexcept {
  if (header.magic != kMagic) {
    return Verdict::kWrongMagic;
  }
  if (header.version != kVersion) {
    return Verdict::kWrongVersion;
  }
  if (!from_client(header.kind)) {
    return Verdict::kUnknownKind;
  }
  return header.size == size && size == size_of(header.kind) ? Verdict::kAccepted : Verdict::kWrongSize;
}

bool within(double value, double low, double high) noexcept { return value >= low && value <= high; }  // no NaN is

bool on_any_map(double x_m, double y_m) noexcept {
  return within(x_m, -kFarthest_m, kFarthest_m) && within(y_m, -kFarthest_m, kFarthest_m);
}

Verdict content_of(const Command& command) noexcept {
  if (!has_argument(command.header.kind) && command.argument != 0) {
    return Verdict::kNotZero;
  }
  if (command.header.kind == Kind::kConsent && command.argument > 1) {
    return Verdict::kOutOfRange;
  }
  const bool fits = (command.header.kind != Kind::kFound || command.argument < kAgents) &&
                    (command.header.kind != Kind::kRemoveArea || command.argument < kAreaSlots);
  return fits ? Verdict::kAccepted : Verdict::kOutOfRange;
}

Verdict content_of(const AreaCommand& area) noexcept {
  if (area.corners > kAreaCorners || area.slot >= kAreaSlots || area.purpose > AreaPurpose::kNoGo ||
      (area.agent >= kAgents && (area.agent != AreaCommand::kEverybody || area.purpose != AreaPurpose::kNoGo))) {
    return Verdict::kOutOfRange;
  }
  if (area.corners < 3) {
    return Verdict::kNotAnArea;
  }
  bool empty = area.zero == 0;
  bool places = true;
  for (std::size_t i = 0; i < area.corner.size(); ++i) {
    const Corner& corner = area.corner[i];
    if (i < area.corners) {
      places = places && on_any_map(corner.x_m, corner.y_m);
    } else {
      empty = empty && corner.x_m == 0.0 && corner.y_m == 0.0;
    }
  }
  return !empty ? Verdict::kNotZero : places ? Verdict::kAccepted : Verdict::kOutOfRange;
}

Verdict content_of(const PoseCommand& pose) noexcept {
  if (std::ranges::any_of(pose.zero, [](std::uint8_t byte) { return byte != 0; })) {
    return Verdict::kNotZero;
  }
  const bool fits = pose.agent < kAgents && on_any_map(pose.x_m, pose.y_m) &&
                    within(pose.heading_rad, -kFarthest_m, kFarthest_m) && within(pose.sigma_m, 0, kFarthest_m) &&
                    within(pose.sigma_heading_rad, 0, kFarthest_m) && within(pose.age_s, 0, kOldest_s);
  return fits ? Verdict::kAccepted : Verdict::kOutOfRange;
}

// `packet` has as many bytes as its kind has.
template <class Message>
Verdict read_as(std::span<const std::byte> packet, ClientMessage& message) noexcept {
  Message read;
  std::memcpy(&read, packet.data(), sizeof(read));
  message = read;
  return content_of(read);
}

Verdict read(std::span<const std::byte> packet, Kind kind, ClientMessage& message) noexcept {
  switch (kind) {
    case Kind::kPutArea:
      return read_as<AreaCommand>(packet, message);
    case Kind::kPose:
      return read_as<PoseCommand>(packet, message);
    default:
      return read_as<Command>(packet, message);
  }
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

Verdict CommandCheck::judge(std::span<const std::byte> packet, std::size_t size, RateLimit::Clock::time_point now,
                            ClientMessage& message) noexcept {
  Header header;
  if (size < sizeof(header) || packet.size() != size) {
    return Verdict::kWrongSize;
  }
  std::memcpy(&header, packet.data(), sizeof(header));
  if (const Verdict form = form_of(header, size); form != Verdict::kAccepted) {
    return form;
  }
  ClientMessage heard;
  if (const Verdict content = read(packet, header.kind, heard); content != Verdict::kAccepted) {
    return content;
  }
  // Packets of one connection are neither lost nor overtaken: whoever counts otherwise repeats or forges.
  if (header.sequence <= last_) {
    return Verdict::kReplayed;
  }
  if (header.sequence != last_ + 1) {
    return Verdict::kOutOfOrder;
  }
  last_ = header.sequence;
  if (!rate_.allows(now) && !stops(header.kind)) {
    return Verdict::kTooOften;
  }
  message = heard;
  return Verdict::kAccepted;
}

std::uint32_t claimed_sequence(std::span<const std::byte> packet) noexcept {
  Header header;
  if (packet.size() < sizeof(header)) {
    return 0;
  }
  std::memcpy(&header, packet.data(), sizeof(header));
  return header.sequence;
}

}  // namespace ivo::firmware::console
