#include <cmath>
#include <cstdio>
#include <numbers>

#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/wheels/check_guide.hpp"
#include "firmware/tools/wheels/state_words.hpp"
#include "firmware/tools/wheels/turn_session.hpp"
#include "firmware/tools/wheels/turn_text.hpp"
#include "firmware/tools/wheels/wheel_findings.hpp"

namespace ivo::firmware::wheels {
namespace {

constexpr double kUsualTurns = 1.0;

class Check {
 public:
  Check(TurnSession& session, double radps, double turns)
      : session_(session),
        guide_(session.world().robot(), radps, turns),
        turns_(turns),
        robot_(session.world().robot()) {}

  /// False when it ended before all wheels were checked.
  bool to_the_end() {
    while (guide_.step() != CheckStep::kDone) {
      if (!(guide_.turning() ? turn() : ask())) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] Findings findings() const { return findings_of(robot_, guide_.observations()); }

 private:
  bool turn() {
    announce();
    const TurnOrder order = guide_.order();
    const std::uint32_t number = session_.loop().status().order + 1;
    session_.loop().give(order);
    bool enough = false;
    while (!session_.over()) {
      const std::string keys = session_.terminal().keys(TurnSession::kWaitMs);
      enough = enough || keys.find_first_of("\r\n") != std::string::npos;
      if (keys.find_first_not_of(" \r\n") != std::string::npos) {
        return false;
      }
      const TurnStatus& status = session_.loop().status();
      const bool odd = status.order == number && status.turned.note != TurnNote::kNone;
      if (keys.find(' ') != std::string::npos && !odd) {  // what was odd is looked into before it turns again
        session_.loop().hold_key();
      }
      if (status.order != number) {
        continue;
      }
      session_.show(status);
      if (guide_.over(status, enough)) {
        session_.line().draw("", measured_text(status.turned));
        session_.line().end();
        if (guide_.moved(status)) {
          say("", "Once more, and told less");
        }
        return true;
      }
    }
    return false;
  }

  void announce() {
    const std::string wheel = wheel_text(robot_, guide_.wheel());
    if (guide_.step() == CheckStep::kTurnALittle) {
      (void)std::printf("\n");
      say(format("%d of %d", static_cast<int>(guide_.wheel()) + 1, kWheels).c_str(),
          wheel + ": hold the space bar; it turns a little and stops by itself");
    } else if (seen().turns_seen) {
      say("", "That was much less than it should be, so once more, and further: hold the space bar, count the turns");
    } else {
      say("", format("Chalk a mark on it. Hold the space bar: it makes %s and stops by itself; Enter if that is enough",
                     turns_ == 1.0 ? "one turn" : format("%g turns", turns_).c_str()));
    }
  }

  bool ask() {
    switch (guide_.step()) {
      case CheckStep::kWhichWheel:
        return ask_which();
      case CheckStep::kForward:
        return ask_forward();
      case CheckStep::kHowManyTurns:
        return ask_how_many();
      case CheckStep::kTurnALittle:
      case CheckStep::kTurnRound:
      case CheckStep::kDone:
        break;
    }
    return false;
  }

  bool ask_which() {
    const auto key = session_.ask(
        labelled("", "Which wheel turned? 1 front left, 2 front right, 3 rear left, 4 rear right, n none, a again "),
        "1234na");
    if (!key) {
      return false;
    }
    if (*key == 'a') {
      guide_.again();
    } else if (*key == 'n') {
      guide_.which(std::nullopt);
    } else {
      guide_.which(static_cast<Wheel>(*key - '1'));
    }
    return true;
  }

  bool ask_forward() {
    const auto key =
        session_.ask(labelled("", "Did its top move forward, as when the base drives ahead? y, n, a again "), "yna");
    if (!key) {
      return false;
    }
    *key == 'a' ? guide_.again() : guide_.forward(*key == 'y');
    return true;
  }

  bool ask_how_many() {
    const double usual = std::round(seen().turns_measured * 100.0) / 100.0;
    const auto turns = session_.ask_number(
        labelled("", format("How many turns did the mark make? A number; Enter for %g, a again ", usual)), usual);
    if (!turns) {
      return false;
    }
    *turns > 0.0 ? guide_.how_many(*turns) : guide_.again();
    return true;
  }

  [[nodiscard]] const WheelObservation& seen() const {
    return guide_.observations()[static_cast<std::size_t>(guide_.wheel())];
  }

  TurnSession& session_;
  CheckGuide guide_;
  double turns_;
  const Robot& robot_;
};

void tell(const Findings& findings, const std::string& file) {
  (void)std::printf("\n");
  const char* label = "found";
  for (const std::string& line : findings.lines) {
    say(label, line);
    label = "";
  }
  if (findings.toml.empty()) {
    say("result", findings.all_right ? "all four wheels are as the robot file says"
                                     : "there is something to mend, but nothing to change in the robot file");
    return;
  }
  say("change", "in the robot file (" + file + "), then check again:");
  (void)std::printf("\n");
  for (const std::string& line : findings.toml) {
    (void)std::printf("%s\n", line.c_str());
  }
}

}  // namespace

int check(const Options& options) {
  int status = 0;
  const std::unique_ptr<TurnSession> session = TurnSession::begin(options, "check", status);
  if (session == nullptr) {
    return status;
  }
  Check the_check(*session, std::abs(options.radps.value_or(kUsualRadps)), options.turns.value_or(kUsualTurns));
  const bool whole = the_check.to_the_end();
  const int ended = session->finish();
  const Findings findings = the_check.findings();
  tell(findings, session->world().robot_source());
  return whole && findings.all_right ? ended : exit_status::kFaultOrStop;
}

}  // namespace ivo::firmware::wheels
