// Packets of any kind to a console's check and desk: only what is right in every field is heard, and it does no more
// than it says.
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <variant>

#include "firmware/console/command_check.hpp"
#include "firmware/console/console_desk.hpp"
#include "tests/fuzz/input.hpp"

namespace {

using namespace ivo::firmware::console;
using ivo::fuzz::require;

struct Packet {
  std::array<std::byte, 1100> bytes{};
  std::size_t size = 0;
};

template <class Message>
void put(Packet& packet, const Message& message) {
  std::memcpy(packet.bytes.data(), &message, sizeof(message));
  packet.size = sizeof(message);
}

AreaCommand area(ivo::fuzz::Input& input) {
  AreaCommand area;
  area.slot = static_cast<std::uint8_t>(input.up_to(kAreaSlots));
  area.purpose = static_cast<AreaPurpose>(input.up_to(2));
  area.agent = input.up_to(3) == 0 ? AreaCommand::kEverybody : static_cast<std::uint8_t>(input.up_to(3));
  area.corners = static_cast<std::uint8_t>(input.up_to(7));
  for (std::size_t i = 0; i < area.corners; ++i) {
    area.corner[i] = {static_cast<double>(input.byte()) - 20, static_cast<double>(input.byte()) - 20};
  }
  return area;
}

PoseCommand pose(ivo::fuzz::Input& input) {
  PoseCommand pose;
  pose.agent = static_cast<std::uint8_t>(input.up_to(3));
  pose.x_m = static_cast<double>(input.byte()) - 20;
  pose.y_m = input.byte();
  pose.sigma_m = input.up_to(3) == 0 ? input.take<double>() : 0.5;
  pose.age_s = input.up_to(11);
  return pose;
}

/// Any bytes, or a message of which nothing or one field is wrong.
Packet packet(ivo::fuzz::Input& input, std::uint32_t next, std::uint32_t question) {
  Packet packet;
  const unsigned form = input.up_to(9);
  if (form == 0) {
    packet.size = input.up_to(100);
    for (std::size_t i = 0; i < packet.size; ++i) {
      packet.bytes[i] = static_cast<std::byte>(input.byte());
    }
    return packet;
  }
  if (form == 1) {
    AreaCommand said = area(input);
    said.header = {.kind = Kind::kPutArea, .size = sizeof(said), .sequence = next};
    put(packet, said);
  } else if (form == 2) {
    PoseCommand said = pose(input);
    said.header = {.kind = Kind::kPose, .size = sizeof(said), .sequence = next};
    put(packet, said);
  } else {
    const auto kind = static_cast<Kind>(1 + input.up_to(12));
    put(packet, Command{.header = {.kind = kind, .size = sizeof(Command), .sequence = next},
                        .question = input.up_to(3) == 0 ? input.take<std::uint32_t>() : question,
                        .argument = input.up_to(2) == 0 ? input.up_to(40) : 0});
  }
  if (input.up_to(2) == 0) {
    const unsigned last = static_cast<unsigned>(packet.size) - 1;
    packet.bytes[input.up_to(last < 255 ? last : 255)] ^= static_cast<std::byte>(input.byte());
  }
  return packet;
}

/// As the layout says it, read byte by byte.
class Layout {
 public:
  explicit Layout(const Packet& packet) : packet_(packet) {}

  bool right(std::uint32_t next) const {
    if (packet_.size < 16 || std::memcmp(packet_.bytes.data(), "IVOC", 4) != 0 || number(4, 2) != 3 ||
        number(8, 4) != packet_.size || number(12, 4) != next) {
      return false;
    }
    const std::uint32_t kind = number(6, 2);
    return kind == 14 ? area() : kind == 15 ? pose() : kind >= 1 && kind <= 13 && command(kind);
  }

