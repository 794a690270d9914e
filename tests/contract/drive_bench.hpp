// What a contract test does to a drive: frames in, frames out, time goes by. It looks at nothing else.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "config/base/time.hpp"
#include "drivers/canopen/nmt.hpp"
#include "drivers/canopen/object_address.hpp"
#include "drivers/cia402/statusword.hpp"
#include "hal/api/can_bus.hpp"

namespace ivo::contract {

/// The drive does not do what is expected of it.
struct Broken : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The drive does not have what this check is about, and need not.
struct NotThere : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct DriveUnderTest {
  hal::CanBus& bus;
  std::uint8_t node_id = 1;
  std::uint8_t master_node_id = 127;
  std::int32_t speed = 650;  ///< units of 60FFh: slow, but above what noise shows
  std::function<Instant()> now;
  std::function<void(Duration)> pass;  ///< at most so long goes by; a real bus returns early when a frame is there
};

/// Of an SDO transfer.
struct Reply {
  std::vector<std::uint8_t> bytes;
  std::uint32_t abort = 0;  ///< 0: none

  [[nodiscard]] std::uint32_t number() const;
};

class DriveBench {
 public:
  explicit DriveBench(DriveUnderTest drive) : drive_(std::move(drive)) {}

  [[nodiscard]] std::uint8_t node() const { return drive_.node_id; }
  [[nodiscard]] std::uint8_t master() const { return drive_.master_node_id; }
  [[nodiscard]] std::int32_t speed() const { return drive_.speed; }

  void send(const hal::CanFrame& frame);
  /// Lets time go by, and sends our heartbeat while it is wanted.
  void wait(Duration time);
  /// The first frame that fits, among those that came since forget(); waits for it. Broken when none comes.
  hal::CanFrame expect(const std::string& what, const std::function<bool(const hal::CanFrame&)>& fits);
  [[nodiscard]] bool heard(const std::function<bool(const hal::CanFrame&)>& fits) const;
  [[nodiscard]] std::size_t count(std::uint16_t id) const;
  void forget() { heard_.clear(); }
  void beat(bool wanted) { beating_ = wanted; }

  void nmt(drivers::NmtCommand command, std::uint8_t node);
  void nmt(drivers::NmtCommand command) { nmt(command, node()); }
  /// Reset node, boot-up message, and nothing left over from before.
  void reset();
  /// Heartbeats every 20 ms are switched on.
  void watch_states();
  void expect_state(drivers::NmtState state);

  Reply read(drivers::ObjectAddress object);
  /// Expedited, `bytes` long.
  Reply write(drivers::ObjectAddress object, std::uint8_t bytes, std::uint32_t value);
  /// In segments.
  Reply write_segments(drivers::ObjectAddress object, const std::vector<std::uint8_t>& data);
  /// One request as it is, and its answer; none when none comes within a moment.
  std::optional<hal::CanFrame> ask(const hal::CanFrame& request);
  [[nodiscard]] bool has(drivers::ObjectAddress object) { return read(object).abort == 0; }
  std::uint32_t must_read(drivers::ObjectAddress object);
  void must_write(drivers::ObjectAddress object, std::uint8_t bytes, std::uint32_t value);
  void must_refuse(drivers::ObjectAddress object, std::uint8_t bytes, std::uint32_t value, std::uint32_t abort);

  void control(std::uint16_t word);
  std::uint16_t statusword();
  drivers::cia402::PowerState power() { return drivers::cia402::power_state(statusword()); }
  void expect_power(drivers::cia402::PowerState state, const std::string& when);
  /// Operational, in a velocity mode, target 0, our heartbeat watched (1 s), power up to `state`.
  void bring_to(drivers::cia402::PowerState state);
  std::int32_t velocity();
  void expect_rest(const std::string& when);
  /// The wheel turns with speed().
  void turn();
  /// The drive is in Fault: by 6007h 1 and a heartbeat that stopped.
  void bring_to_fault();

 private:
  void collect();
  std::optional<hal::CanFrame> answer();

  DriveUnderTest drive_;
  std::vector<hal::CanFrame> heard_;
  bool beating_ = false;
  std::optional<Instant> next_beat_;
};

/// Broken, in the words of `what`, unless `condition`.
void require(bool condition, const std::string& what);
[[nodiscard]] std::string hexadecimal(std::uint32_t value, int digits);
[[nodiscard]] std::string name_of(drivers::ObjectAddress object);

}  // namespace ivo::contract
