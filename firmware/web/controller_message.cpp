#include "firmware/web/controller_message.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace ivo::firmware::web {
namespace {

using console::Kind;

template <class Message>
std::string packet_of(const Message& message) {
  const auto bytes = std::bit_cast<std::array<char, sizeof(Message)>>(message);
  return {bytes.begin(), bytes.end()};
}

/// One overload a request.
class ToPacket {
 public:
  explicit ToPacket(std::uint32_t sequence) : sequence_(sequence) {}
  using Packet = std::optional<std::string>;

  Packet operator()(const Beat&) const { return command(Kind::kBeat); }
  Packet operator()(const Stop&) const { return command(Kind::kPause); }
  Packet operator()(const End&) const { return command(Kind::kStop); }
  Packet operator()(const Init&) const { return command(Kind::kInit); }
  Packet operator()(const Replan& asked) const { return command(Kind::kReplan, asked.areas_revision); }
  Packet operator()(const Enough& asked) const { return command(Kind::kEnough, asked.plan); }
  Packet operator()(const Accept& asked) const { return command(Kind::kAccept, asked.plan); }
  Packet operator()(const Start& asked) const {
    constexpr std::uint32_t kWhileBeatsCome = 1;
    return command(Kind::kConsent, kWhileBeatsCome, asked.question);
  }
  Packet operator()(const ClearFault& asked) const { return command(Kind::kClearFault, 0, asked.question); }
  Packet operator()(const Found& asked) const { return command(Kind::kFound, asked.agent); }
  Packet operator()(const RemoveArea& asked) const { return command(Kind::kRemoveArea, asked.slot); }

  Packet operator()(const Position& asked) const {
    return packet_of(console::PoseCommand{.header = header<console::PoseCommand>(Kind::kPose),
                                          .agent = asked.agent,
                                          .x_m = asked.pose.x_m,
                                          .y_m = asked.pose.y_m,
                                          .heading_rad = asked.pose.heading_rad,
                                          .sigma_m = asked.sigma_m,
                                          .sigma_heading_rad = asked.sigma_heading_rad,
                                          .age_s = asked.age_s});
  }
  Packet operator()(const PutArea& asked) const {
    console::AreaCommand message{.header = header<console::AreaCommand>(Kind::kPutArea),
                                 .slot = asked.slot,
                                 .purpose = asked.purpose,
                                 .agent = asked.agent};
    const std::size_t corners = std::min(asked.polygon.size(), message.corner.size());
    message.corners = static_cast<std::uint8_t>(corners);
    for (std::size_t i = 0; i < corners; ++i) {
      message.corner[i] = {asked.polygon[i].x_m, asked.polygon[i].y_m};
    }
    return packet_of(message);
  }

  Packet operator()(const RequestControl&) const { return std::nullopt; }
  Packet operator()(const GiveControl&) const { return std::nullopt; }
  Packet operator()(const KeepControl&) const { return std::nullopt; }
  Packet operator()(const ReleaseControl&) const { return std::nullopt; }

 private:
  template <class Message>
  [[nodiscard]] console::Header header(Kind kind) const {
    return {.kind = kind, .size = sizeof(Message), .sequence = sequence_};
  }
  [[nodiscard]] Packet command(Kind kind, std::uint32_t argument = 0, std::uint32_t question = 0) const {
    return packet_of(
        console::Command{.header = header<console::Command>(kind), .question = question, .argument = argument});
  }

  std::uint32_t sequence_;
};

}  // namespace

std::optional<std::string> controller_message(const Request& request, std::uint32_t sequence) {
  return std::visit(ToPacket(sequence), request);
}

}  // namespace ivo::firmware::web
