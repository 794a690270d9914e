// Packets of any kind to a console's check and desk: only what is right in every field is heard, and it does no more
// than it says.
#include <array>
#include <chrono>
#include <cstring>
#include <optional>
#include <span>

#include "firmware/console/command_check.hpp"
#include "firmware/console/console_desk.hpp"
#include "tests/fuzz/input.hpp"

namespace {

using namespace ivo::firmware::console;
using ivo::fuzz::require;

struct Packet {
  std::array<std::byte, 64> bytes{};
  std::size_t size = 0;
};

/// Any bytes, or a command of which nothing or one field is wrong.
Packet packet(ivo::fuzz::Input& input, std::uint32_t next, std::uint32_t question) {
  Packet packet;
  if (input.up_to(4) == 0) {
    packet.size = input.up_to(static_cast<unsigned>(packet.bytes.size()));
    for (std::size_t i = 0; i < packet.size; ++i) {
      packet.bytes[i] = static_cast<std::byte>(input.byte());
    }
    return packet;
  }
  Command command{.header = {.kind = static_cast<Kind>(1 + input.up_to(4)), .size = sizeof(Command), .sequence = next},
                  .question = input.up_to(3) == 0 ? input.take<std::uint32_t>() : question};
  std::memcpy(packet.bytes.data(), &command, sizeof(command));
  packet.size = sizeof(command);
  if (input.up_to(2) == 0) {
    packet.bytes[input.up_to(sizeof(command) - 1)] ^= static_cast<std::byte>(input.byte());
  }
  return packet;
}

/// As the layout says it, read byte by byte.
bool right(const Packet& packet, std::uint32_t next) {
  const auto number = [&](std::size_t from, std::size_t bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) {
      value |= std::to_integer<std::uint32_t>(packet.bytes[from + i]) << (8 * i);
    }
    return value;
  };
  return packet.size == 24 && std::memcmp(packet.bytes.data(), "IVOC", 4) == 0 && number(4, 2) == 2 &&
         number(6, 2) >= 1 && number(6, 2) <= 5 && number(8, 4) == 24 && number(12, 4) == next && number(20, 4) == 0;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ivo::fuzz::Input input(data, size);
  int stops = 0;
  ConsoleDesk desk([&stops] { ++stops; });
  CommandCheck check;
  RateLimit::Clock::time_point now{std::chrono::seconds(1)};
  std::uint32_t next = 1;
  Asks asks = Asks::kNothing;
  bool answered = false;
  while (!input.empty()) {
    now += std::chrono::milliseconds(input.byte());
    if (input.up_to(3) == 0) {
      const auto now_asks = static_cast<Asks>(input.up_to(2));
      answered = answered && now_asks == asks;
      asks = now_asks;
      desk.show({}, asks);
    }
    const std::uint32_t question = desk.status().question;
    const Packet sent = packet(input, next, question);
    Command heard;
    const Verdict verdict = check.judge(std::span(sent.bytes).first(sent.size), sent.size, now, heard);
    const bool is_right = right(sent, next);
    require((verdict == Verdict::kAccepted || verdict == Verdict::kTooOften) == is_right,
            "only what is right is heard");
    next += is_right ? 1 : 0;
    const int before = stops;
    const Verdict done = verdict == Verdict::kAccepted ? desk.submit(heard) : verdict;
    const bool stop = verdict == Verdict::kAccepted && heard.header.kind == Kind::kStop;
    require(stops - before == (stop ? 1 : 0), "a stop stops once, and nothing else does");
    const std::optional<Kind> answer = desk.take(asks);
    if (answer) {
      require(done == Verdict::kAccepted && heard.header.kind == *answer, "an answer is what was said just now");
      require(asks != Asks::kNothing && heard.question == question && !answered, "a question has one answer, its own");
      require(*answer != Kind::kConsent || asks == Asks::kConsent, "nobody consents who is not asked");
      answered = true;
    }
  }
  return 0;
}
