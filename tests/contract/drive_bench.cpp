#include "tests/contract/drive_bench.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/canopen/sdo_frame.hpp"
#include "drivers/cia402/controlword.hpp"
#include "drivers/cia402/mode.hpp"
#include "drivers/cia402/objects.hpp"

namespace ivo::contract {
namespace {

using drivers::NmtCommand;
using drivers::NmtState;
using drivers::ObjectAddress;
using drivers::cia402::PowerState;
using std::chrono::milliseconds;

constexpr Duration kPatience = std::chrono::seconds(10);  // for what must come; nobody measures how long it took
constexpr Duration kMoment = milliseconds(300);           // for what must not
constexpr Duration kStep = milliseconds(1);  // patience is counted in these: a machine that stands still has none
constexpr Duration kLook = milliseconds(5);  // or in these, where each costs an SDO transfer
constexpr Duration kBeat = milliseconds(20);
constexpr std::uint32_t kMasterTimeoutMs = 1000;

}  // namespace

void require(bool condition, const std::string& what) {
  if (!condition) {
    throw Broken(what);
  }
}

std::string hexadecimal(std::uint32_t value, int digits) {
  std::string text;
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) {
    text += "0123456789ABCDEF"[value >> shift & 0xF];
  }
  return text + "h";
}

std::string name_of(ObjectAddress object) {
  return hexadecimal(object.index, 4) + (object.sub != 0 ? ":" + std::to_string(object.sub) : "");
}

std::uint32_t Reply::number() const {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < bytes.size() && i < 4; ++i) {
    value |= std::uint32_t{bytes[i]} << (8 * i);
  }
  return value;
}

void DriveBench::send(const hal::CanFrame& frame) {
  require(drive_.bus.send({&frame, 1}, drive_.now()) == 1, "the bus took no frame");
}

void DriveBench::collect() {
  std::array<hal::ReceivedFrame, 64> frames;
  for (std::size_t count = frames.size(); count == frames.size();) {
    count = drive_.bus.receive(frames, drive_.now());
    for (std::size_t i = 0; i < count; ++i) {
      heard_.push_back(frames[i].frame);
    }
  }
}

void DriveBench::wait(Duration time) {
  const Instant end = drive_.now() + time;
  do {
    const Instant now = drive_.now();
    if (beating_ && now >= next_beat_.value_or(now)) {
      send(drivers::heartbeat_frame(master(), NmtState::kOperational));
      next_beat_ = now + kBeat;
    }
    drive_.pass(std::min<Duration>(kStep, std::max<Duration>(end - now, Duration(1))));
    collect();
  } while (drive_.now() < end);
}

bool DriveBench::heard(const std::function<bool(const hal::CanFrame&)>& fits) const {
  return std::any_of(heard_.begin(), heard_.end(), fits);
}

std::size_t DriveBench::count(std::uint16_t id) const {
  return static_cast<std::size_t>(
      std::count_if(heard_.begin(), heard_.end(), [id](const hal::CanFrame& frame) { return frame.id == id; }));
}

hal::CanFrame DriveBench::expect(const std::string& what, const std::function<bool(const hal::CanFrame&)>& fits) {
  for (auto left = kPatience / kStep; !heard(fits); --left) {
    require(left > 0, "no " + what + " came");
    wait(kStep);
  }
  return *std::find_if(heard_.begin(), heard_.end(), fits);
}

void DriveBench::nmt(NmtCommand command, std::uint8_t node) { send(drivers::nmt_frame({command, node})); }

void DriveBench::reset() {
  beating_ = false;
  wait(kStep);
  forget();
  nmt(NmtCommand::kResetNode);
  expect("boot-up message", [this](const hal::CanFrame& frame) {
    return frame.id == drivers::cob_id::heartbeat(node()) && frame.size == 1 && frame.data[0] == 0;
  });
  forget();
}

void DriveBench::watch_states() { must_write(drivers::object::kProducerHeartbeat, 2, 20); }

void DriveBench::expect_state(NmtState state) {
  forget();
  const hal::CanFrame expected = drivers::heartbeat_frame(node(), state);
  expect("heartbeat with state " + hexadecimal(expected.data[0], 2),
         [&](const hal::CanFrame& frame) { return frame == expected; });
}

std::optional<hal::CanFrame> DriveBench::answer() {
  const auto is_answer = [this](const hal::CanFrame& frame) { return frame.id == drivers::cob_id::sdo_answer(node()); };
  for (auto left = kMoment / kStep; left > 0 && !heard(is_answer); --left) {
    wait(kStep);
  }
  const auto at = std::find_if(heard_.begin(), heard_.end(), is_answer);
  if (at == heard_.end()) {
    return std::nullopt;
  }
  const hal::CanFrame found = *at;
  heard_.erase(at);
  require(found.size == 8, "an SDO answer has " + std::to_string(found.size) + " bytes; expected 8");
  return found;
}

