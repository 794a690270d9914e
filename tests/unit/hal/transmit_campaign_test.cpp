// The transmit table against a queue that refuses, loses and delays at random, and a shadow that keeps the books.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <deque>
#include <map>
#include <random>
#include <vector>

#include "config/rates.hpp"
#include "hal/api/transmit_table.hpp"

namespace ivo::hal {
namespace {

constexpr int kSteps = 100'000;
constexpr std::array<std::uint16_t, 9> kCobIds{0x000, 0x080, 0x201, 0x202, 0x203, 0x204, 0x601, 0x602, 0x77F};

struct Given {
  std::uint32_t value = 0;
  Instant at{};
};

CanFrame numbered(std::uint16_t id, std::uint8_t node, std::uint32_t value) {
  CanFrame frame{.id = id, .size = 8, .data = {}};
  frame.data[1] = node;
  std::memcpy(&frame.data[4], &value, sizeof value);
  return frame;
}

std::uint32_t value_of(const CanFrame& frame) {
  std::uint32_t value = 0;
  std::memcpy(&value, &frame.data[4], sizeof value);
  return value;
}

std::uint32_t key_of(const CanFrame& frame) { return frame.id != 0 ? frame.id : 0x1000U + frame.data[1]; }

class Campaign {
 public:
  explicit Campaign(std::uint64_t seed) : random_(seed) {}

  void step() {
    now_ += std::chrono::microseconds(pick(4000));
    let_leave();
    table_.settle(now_);
    if (pick(200) == 0) {
      queue_.clear();  // bus-off: what was queued is gone
      table_.forget();
    }
    send();
  }

  void expect_books_to_balance() {
    const auto& told = table_.counters();
    EXPECT_EQ(given_, told.handed_over + told.replaced + told.dropped + table_.waiting());
    EXPECT_GT(told.handed_over, 10'000U);
    EXPECT_GT(told.replaced, 1'000U);
    EXPECT_GT(told.dropped, 1'000U);
    EXPECT_GT(told.echo_lost, 10U);
  }

 private:
  std::uint32_t pick(std::uint32_t below) { return static_cast<std::uint32_t>(random_() % below); }

  void let_leave() {
    for (std::uint32_t count = pick(12); count > 0 && !queue_.empty(); --count) {
      const CanFrame frame = queue_.front();
      queue_.pop_front();
      if (pick(500) != 0) {  // else its echo is lost
        table_.echo(frame, now_);
      }
    }
  }

  void send() {
    std::vector<CanFrame> frames;
    for (std::uint32_t count = pick(10); count > 0; --count) {
      const CanFrame frame = numbered(kCobIds[pick(kCobIds.size())], static_cast<std::uint8_t>(pick(3)), ++value_);
      newest_[key_of(frame)] = {value_, now_};
      frames.push_back(frame);
    }
    given_ += frames.size();
    const auto offered = table_.offer(frames, now_);
    const std::size_t count = std::min<std::size_t>(offered.size(), pick(12));
    std::size_t given_then = 0;
    for (const CanFrame& frame : offered.first(count)) {
      given_then += hand_over(frame, frames) ? 1 : 0;
    }
    ASSERT_EQ(table_.handed_over(count, now_), given_then);
  }

  /// True when `frame` is one of those given now.
  bool hand_over(const CanFrame& frame, const std::vector<CanFrame>& given_now) {
    const bool now = std::find(given_now.begin(), given_now.end(), frame) != given_now.end();
    const Given& newest = newest_[key_of(frame)];
    if (!now) {
      EXPECT_EQ(value_of(frame), newest.value) << "a left-over that a newer value has replaced";
      EXPECT_LE(now_ - newest.at, rates::kTransmitAge) << "an old frame";
    }
    const bool queued = std::any_of(queue_.begin(), queue_.end(),
                                    [&](const CanFrame& other) { return key_of(other) == key_of(frame); });
    EXPECT_FALSE(queued) << "two frames of " << std::hex << frame.id << "h in the queue";
    queue_.push_back(frame);
    return now;
  }

  std::mt19937_64 random_;
  TransmitTable table_{IdSet().set()};
  Instant now_{};
  std::deque<CanFrame> queue_;
  std::map<std::uint32_t, Given> newest_;
  std::uint32_t value_ = 0;
  std::uint64_t given_ = 0;
};

TEST(TransmitTable, NeverQueuesTwoOfAnIdNorAnOldOneWhateverTheQueueDoes) {
  constexpr std::uint64_t kSeed = 20240613;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  Campaign campaign(kSeed);
  for (int i = 0; i < kSteps && !testing::Test::HasFailure(); ++i) {
    campaign.step();
  }
  campaign.expect_books_to_balance();
}

}  // namespace
}  // namespace ivo::hal
