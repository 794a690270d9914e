#include "firmware/tools/bench/can/tapped_bus.hpp"

#include "config/base/contract.hpp"

namespace ivo::firmware::bench {

std::size_t MeddledBus::receive(std::span<hal::ReceivedFrame> frames, Instant now) noexcept {
  const std::size_t count = inner_.receive(frames, now);
  if (!incoming) {
    return count;
  }
  std::vector<hal::CanFrame> heard;
  for (const hal::ReceivedFrame& received : frames.first(count)) {
    heard.push_back(received.frame);
  }
  incoming(heard);
  IVO_CONTRACT(heard.size() <= frames.size());
  for (std::size_t i = 0; i < heard.size(); ++i) {
    frames[i] = {.frame = heard[i], .at = now};
  }
  return heard.size();
}

std::size_t MeddledBus::send(std::span<const hal::CanFrame> frames, Instant now) noexcept {
  if (!outgoing) {
    return inner_.send(frames, now);
  }
  std::vector<hal::CanFrame> said(frames.begin(), frames.end());
  outgoing(said);
  (void)inner_.send(said, now);
  return frames.size();
}

}  // namespace ivo::firmware::bench
