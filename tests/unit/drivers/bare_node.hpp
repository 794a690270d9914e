// A node of an object dictionary and little else, whose SDO server can be told to be odd in every way. It knows the
// power state machine, but turns no wheel.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "config/base/time.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/emcy.hpp"
#include "drivers/canopen/nmt.hpp"
#include "drivers/canopen/pdo.hpp"
#include "drivers/canopen/sdo_abort.hpp"
#include "drivers/canopen/sdo_segment.hpp"
#include "drivers/sim/sim_power.hpp"

namespace ivo::drivers {

class BareNode {
 public:
  enum class Answers : std::uint8_t {
    kExpedited,        // with the object's size
    kFourBytes,        // 43h to everything
    kNoSize,           // 42h to everything
    kSegments,         // 41h and one segment
    kSegmentsNoSize,   // 40h and one segment
    kSegmentsOfAByte,  // 41h and a segment a byte
  };
  using Key = std::pair<std::uint16_t, std::uint8_t>;
  struct Object {
    std::uint8_t bytes = 4;
    std::uint32_t value = 0;
  };

  explicit BareNode(std::uint8_t node_id) : node_id_(node_id) { define(); }

  // What it does oddly.
  Answers answers = Answers::kExpedited;
  Duration delay{};                        // of every answer
  std::map<Key, SdoAbort> refused_writes;  // these objects cannot be written
  std::map<Key, SdoAbort> refused_reads;
  std::map<Key, std::uint32_t> stuck;  // writes are confirmed and change nothing
  bool fixed_mapping = false;          // 1600h to 1603h and 1A00h to 1A03h are read-only
  bool dummies = true;                 // 0002h to 0007h can be mapped
  bool answers_nothing = false;
  std::function<std::vector<hal::CanFrame>(const hal::CanFrame& request)> before;  // sent before each SDO answer
  int boot_ups = 1;                                                                // after each reset, 30 ms apart

  std::map<Key, Object> objects;
  std::vector<SdoMessage> writes;         // all that were taken
  std::vector<SdoAbort> aborts_received;  // from the client
  NmtState nmt = NmtState::kPreOperational;
  SimPower power;
  std::map<std::uint16_t, hal::CanFrame> rpdos;  // the last of each COB-ID since the last SYNC
  std::int32_t target = 0;                       // 60FFh, by PDO

  [[nodiscard]] std::uint8_t node_id() const { return node_id_; }
  [[nodiscard]] std::uint32_t get(std::uint16_t index, std::uint8_t sub) const {
    return objects.at({index, sub}).value;
  }
  void set(std::uint16_t index, std::uint8_t sub, std::uint8_t bytes, std::uint32_t value) {
    objects[{index, sub}] = {bytes, value};
  }
  void remove(std::uint16_t index) {
    std::erase_if(objects, [index](const auto& entry) { return entry.first.first == index; });
  }
  void remove(std::uint16_t index, std::uint8_t sub) { objects.erase({index, sub}); }

  /// Power on, or as if it were.
  void boot(Instant now) {
    nmt = NmtState::kPreOperational;
    server_ = {};
    for (int i = 0; i < boot_ups; ++i) {
      say(now + i * std::chrono::milliseconds(30), heartbeat_frame(node_id_, NmtState::kBootUp));
    }
  }

  void on_frame(const hal::CanFrame& frame, Instant now) {
    if (const auto order = parse_nmt(frame)) {
      if (order->node_id == node_id_ || order->node_id == 0) {
        on_nmt(order->command, now);
      }
    } else if (frame.id == cob_id::sdo_request(node_id_) && !answers_nothing) {
      on_sdo(frame, now);
    } else if (frame.id == cob_id::kSync && nmt == NmtState::kOperational) {
      on_sync(now);
    } else if (is_rpdo(frame.id) && nmt == NmtState::kOperational) {
      rpdos[frame.id] = frame;
    }
  }

