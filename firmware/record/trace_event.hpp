// What a cycle did and how long it took, as fixed-size events: the loop writes them into a ring, a writer outside the
// loop makes files and figures of them.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>

#include "config/base/spsc_ring.hpp"
#include "config/base/time.hpp"

namespace ivo::firmware {

/// Of each kind: what `code` and `id` are, and which of the types below the payload is.
enum class TraceKind : std::uint8_t {
  kCycleBegan,  ///< TracedCycle
  kCycleEnded,  ///< lasted; TracedWork
  kPhase,       ///< lasted; code: Phase
  kSlice,       ///< lasted; code: planner::SliceKind; TracedWork
  kFrameIn,     ///< lasted: how long ago it arrived; code: bytes of data; id: COB-ID; TracedFrame
  kFrameOut,    ///< code: bytes of data; id: COB-ID; TracedFrame
  kMode,        ///< code: Mode entered
  kFault,       ///< code: DriveFaultReason; id: wheel; TracedFault
  kBusState,    ///< code: hal::BusState
  kPose,        ///< id: agent; TracedPose
  kCommand,     ///< TracedTwist: what went out to the wheels
  kToldWheels,  ///< TracedWheels: rad/s
  kWheelAngles  ///< TracedWheels: rad
};

struct TracedCycle {
  std::int64_t loop_ns = 0;     ///< the loop's time; `at` is the stopwatch's
  std::int64_t latency_ns = 0;  ///< from when the cycle was due to when it began
  std::int64_t skipped = 0;     ///< periods lost before it
};
struct TracedWork {
  std::int64_t units = 0;  ///< of planner work (planner/search/search.hpp)
  std::int64_t moves = 0;  ///< of ants, and changes of a route that were tried
  std::int64_t unused = 0;
};
struct TracedFrame {
  std::array<std::uint8_t, 8> data{};
  std::array<std::int64_t, 2> unused{};
};
struct TracedFault {
  std::int64_t node_id = 0;  ///< 0: of no drive
  std::int64_t code = 0;     ///< as the reason has it
  std::int64_t unused = 0;
};
struct TracedPose {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
};
struct TracedTwist {
  double vx_mps = 0.0;
  double vy_mps = 0.0;
  double wz_radps = 0.0;
};
struct TracedWheels {
  std::array<float, 4> wheels{};  ///< in the order of Wheel
  std::int64_t unused = 0;
};

struct TraceEvent {
  Instant at{};                 ///< on the stopwatch, which is the machine's own time, whatever the loop's is
  std::uint32_t lasted_ns = 0;  ///< longer ones say 4.29 s
  TraceKind kind = TraceKind::kCycleBegan;
  std::uint8_t code = 0;
  std::uint16_t id = 0;
  std::array<std::int64_t, 3> payload{};

  template <class Payload>
  void put(const Payload& value) noexcept {
    payload = std::bit_cast<std::array<std::int64_t, 3>>(value);
  }
  template <class Payload>
  [[nodiscard]] Payload get() const noexcept {
    return std::bit_cast<Payload>(payload);
  }
};
static_assert(sizeof(TraceEvent) == 40 && std::is_trivially_copyable_v<TraceEvent>);

/// 2.6 MB: some 2000 cycles. What does not fit is lost and counted.
inline constexpr std::size_t kTracedEvents = 65'536;
using TraceRing = SpscRing<TraceEvent, kTracedEvents>;

}  // namespace ivo::firmware
