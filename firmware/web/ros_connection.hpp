// A ROS client's connection: its session, with what it asks for judged as a page's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "firmware/web/page_check.hpp"
#include "firmware/web/ros/ros_commands.hpp"
#include "firmware/web/session.hpp"

namespace ivo::firmware::web {

class Hub;

class RosConnection final : public Session, private RosCommands {
 public:
  static constexpr std::size_t kUnreadFrames = 256;
  static constexpr int kAsksPerSecond = 40;

  /// `hub` outlives this.
  RosConnection(Screen screen, const Paired& paired, Hub& hub);

  void hear(std::string_view message, bool binary, Instant now) override;
  [[nodiscard]] bool fresh(std::uint32_t /*seen*/, Instant now) const noexcept override {
    return liveness().beats(now);
  }
  void pinged(std::uint32_t number, Instant now) override { liveness().told(number, now); }
  /// It has no beats of its own: that it answers pings counts for them.
  void alive(std::uint32_t number, Instant now) override;
  void answered(std::uint32_t number, Verdict verdict) override;
  [[nodiscard]] std::optional<Frame> next(Instant now) override;
  void written(Instant now) override;
  [[nodiscard]] bool overfull() const noexcept override { return frames_.size() > kUnreadFrames; }

 private:
  std::uint32_t ask(const Request& request) override;
  void show(const Layer& layer) override;
  [[nodiscard]] bool may_operate() const override { return paired().role == Role::kOperator; }
  void refused(Verdict verdict) override;
  void tell_verdicts();

  Hub& hub_;
  Instant now_{};  // of what it hears
  std::uint32_t asked_ = 0;
  RateLimit rate_{kAsksPerSecond};
  std::vector<std::pair<std::uint32_t, Verdict>> verdicts_;  // never told from within ask()
  RosSession session_;
  std::deque<Frame> frames_;
};

}  // namespace ivo::firmware::web