  /// What it sends until `now`, in order.
  std::vector<hal::CanFrame> update(Instant now) {
    if (nmt == NmtState::kOperational && get(0x1017, 0) != 0 && now >= next_heartbeat_) {
      next_heartbeat_ = now + std::chrono::milliseconds(get(0x1017, 0));
      say(now, heartbeat_frame(node_id_, nmt));
    }
    std::vector<hal::CanFrame> due;
    for (auto frame = outbox_.begin(); frame != outbox_.end();) {
      if (frame->first <= now) {
        due.push_back(frame->second);
        frame = outbox_.erase(frame);
      } else {
        ++frame;
      }
    }
    return due;
  }

 private:
  struct Server {
    std::vector<std::uint8_t> rest;  // of an upload in segments
    bool open = false;
    bool toggle = false;
  };

  void define() {
    for (const auto& [key, object] : std::map<Key, Object>{
             {{0x1000, 0}, {4, 0x00020192}}, {{0x1005, 0}, {4, 0x80}},   {{0x1006, 0}, {4, 0}},
             {{0x1016, 1}, {4, 0}},          {{0x1017, 0}, {2, 0}},      {{0x1018, 1}, {4, 0x111}},
             {{0x1018, 2}, {4, 0x222}},      {{0x1018, 3}, {4, 0x333}},  {{0x1018, 4}, {4, 0x444}},
             {{0x6007, 0}, {2, 1}},          {{0x6040, 0}, {2, 0}},      {{0x6041, 0}, {2, 0x40}},
             {{0x605A, 0}, {2, 2}},          {{0x605B, 0}, {2, 0}},      {{0x605C, 0}, {2, 1}},
             {{0x605D, 0}, {2, 1}},          {{0x605E, 0}, {2, 2}},      {{0x6060, 0}, {1, 0}},
             {{0x6061, 0}, {1, 0}},          {{0x6064, 0}, {4, 0}},      {{0x6083, 0}, {4, 100}},
             {{0x6084, 0}, {4, 100}},        {{0x6085, 0}, {4, 100}},    {{0x60C2, 1}, {1, 1}},
             {{0x60C2, 2}, {1, 0xFD}},       {{0x60FF, 0}, {4, 0x7777}}, {{0x6502, 0}, {4, 0x104}},
         }) {
      objects[key] = object;
    }
    define_pdos();
  }

  /// The default set of CiA 402: RPDO4 and TPDO3 are what a wheel needs.
  void define_pdos() {
    constexpr std::uint32_t kControlword = 0x60400010;
    constexpr std::uint32_t kStatusword = 0x60410010;
    const std::array<std::uint32_t, 4> received{0, 0x60600008, 0x607A0020, 0x60FF0020};
    const std::array<std::uint32_t, 4> transmitted{0, 0x60610008, 0x60640020, 0x606C0020};
    for (std::uint8_t k = 0; k < 4; ++k) {
      const auto number = static_cast<std::uint8_t>(k + 1);
      const auto index = [k](int first) { return static_cast<std::uint16_t>(first + k); };
      set(index(0x1400), 1, 4, cob_id::rpdo(number, node_id_));
      set(index(0x1400), 2, 1, 255);
      set(index(0x1400), 5, 2, 0);
      set(index(0x1600), 0, 1, k == 0 ? 1 : 2);
      set(index(0x1600), 1, 4, kControlword);
      set(index(0x1600), 2, 4, received[k]);
      set(index(0x1800), 1, 4, cob_id::tpdo(number, node_id_) | cob_id::kPdoNoRemote);
      set(index(0x1800), 2, 1, 255);
      set(index(0x1A00), 0, 1, k == 0 ? 1 : 2);
      set(index(0x1A00), 1, 4, kStatusword);
      set(index(0x1A00), 2, 4, transmitted[k]);
    }
  }

  void say(Instant at, const hal::CanFrame& frame) { outbox_.emplace_back(at, frame); }

  void on_nmt(NmtCommand command, Instant now) {
    if (command == NmtCommand::kResetNode || command == NmtCommand::kResetCommunication) {
      boot(now);
    } else if (command == NmtCommand::kStart) {
      nmt = NmtState::kOperational;
      next_heartbeat_ = now + std::chrono::milliseconds(get(0x1017, 0));
      say(now, heartbeat_frame(node_id_, nmt));
    }
  }

