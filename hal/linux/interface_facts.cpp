#include "hal/linux/interface_facts.hpp"

#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "hal/api/file_descriptor.hpp"

namespace ivo::hal {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::size_t kAnswerBytes = 32768;  // a link with all its attributes

template <class T>
std::optional<T> load(Bytes bytes) {
  if (bytes.size() < sizeof(T)) {
    return std::nullopt;
  }
  T value{};
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

constexpr std::size_t padded(std::size_t bytes) { return (bytes + 3) & ~std::size_t{3}; }

/// Calls `take(type, payload)` for each attribute in `bytes`; ends at the first that does not fit.
template <class Take>
void for_each_attribute(Bytes bytes, const Take& take) {
  while (const std::optional<rtattr> head = load<rtattr>(bytes)) {
    if (head->rta_len < sizeof(rtattr) || head->rta_len > bytes.size()) {
      return;
    }
    take(head->rta_type & NLA_TYPE_MASK, bytes.subspan(sizeof(rtattr), head->rta_len - sizeof(rtattr)));
    bytes = bytes.subspan(std::min(padded(head->rta_len), bytes.size()));
  }
}

std::string text(Bytes bytes) {
  std::string all;
  for (const std::byte b : bytes) {
    if (b == std::byte{0}) {
      break;
    }
    all += static_cast<char>(b);
  }
  return all;
}

InterfaceFacts::Kind kind_named(const std::string& name) {
  if (name == "can") {
    return InterfaceFacts::Kind::kCan;
  }
  if (name == "vcan") {
    return InterfaceFacts::Kind::kVcan;
  }
  return name == "vxcan" ? InterfaceFacts::Kind::kVxcan : InterfaceFacts::Kind::kOther;
}

std::optional<BusState> state_of(std::uint32_t can_state) {
  switch (can_state) {
    case CAN_STATE_ERROR_ACTIVE:
      return BusState::kActive;
    case CAN_STATE_ERROR_WARNING:
      return BusState::kWarning;
    case CAN_STATE_ERROR_PASSIVE:
      return BusState::kPassive;
    case CAN_STATE_BUS_OFF:
      return BusState::kOff;
    default:
      return std::nullopt;
  }
}

void take_controller(InterfaceFacts& facts, int type, Bytes value) {
  if (type == IFLA_CAN_BITTIMING) {
    facts.bit_rate_bps = load<can_bittiming>(value).value_or(can_bittiming{}).bitrate;
  } else if (type == IFLA_CAN_STATE) {
    facts.controller = state_of(load<std::uint32_t>(value).value_or(CAN_STATE_STOPPED));
  } else if (type == IFLA_CAN_RESTART_MS) {
    facts.restart_ms = load<std::uint32_t>(value).value_or(0);
  } else if (const auto counted = load<can_berr_counter>(value); type == IFLA_CAN_BERR_COUNTER && counted) {
    facts.counts_errors = true;
    facts.transmit_errors = counted->txerr;
    facts.receive_errors = counted->rxerr;
  }
}

void take_link_info(InterfaceFacts& facts, Bytes info) {
  Bytes data;
  for_each_attribute(info, [&](int type, Bytes value) {
    if (type == IFLA_INFO_KIND) {
      facts.kind = kind_named(text(value));
    } else if (type == IFLA_INFO_DATA) {
      data = value;
    }
  });
  if (facts.kind == InterfaceFacts::Kind::kCan) {
    for_each_attribute(data, [&](int type, Bytes value) { take_controller(facts, type, value); });
  }
}

FileDescriptor ask(const std::string& name) {
  struct Request {
    nlmsghdr head;
    ifinfomsg link;
    rtattr attribute;
    std::array<char, IFNAMSIZ> name;
  } request{};
  request.head.nlmsg_len = sizeof request;
  request.head.nlmsg_type = RTM_GETLINK;
  request.head.nlmsg_flags = NLM_F_REQUEST;
  request.link.ifi_family = AF_UNSPEC;
  request.attribute.rta_type = IFLA_IFNAME;
  request.attribute.rta_len = sizeof(rtattr) + IFNAMSIZ;
  name.copy(request.name.data(), request.name.size() - 1);

  FileDescriptor socket(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
  const timeval patience{.tv_sec = 1, .tv_usec = 0};
  if (!socket.valid() || setsockopt(socket.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience) != 0 ||
      ::send(socket.get(), &request, sizeof request, 0) != static_cast<ssize_t>(sizeof request)) {
    return {};
  }
  return socket;
}

}  // namespace

std::optional<InterfaceFacts> parse_link_message(Bytes message) {
  const auto head = load<nlmsghdr>(message);
  if (!head || head->nlmsg_type != RTM_NEWLINK || head->nlmsg_len > message.size() ||
      head->nlmsg_len < sizeof(nlmsghdr) + sizeof(ifinfomsg)) {
    return std::nullopt;
  }
  const Bytes body = message.subspan(sizeof(nlmsghdr), head->nlmsg_len - sizeof(nlmsghdr));
  const ifinfomsg link = load<ifinfomsg>(body).value();
  InterfaceFacts facts;
  facts.index = link.ifi_index;
  facts.carries_can = link.ifi_type == ARPHRD_CAN;
  facts.up = (link.ifi_flags & IFF_UP) != 0;
  for_each_attribute(body.subspan(sizeof link), [&](int type, Bytes value) {
    if (type == IFLA_IFNAME) {
      facts.name = text(value);
    } else if (type == IFLA_TXQLEN) {
      facts.queue_frames = load<std::uint32_t>(value).value_or(0);
    } else if (type == IFLA_MTU) {
      facts.mtu = load<std::uint32_t>(value).value_or(0);
    } else if (type == IFLA_LINKINFO) {
      take_link_info(facts, value);
    }
  });
  return facts;
}

LinkAnswer ask_for_link(const std::string& name) {
  using Outcome = LinkAnswer::Outcome;
  if (name.empty() || name.size() >= IFNAMSIZ) {
    return {Outcome::kMissing, {}};
  }
  const FileDescriptor socket = ask(name);
  if (!socket.valid()) {
    return {};
  }
  std::array<std::byte, kAnswerBytes> answer{};
  const ssize_t size = recv(socket.get(), answer.data(), answer.size(), 0);
  if (size <= 0) {
    return {};
  }
  const Bytes message = Bytes(answer).first(static_cast<std::size_t>(size));
  if (std::optional<InterfaceFacts> facts = parse_link_message(message)) {
    return {Outcome::kFound, *std::move(facts)};
  }
  const auto head = load<nlmsghdr>(message);
  if (head && head->nlmsg_type == NLMSG_ERROR) {
    const auto error = load<nlmsgerr>(message.subspan(sizeof(nlmsghdr)));
    return {error && error->error == -ENODEV ? Outcome::kMissing : Outcome::kNotTold, {}};
  }
  return {};
}

Result<InterfaceFacts> interface_facts(const std::string& name) {
  LinkAnswer answer = ask_for_link(name);
  switch (answer.outcome) {
    case LinkAnswer::Outcome::kFound:
      return std::move(answer.facts);
    case LinkAnswer::Outcome::kMissing:
      return Error{"no CAN interface \"" + name + "\": `ip link show type can` (or vcan) lists those there are"};
    case LinkAnswer::Outcome::kNotTold:
      break;
  }
  return Error{"the kernel does not say what interface \"" + name + "\" is: expected an answer to RTM_GETLINK"};
}

std::string command_for_bit_rate(const std::string& name, std::uint32_t bit_rate_bps) {
  return "`ip link set " + name + " down; ip link set " + name + " type can bitrate " + std::to_string(bit_rate_bps) +
         " restart-ms 100; ip link set " + name + " up`";
}

std::string command_for_queue(const std::string& name) {
  return "`ip link set " + name + " txqueuelen " + std::to_string(kLongestQueueFrames) + "`";
}

// Refused while the interface is up (EBUSY).
std::string command_for_restart(const std::string& name) {
  return "`ip link set " + name + " down; ip link set " + name + " type can restart-ms 100; ip link set " + name +
         " up`";
}

Result<void> check_bit_rate(const InterfaceFacts& facts, std::uint32_t bit_rate_bps) {
  if (facts.bit_rate_bps == 0 || bit_rate_bps == 0 || facts.bit_rate_bps == bit_rate_bps) {
    return {};
  }
  return Error{"CAN interface \"" + facts.name + "\" runs at " + std::to_string(facts.bit_rate_bps) +
               " bit/s; expected the robot's " + std::to_string(bit_rate_bps) + ": " +
               command_for_bit_rate(facts.name, bit_rate_bps)};
}

std::string advice(const InterfaceFacts& facts) {
  std::string text;
  if (facts.kind != InterfaceFacts::Kind::kCan) {
    return text;
  }
  if (facts.queue_frames > kLongestQueueFrames) {
    text = facts.name + " queues " + std::to_string(facts.queue_frames) +
           " frames, which cannot be called back: " + command_for_queue(facts.name);
  }
  if (facts.restart_ms == 0) {
    text += text.empty() ? facts.name : "; it";
    text += " stays off after bus-off: " + command_for_restart(facts.name);
  }
  return text;
}

}  // namespace ivo::hal
