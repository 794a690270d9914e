// What goes over the console's socket: fixed-size messages, little-endian, one a packet. Everything that a process
// outside of the controller can say, and everything that it hears.
//
// A client sends a Command, an AreaCommand or a PoseCommand; its sequence number is 1 in the first and one more in each
// that follows. The controller sends an Answer to every message, a Status twenty times a second and, in parts, each
// document when it is new; statuses that a client is too slow for are dropped, documents wait for it.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace ivo::firmware::console {

inline constexpr std::uint32_t kMagic = 0x434F5649;  // the bytes "IVOC"
inline constexpr std::uint16_t kVersion = 3;         // of all that follows

enum class Kind : std::uint16_t {
  // From a client, as Command.
  kPing = 1,         ///< changes nothing
  kConsent = 2,      ///< to the plans of `question`: the robot moves. `argument` 1: only while kBeat goes on coming
  kNoConsent = 3,    ///< to whatever `question` asks: the run ends
  kStop = 4,         ///< the robot ramps down, the run ends; at any time, whatever `question` says, however often
  kClearFault = 5,   ///< start the drives up again, as `question` asks; nothing moves before consent anew
  kPause = 6,        ///< the robot ramps down and stands until consent anew; at any time, however often
  kInit = 7,         ///< plan anew without preferred areas
  kReplan = 8,       ///< plan anew with them; `argument`: Status::areas_revision that they were seen at
  kEnough = 9,       ///< take the best plan so far; `argument`: Status::plan_number
  kAccept = 10,      ///< the plan is good, but do not set off yet; `argument`: Status::plan_number
  kFound = 11,       ///< the object is found; `argument`: by which agent
  kBeat = 12,        ///< whoever agreed is still there
  kRemoveArea = 13,  ///< `argument`: slot
  // From a client, each of its own form.
  kPutArea = 14,  ///< AreaCommand
  kPose = 15,     ///< PoseCommand
  // From the controller.
  kAnswer = 101,
  kStatus = 102,
  kDocumentPart = 103,
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
  kOutOfRange,      ///< a number that is none, or that no mission has: an agent, a slot, a place off the map
  kNotNow,          ///< the robot is not in a state in which that can be done
  kOutdated,        ///< about a plan or areas that are not the newest any more
  kNotAnArea,       ///< fewer than three corners, or a border that crosses itself
};
inline constexpr int kVerdicts = 17;

/// What the controller asks now.
enum class Asks : std::uint8_t { kNothing, kConsent, kClearing };

inline constexpr int kClients = 4;
inline constexpr int kCommandsPerSecond = 100;  ///< of one client, and so many at once
inline constexpr int kStatusPerSecond = 20;     ///< to each client
inline constexpr int kAgents = 8;
inline constexpr int kAreaSlots = 32;
inline constexpr int kAreaCorners = 64;

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
  std::uint32_t argument = 0;  ///< as its Kind says; otherwise 0
};

struct Corner {
  double x_m = 0.0;
  double y_m = 0.0;
};

enum class AreaPurpose : std::uint8_t {
  kPreferred,  ///< where the agent would rather search
  kNoGo,       ///< where the agent may not be
};

/// An area is drawn, moved or resized. A slot that is taken is drawn anew.
struct AreaCommand {
  static constexpr std::uint8_t kEverybody = 255;

  Header header;
  std::uint8_t slot = 0;
  AreaPurpose purpose{};
  std::uint8_t agent = 0;    ///< index in the mission, or kEverybody for kNoGo
  std::uint8_t corners = 0;  ///< of a simple polygon, at least 3; the first is not repeated
  std::uint32_t zero = 0;
  std::array<Corner, kAreaCorners> corner{};  ///< the others are 0
};

/// Where an agent was seen: a person by a tap or a tracker, the robot by what knows its pose from outside.
struct PoseCommand {
  Header header;
  std::uint8_t agent = 0;
  std::array<std::uint8_t, 7> zero{};
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
  double sigma_m = 0.0;            ///< of x and y, at least 0
  double sigma_heading_rad = 0.0;  ///< at least 0
  double age_s = 0.0;              ///< when this was so, before now: 0 to 10
};

struct Answer {
  Header header;
  std::uint32_t of_sequence = 0;  ///< as it stood in the message; 0 where it was too short to have one
  Verdict verdict{};
  std::uint16_t zero = 0;
};