std::optional<hal::CanFrame> DriveBench::ask(const hal::CanFrame& request) {
  std::erase_if(heard_, [this](const hal::CanFrame& frame) { return frame.id == drivers::cob_id::sdo_answer(node()); });
  send(request);
  return answer();
}

Reply DriveBench::read(ObjectAddress object) {
  const std::string name = name_of(object);
  const std::uint16_t id = drivers::cob_id::sdo_request(node());
  const auto first = ask(drivers::sdo_frame(id, {0x40, object, 0}));
  require(first.has_value(), "no answer to the upload of " + name);
  const drivers::SdoMessage message = *drivers::parse_sdo(*first);
  require(message.address == object, "the answer to the upload of " + name + " is of " + name_of(message.address));
  Reply reply;
  if (message.command == 0x80) {
    reply.abort = message.data;
    return reply;
  }
  require((message.command & 0xE0) == 0x40,
          "the upload of " + name + " is answered by " + hexadecimal(message.command, 2));
  if ((message.command & 0x02) != 0) {
    reply.bytes.assign(first->data.begin() + 4,
                       first->data.begin() + 4 + drivers::sdo_command::bytes_in(message.command).value_or(4));
    return reply;
  }
  for (std::uint8_t toggle = 0;; toggle ^= 0x10) {
    const auto segment = ask({.id = id, .size = 8, .data = {static_cast<std::uint8_t>(0x60 | toggle)}});
    require(segment.has_value(), "no answer to a segment of " + name);
    require((segment->data[0] & 0xF0) == toggle, "a segment of " + name + " begins with " +
                                                     hexadecimal(segment->data[0], 2) + "; expected toggle " +
                                                     hexadecimal(toggle, 2));
    const std::size_t bytes = 7U - (segment->data[0] >> 1 & 7U);
    reply.bytes.insert(reply.bytes.end(), segment->data.begin() + 1,
                       segment->data.begin() + 1 + static_cast<std::ptrdiff_t>(bytes));
    if ((segment->data[0] & 1) != 0) {
      require(
          (message.command & 1) == 0 || reply.bytes.size() == message.data,
          name + " has " + std::to_string(reply.bytes.size()) + " bytes; it announced " + std::to_string(message.data));
      return reply;
    }
  }
}

Reply DriveBench::write(ObjectAddress object, std::uint8_t bytes, std::uint32_t value) {
  const std::uint8_t command = drivers::sdo_command::expedited(drivers::sdo_command::kDownload, bytes);
  const auto answer = ask(drivers::sdo_frame(drivers::cob_id::sdo_request(node()), {command, object, value}));
  require(answer.has_value(), "no answer to the download of " + name_of(object));
  const drivers::SdoMessage message = *drivers::parse_sdo(*answer);
  require(message.address == object,
          "the answer to the download of " + name_of(object) + " is of " + name_of(message.address));
  require(message.command == 0x60 || message.command == 0x80,
          "the download of " + name_of(object) + " is answered by " + hexadecimal(message.command, 2));
  return {.bytes = {}, .abort = message.command == 0x80 ? message.data : 0};
}

Reply DriveBench::write_segments(ObjectAddress object, const std::vector<std::uint8_t>& data) {
  const std::uint16_t id = drivers::cob_id::sdo_request(node());
  auto answer = ask(drivers::sdo_frame(id, {0x21, object, static_cast<std::uint32_t>(data.size())}));
  require(answer.has_value(), "no answer to the download of " + name_of(object));
  std::uint8_t toggle = 0;
  for (std::size_t done = 0; answer->data[0] != 0x80;) {
    const std::size_t bytes = std::min<std::size_t>(7, data.size() - done);
    const bool last = done + bytes == data.size();
    hal::CanFrame segment{.id = id, .size = 8, .data = {}};
    segment.data[0] = static_cast<std::uint8_t>(toggle | (7 - bytes) << 1 | (last ? 1 : 0));
    std::copy_n(data.begin() + static_cast<std::ptrdiff_t>(done), bytes, segment.data.begin() + 1);
    answer = ask(segment);
    require(answer.has_value(), "no answer to a segment for " + name_of(object));
    if (answer->data[0] == 0x80) {
      break;
    }
    require(answer->data[0] == (0x20 | toggle),
            "a segment for " + name_of(object) + " is answered by " + hexadecimal(answer->data[0], 2));
    if (last) {
      return {};
    }
    done += bytes;
    toggle ^= 0x10;
  }
  return {.bytes = {}, .abort = drivers::parse_sdo(*answer)->data};
}