  void on_sdo(const hal::CanFrame& frame, Instant now) {
    const std::uint16_t id = cob_id::sdo_answer(node_id_);
    const SdoMessage request = *parse_sdo(frame);
    const std::uint8_t service = request.command & sdo_command::kServiceMask;
    if (service == sdo_command::kAbort) {
      aborts_received.push_back(SdoAbort{request.data});
      server_ = {};
      return;
    }
    if (before) {
      for (const hal::CanFrame& odd : before(frame)) {
        say(now + delay, odd);
      }
    }
    const auto abort = [&](SdoAbort code) {
      say(now + delay, sdo_frame(id, {sdo_command::kAbort, request.address, static_cast<std::uint32_t>(code)}));
    };
    if (service == sdo_command::kUploadSegment) {
      if (!server_.open) {
        return abort(SdoAbort::kCommandSpecifier);
      }
      const bool toggle = (request.command & sdo_command::kToggle) != 0;
      return toggle == server_.toggle ? say(now + delay, next_segment()) : abort(SdoAbort::kToggle);
    }
    const Key key{request.address.index, request.address.sub};
    const auto object = objects.find(key);
    const auto& refused = service == sdo_command::kUpload ? refused_reads : refused_writes;
    if (const auto refusal = refused.find(key); refusal != refused.end()) {
      return abort(refusal->second);
    }
    if (object == objects.end()) {
      return abort(SdoAbort::kNoObject);
    }
    if (service == sdo_command::kUpload) {
      return say(now + delay, upload(request.address, object->second));
    }
    if (const auto refusal = refusal_of_mapping(key, request.data)) {
      return abort(*refusal);
    }
    writes.push_back(request);
    if (!stuck.contains(key)) {
      object->second.value = request.data;
    }
    if (key == Key{0x6060, 0}) {
      objects[{0x6061, 0}].value = request.data;
    } else if (key == Key{0x6040, 0}) {
      power.command(static_cast<std::uint16_t>(request.data));
    }
    say(now + delay, sdo_frame(id, {sdo_command::kDownloaded, request.address, 0}));
  }

  [[nodiscard]] std::optional<SdoAbort> refusal_of_mapping(const Key& key, std::uint32_t value) const {
    const bool mapping = (key.first & 0xFFFC) == 0x1600 || (key.first & 0xFFFC) == 0x1A00;
    if (!mapping) {
      return std::nullopt;
    }
    if (fixed_mapping) {
      return SdoAbort::kReadOnly;
    }
    const bool dummy = key.second != 0 && value >> 16 <= 7 && value != 0;
    if (dummy && !dummies) {
      return SdoAbort::kNotMappable;
    }
    const auto pdo = static_cast<std::uint16_t>(key.first - 0x200);
    const bool valid = (get(pdo, 1) & cob_id::kPdoInvalid) == 0;
    return valid || (key.second != 0 && get(key.first, 0) != 0) ? std::optional(SdoAbort::kAccess) : std::nullopt;
  }

  hal::CanFrame upload(ObjectAddress address, const Object& object) {
    const std::uint16_t id = cob_id::sdo_answer(node_id_);
    const auto stuck_value = stuck.find({address.index, address.sub});
    const std::uint32_t value = stuck_value == stuck.end() ? object.value : stuck_value->second;
    switch (answers) {
      case Answers::kExpedited:
        return sdo_frame(id, {sdo_command::expedited(sdo_command::kUpload, object.bytes), address, value});
      case Answers::kFourBytes:
        return sdo_frame(id, {0x43, address, value});
      case Answers::kNoSize:
        return sdo_frame(id, {0x42, address, value});
      case Answers::kSegments:
      case Answers::kSegmentsNoSize:
      case Answers::kSegmentsOfAByte:
        break;
    }
    server_ = {};
    server_.open = true;
    for (std::uint8_t i = 0; i < object.bytes; ++i) {
      server_.rest.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    }
    const bool size = answers != Answers::kSegmentsNoSize;
    return sdo_frame(id, {static_cast<std::uint8_t>(size ? 0x41 : 0x40), address, size ? object.bytes : 0U});
  }