/// What the controller knows beyond its status; each has a revision that grows when it changes. Texts are JSON, UTF-8,
/// with names as the mission has them, metres, radians and seconds; grids go row by row, the southernmost first.
enum class Document : std::uint16_t {
  kMission = 1,   ///< text: name, map, cells, classes, agents. Does not change
  kMap,           ///< grid: a byte a pixel, its index in the mission's classes. Does not change
  kAerial,        ///< a PNG of the map's size in metres; empty: there is none. Does not change
  kProbability,   ///< grid: a float a cell, sum 1 over the map
  kSearched,      ///< grid: a bit a cell, lowest first, no padding at a row's end; 1: somebody has seen it
  kPlan,          ///< text: the best plan so far; empty before there is one
  kPreviousPlan,  ///< text: the one before it that was planned to its end; empty before there is one
  kAreas,         ///< text
  kNotice,        ///< text: what a plan was refused for, or what was done by the controller itself
  kReport,        ///< text: report.json; empty while the search goes on
};
inline constexpr int kDocuments = 10;
inline constexpr std::uint32_t kLargestDocument = 64U << 20U;  ///< bytes

/// A document comes in order, from byte 0 on; a part of another revision begins it anew.
struct DocumentPart {
  static constexpr std::size_t kBytes = 8192;

  Header header;
  Document document{};
  std::uint16_t zero = 0;
  std::uint32_t revision = 0;  ///< from 1
  std::uint32_t whole = 0;     ///< bytes of the document
  std::uint32_t from = 0;      ///< the first byte of this part
  std::uint32_t count = 0;     ///< bytes of it, at most kBytes; 0 of an empty document
  std::uint32_t zero_too = 0;
  std::array<std::byte, kBytes> bytes{};
};

struct AgentStatus {
  double x_m = 0.0;
  double y_m = 0.0;
  double moved_m = 0.0;          ///< since the search started
  double left_m = 0.0;           ///< of its path; 0 where nobody knows
  std::uint32_t path_ended = 0;  ///< 0 or 1
  std::uint32_t reported = 0;    ///< 1: its place comes from outside
  double report_age_s = -1.0;    ///< since it was last reported; negative: never
};

/// The enumerations are the controller's own: Mode, SearchState, StopCause, PauseCause, drivers::GroupState,
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

  // The dialogue.
  std::uint32_t plan_number = 0;      ///< of the plan that is made or was made last, from 1
  std::uint32_t areas_revision = 0;   ///< of the areas as they are drawn now
  std::uint8_t accepted = 0;          ///< somebody has accepted the plan `plan_number`
  std::uint8_t preparing = 0;         ///< tables for a plan are being made; it shows no progress yet
  std::uint8_t with_preferences = 0;  ///< the plan `plan_number` heeds preferred areas
  std::uint8_t pause_cause = 0;       ///< why it stands, or stood last
  std::uint8_t watched = 0;           ///< consent counts only while kBeat comes
  std::uint8_t fault_wheel = 0;       ///< config's Wheel; counts where fault_node_id is not 0
  std::uint8_t into_no_go = kNobody;  ///< agent whose way ahead leads into an area that is closed to it
  std::uint8_t plan_followed = 0;     ///< somebody has set off on the plan `plan_number`
  std::array<std::uint8_t, 8> zero{};
  double beat_age_s = -1.0;  ///< since the last kBeat; negative: never

  // The planner.
  std::int32_t generation = 0;
  std::int32_t generations = 0;
  double expected_time_s = 0.0;  ///< of the best plan so far, with the two below; 0 before there is one
  double unseen_mass = 0.0;
  double horizon_s = 0.0;

  std::int64_t search_time_ns = 0;
  double searched_mass = 0.0;  ///< probability of what somebody has seen, 0 to 1
  double heading_rad = 0.0;    ///< of the robot
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
static_assert(sizeof(Header) == 16 && sizeof(Command) == 24 && sizeof(Answer) == 24 && sizeof(AgentStatus) == 48);
static_assert(sizeof(AreaCommand) == 24 + 16 * kAreaCorners && sizeof(PoseCommand) == 72);
static_assert(sizeof(DocumentPart) == 40 + DocumentPart::kBytes);
static_assert(sizeof(Status) == 912);
static_assert(std::is_trivially_copyable_v<Command> && std::is_trivially_copyable_v<AreaCommand> &&
              std::is_trivially_copyable_v<PoseCommand> && std::is_trivially_copyable_v<Answer> &&
              std::is_trivially_copyable_v<Status> && std::is_trivially_copyable_v<DocumentPart>);

}  // namespace ivo::firmware::console