std::uint32_t DriveBench::must_read(ObjectAddress object) {
  const Reply reply = read(object);
  require(reply.abort == 0, "the upload of " + name_of(object) + " is aborted: " + hexadecimal(reply.abort, 8));
  return reply.number();
}

void DriveBench::must_write(ObjectAddress object, std::uint8_t bytes, std::uint32_t value) {
  const Reply reply = write(object, bytes, value);
  require(reply.abort == 0, "the download of " + hexadecimal(value, 8) + " to " + name_of(object) +
                                " is aborted: " + hexadecimal(reply.abort, 8));
}

void DriveBench::must_refuse(ObjectAddress object, std::uint8_t bytes, std::uint32_t value, std::uint32_t abort) {
  const Reply reply = write(object, bytes, value);
  require(reply.abort != 0,
          name_of(object) + " takes " + hexadecimal(value, 8) + "; expected abort " + hexadecimal(abort, 8));
  require(reply.abort == abort, name_of(object) + " refuses " + hexadecimal(value, 8) + " with abort " +
                                    hexadecimal(reply.abort, 8) + "; expected " + hexadecimal(abort, 8));
}

void DriveBench::control(std::uint16_t word) { must_write(drivers::object::kControlword, 2, word); }

std::uint16_t DriveBench::statusword() { return static_cast<std::uint16_t>(must_read(drivers::object::kStatusword)); }

void DriveBench::expect_power(PowerState state, const std::string& when) {
  const std::uint16_t bits = drivers::cia402::statusword_bits(state);
  std::uint16_t word = statusword();
  for (auto left = kPatience / kStep; drivers::cia402::power_state(word) != state && left > 0; --left) {
    wait(kStep);
    word = statusword();
  }
  require(drivers::cia402::power_state(word) == state,
          when + " the statusword is " + hexadecimal(word, 4) + "; expected the state of " + hexadecimal(bits, 4));
}

void DriveBench::bring_to(PowerState state) {
  const auto mode = drivers::cia402::velocity_mode(must_read(drivers::object::kSupportedModes));
  require(mode.has_value(), "6502h offers no velocity mode");
  must_write(drivers::object::kModeOfOperation, 1, static_cast<std::uint8_t>(*mode));
  must_write(drivers::object::kTargetVelocity, 4, 0);
  must_write(drivers::object::kConsumerHeartbeat, 4, std::uint32_t{master()} << 16 | kMasterTimeoutMs);
  watch_states();
  beat(true);
  nmt(NmtCommand::kStart);
  expect_state(NmtState::kOperational);
  expect_power(PowerState::kSwitchOnDisabled, "after a reset");
  namespace controlword = drivers::cia402::controlword;
  const std::pair<std::uint16_t, PowerState> way[] = {{controlword::kShutdown, PowerState::kReadyToSwitchOn},
                                                      {controlword::kSwitchOn, PowerState::kSwitchedOn},
                                                      {controlword::kEnableOperation, PowerState::kOperationEnabled}};
  for (const auto& [word, reached] : way) {
    if (state == PowerState::kSwitchOnDisabled) {
      return;
    }
    control(word);
    expect_power(reached, "after controlword " + hexadecimal(word, 4));
    if (reached == state) {
      return;
    }
  }
}

std::int32_t DriveBench::velocity() { return std::bit_cast<std::int32_t>(must_read(drivers::object::kVelocityActual)); }

void DriveBench::expect_rest(const std::string& when) {
  for (auto left = kPatience / kLook; std::abs(velocity()) > std::abs(speed()) / 20; --left) {
    require(left > 0, when + " the wheel still turns");
    wait(kLook);
  }
}

void DriveBench::turn() {
  must_write(drivers::object::kTargetVelocity, 4, std::bit_cast<std::uint32_t>(speed()));
  for (auto left = kPatience / kLook; std::abs(velocity() - speed()) > std::abs(speed()) / 10; --left) {
    require(left > 0, "606Ch does not get to the target velocity");
    wait(kLook);
  }
}

void DriveBench::bring_to_fault() {
  must_write(drivers::object::kAbortConnectionOption, 2, 1);
  bring_to(PowerState::kSwitchOnDisabled);
  wait(milliseconds(50));
  beat(false);
  expect_power(PowerState::kFault, "with 6007h 1 and without our heartbeat");
  beat(true);
  wait(milliseconds(50));
}

}  // namespace ivo::contract
