// Who is on the bus, and what he says about himself. It listens, then reads; it writes nothing and sends no NMT.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>

#include "config/limits.hpp"
#include "config/robot.hpp"
#include "drivers/canopen/nmt.hpp"
#include "drivers/canopen/object_address.hpp"
#include "drivers/canopen/sdo_client.hpp"
#include "drivers/eds/short_string.hpp"
#include "firmware/tools/wheels/reading_bus.hpp"

namespace ivo::firmware {

/// Numbers read from each node, in this order; then its name.
enum class ScanObject : std::uint8_t {
  kDeviceType,  ///< 1000h
  kVendor,      ///< 1018h:1
  kProduct,     ///< 1018h:2
  kRevision,    ///< 1018h:3
  kSerial,      ///< 1018h:4
  kModes,       ///< 6502h
  kStatusword,  ///< 6041h
  kErrorCode,   ///< 603Fh
};
inline constexpr std::size_t kScanObjects = 8;
using NodeName = drivers::ShortString<drivers::SdoClient::kMostBytes>;

struct ScannedNode {
  bool answered = false;                   ///< an SDO request
  bool booted = false;                     ///< a boot-up message
  std::optional<drivers::NmtState> state;  ///< by its last heartbeat
  std::array<std::optional<std::uint32_t>, kScanObjects> values{};
  std::optional<NodeName> name;  ///< 1008h, as it came: any bytes

  [[nodiscard]] bool there() const noexcept { return answered || booted || state.has_value(); }
  [[nodiscard]] const std::optional<std::uint32_t>& value(ScanObject object) const noexcept {
    return values[static_cast<std::size_t>(object)];
  }
};

/// Nothing waits: cycle() until done(), about 1.2 s with nodes that answer at once. A controller that is running is
/// not disturbed: when one is heard while listening, no node is asked. About 50 KB.
class NodeScan {
 public:
  static constexpr std::size_t kNodes = 127;
  static constexpr Duration kListen = std::chrono::milliseconds(500);
  static constexpr Duration kPatience = std::chrono::milliseconds(600);  ///< with the first answer, asked twice
  static constexpr int kRequestsPerCycle = 4;                            ///< a quarter of a bus at 1 Mbit/s

  using NodeIds = std::bitset<kNodes + 1>;
  [[nodiscard]] static NodeIds everyone() noexcept;

  /// `bus` outlives this. `robot` tells what only a controller of ours sends.
  NodeScan(hal::CanBus& bus, const Robot& robot, const NodeIds& asked) noexcept;

  void cycle(Instant now) noexcept;
  [[nodiscard]] bool done() const noexcept { return done_; }

  /// `node_id` 1 to 127.
  [[nodiscard]] const ScannedNode& node(std::uint8_t node_id) const noexcept { return nodes_[node_id].seen; }
  /// COB-ID of a frame that only a controller sends, heard while listening.
  [[nodiscard]] std::optional<std::uint16_t> controller() const noexcept { return controller_; }
  [[nodiscard]] std::uint64_t refused_frames() const noexcept { return bus_.refused(); }

 private:
  struct Node {
    ScannedNode seen;
    bool asked = false;
    bool asked_again = false;
    Instant asked_at{};
    bool silent = false;
    drivers::SdoClient sdo{0};
    std::size_t object = 0;  ///< that is being read; kScanObjects: the name
  };

  void take(const hal::CanFrame& frame) noexcept;
  void listen_for_controller(std::uint16_t id) noexcept;
  void ask(Instant now) noexcept;
  [[nodiscard]] bool ask_first(Node& node, std::uint8_t node_id, Instant now) noexcept;
  static void start(Node& node) noexcept;
  static void keep(Node& node) noexcept;
  void read_on(Node& node, Instant now) noexcept;

  ReadingBus bus_;
  NodeIds asked_;
  std::array<std::uint8_t, kWheels> ours_{};
  std::uint8_t master_node_id_;
  std::array<Node, kNodes + 1> nodes_;
  std::optional<Instant> begin_;
  std::optional<std::uint16_t> controller_;
  bool done_ = false;
  std::array<hal::ReceivedFrame, limits::kFramesPerCycle> frames_{};
};

}  // namespace ivo::firmware
