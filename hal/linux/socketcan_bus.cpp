#include "hal/linux/socketcan_bus.hpp"

#include <linux/can.h>
#include <poll.h>
#include <sys/socket.h>
#include <time.h>

#include <algorithm>
#include <cerrno>
#include <optional>

#include "hal/linux/arrival_stamps.hpp"
#include "hal/linux/can_socket.hpp"
#include "hal/linux/interface_look.hpp"
#include "hal/linux/socket_handover.hpp"
#include "hal/linux/socket_messages.hpp"

namespace ivo::hal {
namespace {

enum class Link : std::uint8_t { kUp, kDown, kRemoved };

// Without system call: the kernel maps the clock into the process.
Duration wall_clock() noexcept {
  timespec t{};
  clock_gettime(CLOCK_REALTIME, &t);
  return std::chrono::seconds(t.tv_sec) + Duration(t.tv_nsec);
}

IdSet set_of(std::span<const std::uint16_t> ids) {
  IdSet set;
  for (const std::uint16_t id : ids) {
    set.set(id);
  }
  return ids.empty() ? set.set() : set;
}

}  // namespace

struct SocketCanBus::State {
  State(FileDescriptor opened, const IdSet& heard_ids, const IdSet& echoed)
      : socket(std::move(opened)), heard(heard_ids), table(echoed) {}

  void take_news() noexcept;
  void take_report(const LinkReport& report) noexcept;
  void take_error_frame(const can_frame& frame) noexcept;
  [[nodiscard]] bool take(ReceivedFrame& place, Instant now) noexcept;
  void note_lost(std::uint32_t lost_in_all) noexcept;
  void note_error(int error) noexcept;
  void set_link(Link now) noexcept;
  void set_controller(BusState now) noexcept;

