// What goes over the console's socket: fixed-size messages, little-endian, one a packet. Everything that a process
// outside of the controller can say, and everything that it hears.
//
// A client sends Command only; its sequence number is 1 in the first and one more in each that follows. The controller
// sends an Answer to every message and a Status ten times a second; those that a client is too slow for are dropped.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>

namespace ivo::firmware::console {

inline constexpr std::uint32_t kMagic = 0x434F5649;  // the bytes "IVOC"
inline constexpr std::uint16_t kVersion = 2;         // of all that follows

enum class Kind : std::uint16_t {
  // From a client.
  kPing = 1,        ///< changes nothing
  kConsent = 2,     ///< to the plans of `question`: the robot moves
  kNoConsent = 3,   ///< to whatever `question` asks: the run ends
  kStop = 4,        ///< the robot ramps down, the run ends; at any time, whatever `question` says, however often
  kClearFault = 5,  ///< start the drives up again, as `question` asks; nothing moves before consent anew
  // From the controller.
  kAnswer = 101,
  kStatus = 102,
};

/// Why a message counts for nothing. Each is counted.
enum class Verdict : std::uint16_t {
  kAccepted,
  kWrongSize,       ///< of the packet, or as the message itself says
  kWrongMagic,      //
  kWrongVersion,    //
  kUnknownKind,     ///< or one that only the controller sends
  kNotZero,         ///< a field that is to be 0 is not
  kReplayed,        ///< a sequence number that was there before
  kOutOfOrder,      ///< a sequence number too far on
  kTooOften,        ///< more than kCommandsPerSecond
  kNotAsked,        ///< nobody asks for that now
  kOtherQuestion,   ///< an answer to a question that is not asked any more, or not yet
  kAnswered,        ///< somebody else was first
  kTooManyClients,  ///< kClients are there already; the connection is closed
};
inline constexpr int kVerdicts = 13;

/// What the controller asks now.
enum class Asks : std::uint8_t { kNothing, kConsent, kClearing };

inline constexpr int kClients = 4;
inline constexpr int kCommandsPerSecond = 50;  ///< of one client, and so many at once
inline constexpr int kStatusPerSecond = 10;    ///< to each client
inline constexpr int kAgents = 8;

struct Header {
  std::uint32_t magic = kMagic;
  std::uint16_t version = kVersion;
  Kind kind{};
  std::uint32_t size = 0;      ///< of the whole message, bytes
  std::uint32_t sequence = 0;  ///< of this sender on this connection, from 1
};

struct Command {
  Header header;
  std::uint32_t question = 0;  ///< as a Status said it: what was agreed to is what was shown
  std::uint32_t zero = 0;
};

struct Answer {
  Header header;
  std::uint32_t of_sequence = 0;  ///< as it stood in the message; 0 where it was too short to have one
  Verdict verdict{};
  std::uint16_t zero = 0;
};

struct AgentStatus {
  double x_m = 0.0;
  double y_m = 0.0;
  double moved_m = 0.0;          ///< since the search started
  std::uint32_t path_ended = 0;  ///< 0 or 1
  std::uint32_t zero = 0;
};

/// The enumerations are the controller's own: Mode, SearchState, StopCause, drivers::GroupState,
/// drivers::DriveFaultReason, hal::BusState.
struct Status {
  Header header;
  std::int64_t at_ns = 0;      ///< on the loop's clock
  std::uint32_t question = 0;  ///< of `asks`; grows with each new one, 0 before the first
  Asks asks{};
  std::uint8_t mode = 0;
  std::uint8_t search = 0;
  std::uint8_t drives = 0;
  std::uint8_t stop_cause = 0;
  std::uint8_t plan_ready = 0;
  std::uint8_t search_started = 0;
  std::uint8_t power_off = 0;
  std::uint8_t finished = 0;
  std::uint8_t finder = kNobody;  ///< agent
  std::uint8_t bus_state = 0;
  std::uint8_t agents = 0;  ///< how many of `agent` count; the robot is the first
  std::uint8_t fault_reason = 0;
  std::uint8_t fault_node_id = 0;
  std::uint8_t fault_turning_node_id = 0;  ///< a wheel that has not stopped; 0: none
  std::uint8_t stop_held = 0;              ///< a stop input is pressed
  std::uint32_t fault_code = 0;

  // The planner.
  std::int32_t generation = 0;
  std::int32_t generations = 0;
  double expected_time_s = 0.0;  ///< of the best plan so far, with the two below; 0 before there is one
  double unseen_mass = 0.0;
  double horizon_s = 0.0;

  std::int64_t search_time_ns = 0;
  double heading_rad = 0.0;  ///< of the robot
  std::array<AgentStatus, kAgents> agent{};

  std::array<char, 160> fault{};  ///< the fault or the pressed input in words, UTF-8, 0 at its end; empty: none

  // Counters of the loop.
  std::uint64_t cycles = 0;
  std::uint64_t skipped = 0;
  std::uint64_t refused_commands = 0;
  std::uint64_t refused_frames = 0;
  std::uint64_t malformed_frames = 0;
  std::uint64_t frames_sent = 0;
  std::uint64_t frames_received = 0;
  std::uint64_t send_dropped = 0;
  std::uint64_t receive_dropped = 0;

  // Counters of the socket, of all its clients.
  std::array<std::uint64_t, kVerdicts> messages{};  ///< by Verdict
  std::uint64_t answers_dropped = 0;                ///< a client did not read
  std::uint64_t statuses_dropped = 0;
  std::uint32_t clients = 0;
  std::uint32_t taken_up = 0;  ///< 1: a search that was cut off, and nobody has agreed to go on: `agent` is assumed

  static constexpr std::uint8_t kNobody = 255;
};

// The layout is what other programs read: a change of it is a new kVersion.
static_assert(std::endian::native == std::endian::little, "messages are little-endian");
static_assert(sizeof(Header) == 16 && sizeof(Command) == 24 && sizeof(Answer) == 24 && sizeof(AgentStatus) == 32);
static_assert(sizeof(Status) == 712);
static_assert(std::is_trivially_copyable_v<Command> && std::is_trivially_copyable_v<Answer> &&
              std::is_trivially_copyable_v<Status>);

}  // namespace ivo::firmware::console
