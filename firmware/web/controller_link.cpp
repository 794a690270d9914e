#include "firmware/web/controller_link.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>

#include "firmware/console/socket_path.hpp"
#include "firmware/loop/loop_status.hpp"
#include "firmware/web/controller_message.hpp"

namespace ivo::firmware::web {
namespace {

template <class Message>
std::optional<Message> message_of(console::Kind kind, std::span<const std::byte> packet) {
  Message message;
  if (packet.size() != sizeof(Message)) {
    return std::nullopt;
  }
  std::memcpy(&message, packet.data(), sizeof(Message));
  const console::Header& header = message.header;
  const bool ours = header.magic == console::kMagic && header.version == console::kVersion && header.kind == kind &&
                    header.size == packet.size();
  return ours ? std::optional(message) : std::nullopt;
}

/// What is shown from it stays within its arrays, and is a number.
bool sound(const console::Status& status) {
  const auto finite = [](double number) { return std::isfinite(number); };
  return status.agents <= console::kAgents && status.fault.back() == '\0' &&
         status.pause_cause <= static_cast<std::uint8_t>(PauseCause::kNoGo) &&
         status.asks <= console::Asks::kClearing && finite(status.beat_age_s) && finite(status.expected_time_s) &&
         finite(status.unseen_mass) && finite(status.horizon_s) && finite(status.searched_mass) &&
         finite(status.heading_rad) &&
         std::all_of(status.agent.begin(), status.agent.end(), [&](const console::AgentStatus& agent) {
           return finite(agent.x_m) && finite(agent.y_m) && finite(agent.moved_m) && finite(agent.left_m) &&
                  finite(agent.report_age_s);
         });
}

}  // namespace

void ControllerLink::connect(Instant now) {
  try_at_ = now + kTryAgain;
  Result<hal::FileDescriptor> connected = console::connect_at_once(path_);
  if (!connected) {
    complaint_ = connected.error().message;
    return;
  }
  socket_ = std::move(connected).value();
  said_ = 0;
  parts_ = {};
  came_ = {};
  known_anew_ = false;
  out_of_step_ = false;
}

void ControllerLink::disconnect(std::string why, Instant now) {
  socket_ = {};
  complaint_ = path_ + ": " + std::move(why);
  try_at_ = now + kTryAgain;
  if (view_.link != LinkState::kNone) {
    view_.link = LinkState::kAbsent;
  }
}

void ControllerLink::turn(Instant now) {
  if (!socket_.valid() && now >= try_at_) {
    connect(now);
  }
  std::array<std::byte, sizeof(console::DocumentPart)> room{};
  for (int i = 0; socket_.valid() && i < kPackets; ++i) {
    const ssize_t size = ::recv(socket_.get(), room.data(), room.size(), MSG_TRUNC | MSG_DONTWAIT);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) {
      break;
    }
    if (size <= 0) {
      disconnect("the controller has ended", now);
      break;
    }
    if (static_cast<std::size_t>(size) > room.size() || !hear(std::span(room).first(static_cast<std::size_t>(size)))) {
      disconnect("who listens there does not speak as this program does; expected version " +
                     std::to_string(console::kVersion) + " of the console's messages",
                 now);
      break;
    }
    view_.heard_at = now;
    if (out_of_step_) {
      disconnect("the controller counts otherwise than this program", now);
    }
  }
  if (socket_.valid() && view_.status && view_.link != LinkState::kAbsent && now - view_.heard_at >= kSilence) {
    view_.link = LinkState::kSilent;
  }
}

bool ControllerLink::hear(std::span<const std::byte> packet) {
  if (const auto answer = message_of<console::Answer>(console::Kind::kAnswer, packet)) {
    answers_.push_back({answer->of_sequence, answer->verdict});
    out_of_step_ = out_of_step_ || answer->verdict == console::Verdict::kOutOfOrder ||
                   answer->verdict == console::Verdict::kReplayed;
    return true;
  }
  if (const auto status = message_of<console::Status>(console::Kind::kStatus, packet)) {
    if (!sound(*status)) {
      return false;
    }
    if (!std::exchange(known_anew_, true)) {
      ++view_.connections;
      forget_what_did_not_come();
    }
    view_.link = LinkState::kConnected;
    view_.status = *status;
    ++view_.statuses;
    complaint_.clear();
    return true;
  }
  return hear_part(packet);
}

// Another controller may have no plan: that of the one before is not shown as its own.
void ControllerLink::forget_what_did_not_come() {
  for (std::size_t i = 0; i < came_.size(); ++i) {
    if (!came_[i] && view_.documents[i].bytes != nullptr) {
      view_.documents[i] = {.revision = ++revisions_, .bytes = nullptr};
    }
  }
}

bool ControllerLink::hear_part(std::span<const std::byte> packet) {
  const auto part = message_of<console::DocumentPart>(console::Kind::kDocumentPart, packet);
  const auto number = part ? static_cast<std::size_t>(part->document) : 0;
  if (number < 1 || number > parts_.size()) {
    return false;
  }
  switch (parts_[number - 1].add(*part)) {
    case console::DocumentAssembly::Outcome::kRefused:
      return false;
    case console::DocumentAssembly::Outcome::kMore:
      return true;
    case console::DocumentAssembly::Outcome::kWhole:
      break;
  }
  came_[number - 1] = true;
  auto bytes = std::make_shared<const std::string>(parts_[number - 1].take());
  KnownDocument& known = view_.documents[number - 1];
  if (known.bytes == nullptr || *known.bytes != *bytes) {
    known = {.revision = ++revisions_, .bytes = std::move(bytes)};
  }
  return true;
}

std::optional<std::uint32_t> ControllerLink::say(const Request& request, Instant now) {
  if (!socket_.valid()) {
    return std::nullopt;
  }
  const std::optional<std::string> packet = controller_message(request, said_ + 1);
  if (!packet) {
    return std::nullopt;
  }
  if (::send(socket_.get(), packet->data(), packet->size(), MSG_DONTWAIT | MSG_NOSIGNAL) !=
      static_cast<ssize_t>(packet->size())) {
    if (errno != EAGAIN) {
      disconnect("the controller does not listen any more", now);
    }
    return std::nullopt;
  }
  return ++said_;
}

}  // namespace ivo::firmware::web