 private:
  bool command(std::uint32_t kind) const {
    const std::uint32_t argument = number(20, 4);
    const bool any = kind == 8 || kind == 9 || kind == 10;
    const std::uint32_t most = kind == 2 ? 1 : kind == 11 ? 7 : kind == 13 ? 31 : 0;
    return packet_.size == 24 && (any || argument <= most);
  }
  bool area() const {
    if (packet_.size != 24 + 64 * 16) {
      return false;
    }
    const std::uint32_t purpose = number(17, 1);
    const std::uint32_t agent = number(18, 1);
    const std::uint32_t corners = number(19, 1);
    bool fits = number(16, 1) < 32 && purpose < 2 && (agent < 8 || (agent == 255 && purpose == 1)) && corners >= 3 &&
                corners <= 64 && number(20, 4) == 0;
    for (std::size_t i = 0; fits && i < 128; ++i) {
      const double value = real(24 + 8 * i);
      fits = i < 2 * corners ? std::abs(value) <= 1e6 : value == 0;
    }
    return fits;
  }
  bool pose() const {
    bool fits = packet_.size == 72 && number(16, 1) < 8;
    for (std::size_t i = 17; fits && i < 24; ++i) {
      fits = number(i, 1) == 0;
    }
    for (std::size_t at = 24; fits && at < 72; at += 8) {
      const double most = at == 64 ? 10 : 1e6;
      fits = real(at) <= most && real(at) >= (at < 48 ? -1e6 : 0);
    }
    return fits;
  }
  std::uint32_t number(std::size_t from, std::size_t bytes) const {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) {
      value |= std::to_integer<std::uint32_t>(packet_.bytes[from + i]) << (8 * i);
    }
    return value;
  }
  double real(std::size_t from) const {
    double value = 0;
    std::memcpy(&value, &packet_.bytes[from], sizeof(value));
    return value;
  }

  const Packet& packet_;
};

/// What is shown by turns: a search that goes on, in any mode.
Status status(ivo::fuzz::Input& input) {
  Status status;
  status.mode = static_cast<std::uint8_t>(input.up_to(7));
  status.agents = 2;
  status.plan_number = 1 + input.up_to(1);
  status.plan_ready = static_cast<std::uint8_t>(input.up_to(1));
  status.search_started = static_cast<std::uint8_t>(input.up_to(1));
  status.horizon_s = 10;
  return status;
}

std::optional<Kind> kind_of_command(const ClientMessage& message) {
  const Command* const command = std::get_if<Command>(&message);
  return command != nullptr ? std::optional(command->header.kind) : std::nullopt;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ivo::fuzz::Input input(data, size);
  int stops = 0;
  int pauses = 0;
  int beats = 0;
  ConsoleDesk desk({.agents = 2, .width_m = 100, .height_m = 80}, {false, true},
                   {.stop = [&] { ++stops; }, .pause = [&] { ++pauses; }, .beat = [&] { ++beats; }});
  CommandCheck check;
  RateLimit::Clock::time_point now{std::chrono::seconds(1)};
  std::uint32_t next = 1;
  std::uint32_t answered = 0;  // the last question that was
  bool wanted = false;         // another plan
  while (!input.empty()) {
    now += std::chrono::milliseconds(input.byte());
    if (input.up_to(3) == 0) {
      if (input.up_to(1) == 0) {
        (void)desk.requests();
        (void)desk.poses();
        wanted = false;
      }
      desk.show(status(input), static_cast<Asks>(input.up_to(2)));
    }
    const Status before = desk.status();
    require(!wanted || before.asks == Asks::kNothing, "nothing is asked while another plan is wanted");
    const Packet sent = packet(input, next, before.question);
    ClientMessage heard;
    const Verdict verdict = check.judge(std::span(sent.bytes).first(sent.size), sent.size, now, heard);
    const bool is_right = Layout(sent).right(next);
    require((verdict == Verdict::kAccepted || verdict == Verdict::kTooOften) == is_right,
            "only what is right is heard");
    next += is_right ? 1 : 0;
    const std::array<int, 3> counts{stops, pauses, beats};
    const Verdict done = verdict == Verdict::kAccepted ? desk.submit(heard) : verdict;
    const std::optional<Kind> kind = verdict == Verdict::kAccepted ? kind_of_command(heard) : std::nullopt;
    require(stops - counts[0] == (kind == Kind::kStop ? 1 : 0), "a stop stops once, and nothing else does");
    require(pauses - counts[1] == (kind == Kind::kPause ? 1 : 0), "a pause pauses once, and nothing else does");
    require(beats - counts[2] == (kind == Kind::kBeat ? 1 : 0), "a beat is a beat, and nothing else is");
    const bool wish = done == Verdict::kAccepted && (kind == Kind::kInit || kind == Kind::kReplan);
    require(!wish || (!wanted && desk.status().asks == Asks::kNothing && desk.status().accepted == 0),
            "who wants another plan has agreed to nothing");
    wanted = wanted || wish;
    if (const std::optional<DeskAnswer> answer = desk.take(before.asks)) {
      require(done == Verdict::kAccepted && kind == answer->kind, "an answer is what was said just now");
      const auto& command = std::get<Command>(heard);
      require(before.asks != Asks::kNothing && command.question == before.question && before.question != answered,
              "a question has one answer, its own");
      require(answer->kind != Kind::kConsent || before.asks == Asks::kConsent, "nobody consents who is not asked");
      require(answer->watched == (answer->kind == Kind::kConsent && command.argument == 1), "watched is what was said");
      answered = before.question;
    }
  }
  return 0;
}
