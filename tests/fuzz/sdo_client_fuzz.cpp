// One SDO transfer after the other, with any answers at any time.
#include <algorithm>
#include <array>
#include <chrono>

#include "config/rates.hpp"
#include "drivers/canopen/sdo_client.hpp"
#include "tests/fuzz/input.hpp"

namespace {

using namespace ivo;
using drivers::SdoStatus;
using fuzz::require;

constexpr std::uint8_t kNode = 5;

bool over(const drivers::SdoClient& client) {
  return client.status() != SdoStatus::kBusy && client.status() != SdoStatus::kIdle;
}

/// All that it wants to send now.
int drain(drivers::SdoClient& client, Instant now) {
  int sent = 0;
  while (const auto frame = client.poll(now)) {
    require(frame->size == 8, "a request has eight bytes");
    require(frame->id == 0x600 + kNode, "a request goes to its node");
    require(++sent <= 3, "one poll does not send without end");
  }
  return sent;
}

void begin(drivers::SdoClient& client, fuzz::Input& input) {
  const drivers::ObjectAddress address{input.take<std::uint16_t>(), input.byte()};
  const auto bytes = static_cast<std::uint8_t>(1 + input.up_to(3));
  switch (input.up_to(3)) {
    case 0:
      client.start_upload(address, bytes);
      break;
    case 1:
      client.start_download(address, bytes, input.take<std::uint32_t>());
      break;
    case 2:
      client.start_upload(address);
      break;
    default: {
      std::array<std::uint8_t, drivers::SdoClient::kMostBytes> room{};
      const auto data = std::span(room).first(input.up_to(room.size()));
      std::ranges::generate(data, [&input] { return input.byte(); });
      client.start_download(address, data);
      break;
    }
  }
}

/// An answer that a node might give: any bytes, or the right address with any command.
hal::CanFrame answer(fuzz::Input& input, const hal::CanFrame& request) {
  hal::CanFrame frame = input.frame(0x580 + kNode);
  if (input.up_to(2) != 0) {
    frame.size = 8;
    for (std::size_t i = 1; i < 4; ++i) {
      frame.data[i] = request.data[i];
    }
  }
  return frame;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  drivers::SdoClient client(kNode);
  Instant now{};
  hal::CanFrame request{};
  while (!input.empty()) {
    switch (input.up_to(3)) {
      case 0:
        begin(client, input);
        break;
      case 1:
        client.on_frame(answer(input, request));
        break;
      case 2:
        now += Duration(input.take<std::uint32_t>() % 1'000'000'000);
        [[fallthrough]];
      default:
        if (const auto sent = client.poll(now)) {
          require(sent->size == 8 && sent->id == 0x600 + kNode, "a request has eight bytes and goes to its node");
          request = *sent;
        }
        break;
    }
    require(client.bytes().size() <= drivers::SdoClient::kMostBytes, "a transfer has no more bytes than it may");
    require(client.text().size() <= client.bytes().size(), "a text is some of the bytes");
    require(client.text().find('\0') == std::string_view::npos, "a text has no NUL");
  }
  // Left alone it ends by itself, and then it is quiet.
  if (client.status() == SdoStatus::kBusy) {
    for (int i = 0; i <= 2 * rates::kSdoAttempts + 2; ++i) {
      (void)drain(client, now);
      now += rates::kSdoTimeout;
    }
    require(over(client), "a transfer ends without an answer");
  }
  (void)drain(client, now);
  require(drain(client, now + std::chrono::hours(1)) == 0, "what is over sends nothing");
  return 0;
}