  FileDescriptor socket;
  IdSet heard;
  TransmitTable table;
  ReceivedMessages in;
  SentMessages out;
  ArrivalStamps stamps;
  Link link = Link::kUp;
  BusState controller = BusState::kActive;
  std::uint64_t received = 0;
  std::uint64_t receive_dropped = 0;
  std::uint64_t refused = 0;  // frames given while there was no bus
  std::uint32_t lost_in_all = 0;
  bool drained = false;  // the last receive left nothing that had arrived
  Details details;
  InterfaceFacts facts;
  SocketHandover handover;
  std::optional<InterfaceLook> look;
};

Result<SocketCanBus> SocketCanBus::open(const std::string& name, const Options& options) {
  CanSocketOptions wanted{.ids = {options.ids.begin(), options.ids.end()}, .hear_own = options.confirm};
  wanted.receive_bytes = options.receive_bytes > 0 ? options.receive_bytes : wanted.receive_bytes;
  Result<CanSocket> opened = open_can_socket(name, wanted);
  if (!opened) {
    return opened.error();
  }
  LinkAnswer answer = ask_for_link(name);
  if (const Result<void> fits = check_bit_rate(answer.facts, options.bit_rate_bps); !fits) {
    return fits.error();
  }
  const IdSet heard = set_of(options.ids);
  auto state = std::make_unique<State>(std::move(opened.value().socket), heard, options.confirm ? heard : IdSet{});
  state->facts = std::move(answer.facts);
  state->look.emplace(name, wanted, opened.value().index, options.bit_rate_bps, state->handover);
  return SocketCanBus(std::move(state));
}

SocketCanBus::SocketCanBus(FileDescriptor socket)
    : state_(std::make_unique<State>(std::move(socket), set_of({}), IdSet{})) {}
SocketCanBus::SocketCanBus(std::unique_ptr<State> state) : state_(std::move(state)) {}
SocketCanBus::SocketCanBus(SocketCanBus&&) noexcept = default;
SocketCanBus& SocketCanBus::operator=(SocketCanBus&&) noexcept = default;
SocketCanBus::~SocketCanBus() = default;

std::size_t SocketCanBus::receive(std::span<ReceivedFrame> frames, Instant now) noexcept {
  State& s = *state_;
  s.take_news();
  s.stamps.begin(now, wall_clock(), !s.drained);
  std::size_t count = 0;
  bool fetched = false;
  while (count < frames.size()) {
    if (s.in.empty()) {
      if (fetched) {
        break;
      }
      fetched = true;
      s.note_error(s.in.fetch(s.socket.get()).error);
      continue;
    }
    count += s.take(frames[count], now) ? 1 : 0;
    s.in.pop();
  }
  s.drained = fetched && s.in.drained();
  if (s.drained) {
    s.table.settle(now);
  }
  s.received += count;
  return count;
}

/// The first message that is left, when it is a data frame of others; else it is seen to here.
bool SocketCanBus::State::take(ReceivedFrame& place, Instant now) noexcept {
  const ReceivedMessages::Notes notes = in.notes();
  if (notes.tells_lost) {
    note_lost(notes.lost);
  }
  const can_frame& raw = in.frame();
  if (!in.whole()) {
    ++details.malformed;
    return false;
  }
  if ((raw.can_id & CAN_ERR_FLAG) != 0) {
    take_error_frame(raw);
    return false;
  }
  const auto id = static_cast<std::uint16_t>(raw.can_id & CAN_SFF_MASK);
  if ((raw.can_id & (CAN_EFF_FLAG | CAN_RTR_FLAG)) != 0 || !heard[id]) {
    return false;
  }
  CanFrame frame{.id = id, .size = raw.can_dlc, .data = {}};
  std::copy_n(raw.data, frame.data.size(), frame.data.begin());
  if ((in.flags() & MSG_CONFIRM) != 0) {
    table.echo(frame, now);
    return false;
  }
  const bool this_host = (in.flags() & MSG_DONTROUTE) != 0;
  place = {
      .frame = frame, .at = stamps.at(notes.stamp), .origin = this_host ? FrameOrigin::kThisHost : FrameOrigin::kBus};
  return true;
}

std::size_t SocketCanBus::send(std::span<const CanFrame> frames, Instant now) noexcept {
  State& s = *state_;
  // What an interface takes while it is off would go out when it is back.
  if (s.link == Link::kRemoved || s.controller == BusState::kOff) {
    s.refused += frames.size();
    return 0;
  }
  const std::span<const CanFrame> batch = s.table.offer(frames, now);
  if (batch.empty()) {
    return 0;
  }
  const CallResult sent = s.out.send(s.socket.get(), batch);
  if (sent.count > 0 && s.link == Link::kDown) {
    s.handover.note_change();
    s.set_link(Link::kUp);  // forgets what was on its way before, and nothing of what is now
  }
  const std::size_t taken = s.table.handed_over(sent.count, now);
  if (sent.count < batch.size()) {
    ++s.details.queue_full;
    s.note_error(sent.error);
  }
  if (s.link != Link::kUp) {
    s.table.forget();
  }
  return taken;
}

std::span<const CanFrame> SocketCanBus::handed_over() const noexcept { return state_->table.just_handed_over(); }

BusState SocketCanBus::state() const noexcept {
  const State& s = *state_;
  if (s.link != Link::kUp) {
    return s.link == Link::kDown ? BusState::kDown : BusState::kRemoved;
  }
  return s.table.unconfirmed() ? std::max(s.controller, BusState::kUnconfirmed) : s.controller;
}

BusCounters SocketCanBus::counters() const noexcept {
  const State& s = *state_;
  const TransmitTable::Counters& sent = s.table.counters();
  return {.received = s.received,
          .sent = sent.handed_over,
          .confirmed = sent.confirmed,
          .send_dropped = sent.dropped + s.refused,
          .send_replaced = sent.replaced,
          .receive_dropped = s.receive_dropped + s.details.errors.receive_overflow};
}

SocketCanBus::Details SocketCanBus::details() const noexcept {
  Details details = state_->details;
  details.echo_lost = state_->table.counters().echo_lost;
  details.stamps_clamped = state_->stamps.clamped();
  return details;
}

bool SocketCanBus::just_sent(std::uint16_t id) const noexcept { return state_->table.just_handed_over(id); }

std::size_t SocketCanBus::in_flight() const noexcept { return state_->table.in_flight(); }

const InterfaceFacts& SocketCanBus::facts() const noexcept { return state_->facts; }

void SocketCanBus::look_at_interface() {
  if (state_->look) {
    state_->look->once();
  }
}

SocketCanBus::Woken SocketCanBus::wait(Duration limit) const noexcept {
  const Duration wait = std::max(limit, Duration::zero());
  const timespec timeout{.tv_sec = wait.count() / 1'000'000'000, .tv_nsec = wait.count() % 1'000'000'000};
  pollfd ready{.fd = state_->socket.get(), .events = POLLIN, .revents = 0};
  const int count = ppoll(&ready, 1, &timeout, nullptr);
  if (count > 0) {
    return Woken::kByFrame;
  }
  return count < 0 && errno == EINTR ? Woken::kBySignal : Woken::kByTime;
}

void SocketCanBus::State::take_news() noexcept {
  if (const int fresh = handover.take(); fresh >= 0) {
    handover.discard(socket.release());
    handover.note_change();  // what was seen before is of the old one
    socket = FileDescriptor(fresh);
    lost_in_all = 0;
    controller = BusState::kActive;
    link = Link::kUp;
    table.forget();
    ++details.reopened;
  }
  if (const std::optional<LinkReport> report = handover.take_report()) {
    take_report(*report);
  }
}

void SocketCanBus::State::take_report(const LinkReport& report) noexcept {
  if (!report.present) {
    set_link(Link::kRemoved);
    return;
  }
  if (link != Link::kRemoved) {  // a socket of a removed interface stays dead
    set_link(report.up ? Link::kUp : Link::kDown);
  }
  if (report.controller) {
    set_controller(*report.controller);
  }
  if (report.counts_errors) {
    details.errors.transmit_errors = report.transmit_errors;
    details.errors.receive_errors = report.receive_errors;
  }
}

void SocketCanBus::State::take_error_frame(const can_frame& frame) noexcept {
  count_error(frame, details.errors);
  if (const std::optional<BusState> told = state_told_by(frame)) {
    handover.note_change();
    set_controller(*told);
  }
}

void SocketCanBus::State::note_lost(std::uint32_t so_far) noexcept {
  receive_dropped += so_far - lost_in_all;
  lost_in_all = so_far;
}

void SocketCanBus::State::note_error(int error) noexcept {
  if ((error == ENODEV || error == ENXIO) && link != Link::kRemoved) {
    handover.note_change();
    set_link(Link::kRemoved);
  } else if (error == ENETDOWN && link == Link::kUp) {
    handover.note_change();
    set_link(Link::kDown);
  }
}

void SocketCanBus::State::set_link(Link now) noexcept {
  if (now == link) {
    return;
  }
  link = now;
  controller = BusState::kActive;
  table.forget();
}

void SocketCanBus::State::set_controller(BusState now) noexcept {
  if (now == controller) {
    return;
  }
  if (now == BusState::kOff || controller == BusState::kOff) {
    table.forget();
  }
  controller = now;
}

}  // namespace ivo::hal
