#include "firmware/web/ros_connection.hpp"

#include <chrono>
#include <variant>

#include "firmware/web/hub.hpp"

namespace ivo::firmware::web {
namespace {

/// Of the server's clock, which is the steady one: ROS stamps with the time since 1970. Asked anew for each client, as
/// a robot's PC may learn the time late.
Duration epoch_of_server() {
  return std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch()) -
         std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch());
}

}  // namespace

RosConnection::RosConnection(Screen screen, const Paired& paired, Hub& hub)
    : Session(screen, paired), hub_(hub), session_(hub.view(), *this, epoch_of_server()) {}

void RosConnection::hear(std::string_view message, bool binary, Instant now) {
  now_ = now;
  session_.hear(message, binary, now);
  tell_verdicts();
}

void RosConnection::alive(std::uint32_t number, Instant now) {
  if (liveness().beat(number, now)) {
    (void)hub_.ask(*this, 0, Beat{}, now);
  }
}

std::uint32_t RosConnection::ask(const Request& request) {
  const std::uint32_t number = ++asked_;
  std::optional<Verdict> verdict = Verdict::kTooOften;
  if (std::holds_alternative<Stop>(request) || rate_.allows(now_)) {
    verdict = hub_.ask(*this, number, request, now_);
  } else {
    hub_.refusals().count(Verdict::kTooOften);
  }
  if (verdict) {
    verdicts_.emplace_back(number, *verdict);
  }
  return number;
}

void RosConnection::show(const Layer& layer) { hub_.show(layer); }

void RosConnection::refused(Verdict verdict) { hub_.refusals().count(verdict); }

void RosConnection::answered(std::uint32_t number, Verdict verdict) { session_.answered(number, verdict); }

void RosConnection::tell_verdicts() {
  for (const auto& [number, verdict] : std::exchange(verdicts_, {})) {
    session_.answered(number, verdict);
  }
}

std::optional<Frame> RosConnection::next(Instant now) {
  now_ = now;
  if (frames_.empty()) {
    for (Frame& frame : session_.take(now)) {
      frames_.push_back(std::move(frame));
    }
    tell_verdicts();
  }
  if (frames_.empty()) {
    return std::nullopt;
  }
  Frame frame = std::move(frames_.front());
  frames_.pop_front();
  return frame;
}

void RosConnection::written(Instant /*now*/) {}

}  // namespace ivo::firmware::web