  hal::CanFrame next_segment() {
    const std::size_t most = answers == Answers::kSegmentsOfAByte ? 1 : kSegmentBytes;
    const std::size_t bytes = std::min(most, server_.rest.size());
    SdoSegment segment{.toggle = server_.toggle,
                       .last = bytes == server_.rest.size(),
                       .bytes = static_cast<std::uint8_t>(bytes),
                       .data = {}};
    std::copy_n(server_.rest.begin(), bytes, segment.data.begin());
    server_.rest.erase(server_.rest.begin(), server_.rest.begin() + static_cast<std::ptrdiff_t>(bytes));
    server_.toggle = !server_.toggle;
    server_.open = !segment.last;
    return sdo_segment_frame(cob_id::sdo_answer(node_id_), segment);
  }

  [[nodiscard]] bool is_rpdo(std::uint16_t id) const {
    for (std::uint16_t index = 0x1400; index < 0x1404; ++index) {
      if (objects.contains({index, 1}) && get(index, 1) == id) {
        return true;
      }
    }
    return false;
  }

  /// Every PDO by its mapping, at SYNC; a frame shorter than its mapping is an emergency.
  void on_sync(Instant now) {
    for (std::uint16_t k = 0; k < 4; ++k) {
      const auto frame = objects.contains({static_cast<std::uint16_t>(0x1400 + k), 1})
                             ? rpdos.find(static_cast<std::uint16_t>(get(static_cast<std::uint16_t>(0x1400 + k), 1)))
                             : rpdos.end();
      if (frame != rpdos.end()) {
        receive(frame->second, static_cast<std::uint16_t>(0x1600 + k), now);
      }
    }
    rpdos.clear();
    for (std::uint16_t k = 0; k < 4; ++k) {
      const auto pdo = static_cast<std::uint16_t>(0x1800 + k);
      if (objects.contains({pdo, 1}) && (get(pdo, 1) & cob_id::kPdoInvalid) == 0) {
        transmit(static_cast<std::uint16_t>(get(pdo, 1) & 0x7FF), static_cast<std::uint16_t>(0x1A00 + k), now);
      }
    }
  }

  void receive(const hal::CanFrame& frame, std::uint16_t mapping, Instant now) {
    std::size_t at = 0;
    for (std::uint32_t n = 1; n <= get(mapping, 0); ++n) {
      const std::uint32_t entry = get(mapping, static_cast<std::uint8_t>(n));
      const std::size_t bytes = (entry & 0xFF) / 8;
      if (at + bytes > frame.size) {
        return say(now, emergency_frame(node_id_, {0x8210, 0x11, {}}));
      }
      std::uint32_t value = 0;
      for (std::size_t i = 0; i < bytes; ++i) {
        value |= std::uint32_t{frame.data[at + i]} << (8 * i);
      }
      at += bytes;
      if (entry >> 16 == 0x6040) {
        power.command(static_cast<std::uint16_t>(value));
      } else if (entry >> 16 == 0x60FF) {
        target = static_cast<std::int32_t>(value);
      }
    }
  }

  void transmit(std::uint16_t id, std::uint16_t mapping, Instant now) {
    power.at_rest();  // it turns no wheel: every quick stop is over at once
    set(0x6041, 0, 2, std::uint32_t{cia402::statusword_bits(power.state())} | 0x0210);
    hal::CanFrame frame{.id = id, .size = 0, .data = {}};
    for (std::uint32_t n = 1; n <= get(mapping, 0); ++n) {
      const std::uint32_t entry = get(mapping, static_cast<std::uint8_t>(n));
      const std::uint32_t value = get(static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8));
      for (std::uint32_t i = 0; i < (entry & 0xFF) / 8; ++i) {
        frame.data[frame.size++] = static_cast<std::uint8_t>(value >> (8 * i));
      }
    }
    say(now, frame);
  }

  std::uint8_t node_id_;
  Server server_;
  Instant next_heartbeat_{};
  std::vector<std::pair<Instant, hal::CanFrame>> outbox_;
};

}  // namespace ivo::drivers
