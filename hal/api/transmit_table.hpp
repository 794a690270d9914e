// What a bus was given to send and has not seen leave: the newest value of each COB-ID, and nothing old.
//
// A queue of the kernel or of a controller cannot be called back. So it never holds two frames of one COB-ID: a
// velocity waits here, where a newer one replaces it, until the one before has left. No sockets, no clock, no heap.
//
// The one that a queue already holds when nobody acknowledges any more cannot be called back either: it leaves when the
// cable is back, however old. Then the drives have missed our heartbeat and left Operational, where no RPDO acts
// (1029h:1, which start-up sees to); a cable that is back sooner brings one old command, and a stop behind it.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <span>

#include "config/base/static_vector.hpp"
#include "config/base/time.hpp"
#include "config/limits.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::hal {

/// One bit for each of the 2048 COB-IDs.
using IdSet = std::bitset<0x800>;

/// One send is: offer, hand the frames over in order, handed_over. NMT commands (COB-ID 0) are kept apart by node.
/// Each call costs at most frames x slots steps. About 20 KB.
class TransmitTable {
 public:
  static constexpr std::size_t kSlots = 128;  ///< COB-IDs that wait or are on their way at one time
  static constexpr std::size_t kBatch = limits::kFramesPerCycle;
  /// While nothing leaves, one frame is let through so often, of the least urgent COB-ID: to see whether that goes.
  static constexpr Duration kProbeEvery = std::chrono::seconds(1);

  struct Counters {
    std::uint64_t handed_over = 0;
    std::uint64_t confirmed = 0;  ///< of those, seen to leave; all, where no echo tells
    std::uint64_t replaced = 0;   ///< never handed over: a newer value came first
    std::uint64_t dropped = 0;    ///< never handed over: older than rates::kTransmitAge, forgotten, or no slot was free
    std::uint64_t echo_lost = 0;  ///< handed over and never seen, though later frames were
  };

  /// Frames of the COB-IDs in `echoed` come back by echo() when they leave; until then a frame is in flight. Those of
  /// other COB-IDs count as gone when handed over.
  explicit TransmitTable(const IdSet& echoed = {}) noexcept;

  /// What to hand over now, in order: of `given` what is not behind a frame in flight, then what is left over from
  /// earlier calls and not older than rates::kTransmitAge. Valid until the next call.
  [[nodiscard]] std::span<const CanFrame> offer(std::span<const CanFrame> given, Instant now) noexcept;

  /// The first `count` of what offer() returned were taken; the rest waits. How many of those were `given` then.
  std::size_t handed_over(std::size_t count, Instant now) noexcept;

  /// A frame of ours was seen to leave.
  void echo(const CanFrame& frame, Instant now) noexcept;

  /// After every echo that there is was told: judges what is overdue.
  void settle(Instant now) noexcept;

  /// What was handed over cannot be on its way any more, and what waits must not go: the bus was off or down.
  void forget() noexcept;

  /// Nothing has left for rates::kTransmitTimeout though something is in flight; until the next echo or forget().
  [[nodiscard]] bool unconfirmed() const noexcept { return unconfirmed_; }
  /// What the last handed_over() took, in order, given then or left over; none after forget(). Valid until the next
  /// offer().
  [[nodiscard]] std::span<const CanFrame> just_handed_over() const noexcept {
    return std::span(frames_).first(taken_of_batch_);
  }
  /// A frame with this COB-ID is among them.
  [[nodiscard]] bool just_handed_over(std::uint16_t id) const noexcept;
  [[nodiscard]] std::size_t waiting() const noexcept { return waiting_.size(); }
  [[nodiscard]] std::size_t in_flight() const noexcept { return in_flight_.size(); }
  [[nodiscard]] const Counters& counters() const noexcept { return counters_; }

 private:
  static constexpr std::uint8_t kNone = 0xFF;
  static constexpr std::size_t kKeys = 0x800 + 0x100;  // COB-IDs, then the nodes of NMT commands
  static_assert(kSlots < kNone);

  struct Entry {  // a frame and when it was given; of one COB-ID the larger order is the newer
    std::uint64_t order = 0;
    Instant given_at{};
    CanFrame frame;
  };
  struct Slot {
    Entry entry;  // what waits
    Instant handed_at{};
    std::uint16_t key = 0;
    bool waiting = false;
    bool offered = false;
    bool in_flight = false;
  };

  static std::uint16_t key_of(const CanFrame& frame) noexcept;
  static constexpr std::uint16_t id_of(std::uint16_t key) noexcept { return key < 0x800 ? key : 0; }
  [[nodiscard]] bool echoed(std::uint16_t key) const noexcept { return echoed_[id_of(key)]; }
  std::uint8_t obtain(std::uint16_t key) noexcept;
  void give_back_if_idle(std::uint8_t index) noexcept;
  void take(const CanFrame& frame, Instant now) noexcept;
  void offer_leftovers() noexcept;
  void wait(const Entry& entry) noexcept;
  void stop_waiting(std::uint8_t index) noexcept;
  void drop_old(Instant now) noexcept;
  void land(std::uint8_t index) noexcept;
  void give_up_overtaken(std::uint16_t key, Instant handed_at) noexcept;

  IdSet echoed_;
  Counters counters_;
  std::array<Slot, kSlots> slots_{};
  std::array<std::uint8_t, kKeys> slot_of_{};
  StaticVector<std::uint8_t, kSlots> free_;
  StaticVector<std::uint8_t, kSlots> waiting_;    // the longest waiting first
  StaticVector<std::uint8_t, kSlots> in_flight_;  // in no order
  StaticVector<Entry, kBatch> batch_;
  std::array<CanFrame, kBatch> frames_{};  // of batch_, as a span for the caller
  std::size_t given_in_batch_ = 0;
  std::size_t taken_of_batch_ = 0;
  std::uint64_t order_ = 0;
  Instant last_echo_{};
  Instant last_probe_{};
  bool unconfirmed_ = false;
};

}  // namespace ivo::hal
