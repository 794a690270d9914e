#include "firmware/tools/wheels/turn_session.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/stop_signal.hpp"
#include "firmware/tools/wheels/preflight.hpp"
#include "firmware/tools/wheels/turn_text.hpp"

namespace ivo::firmware::wheels {
namespace {

constexpr char kEscape = 0x1B;
constexpr char kCtrlC = 0x03;
constexpr char kCtrlD = 0x04;
constexpr char kEnter = '\r';
constexpr char kLineFeed = '\n';
constexpr char kDelete = 0x7F;
constexpr char kBackspace = '\b';
constexpr std::size_t kDigits = 8;

bool ends(char key) noexcept { return key == kEscape || key == kCtrlC || key == kCtrlD || key == 0x1A || key == 0x1C; }
bool enters(char key) noexcept { return key == kEnter || key == kLineFeed; }

void print(const std::string& text) {
  (void)std::fwrite(text.data(), 1, text.size(), stdout);
  (void)std::fflush(stdout);
}

}  // namespace

std::unique_ptr<TurnSession> TurnSession::begin(const Options& options, const char* command, int& status) {
  status = exit_status::kWrongInput;
  if (!RawTerminal::possible()) {
    complain({std::string("wheels ") + command +
              " turns a wheel only while somebody holds a key; expected a terminal on standard input and output"});
    return nullptr;
  }
  Result<std::unique_ptr<World>> world = World::open(options, World::Purpose::kTurn);
  if (!world) {
    complain(world.error());
    return nullptr;
  }
  stop_on_all_signals();
  std::unique_ptr<TurnSession> session(new TurnSession);
  session->world_ = std::move(world).value();
  say("bus", session->world_->description());
  say("robot", session->world_->robot().name + ", " + session->world_->robot_source());
  if (const Result<void> clear = look_before_start(*session->world_); !clear) {
    status = exit_status::kFaultOrStop;
    complain(clear.error());
    return nullptr;
  }
  session->terminal_ = std::make_unique<RawTerminal>();
  const std::optional<char> blocks =
      session->ask(labelled("blocks", "Does the base stand on blocks, all four wheels in the air? [y/n] "), "yn");
  if (blocks != 'y') {
    status = exit_status::kNoConsent;
    session->terminal_.reset();
    say("ended", "nothing was started");
    return nullptr;
  }
  session->loop_ = std::make_unique<TurnLoop>(*session->world_);
  status = exit_status::kEnded;
  return session;
}

bool TurnSession::over() noexcept {
  return stop_asked() || terminal_->closed() || (loop_ != nullptr && !loop_->running());
}

void TurnSession::show(const TurnStatus& status) {
  const TurnNote note = status.turned.note;
  if (note != noted_) {
    noted_ = note;
    if (note != TurnNote::kNone) {
      line_.end();
      say("note", note_text(status.turned, status.wheel));
    }
  }
  if (line_.due(0, 1)) {
    line_.draw("", status_text(status));
  }
}

std::optional<char> TurnSession::ask(const std::string& question, const std::string& keys) {
  line_.end();
  terminal_->forget_keys();
  print(question);
  while (!over()) {
    for (const char key : terminal_->keys(kWaitMs)) {
      if (loop_ != nullptr) {
        loop_->other_key();
      }
      if (ends(key)) {
        print("\n");
        return std::nullopt;
      }
      if (keys.find(key) != std::string::npos) {
        print(std::string(1, key) + "\n");
        return key;
      }
    }
  }
  print("\n");
  return std::nullopt;
}

std::optional<double> TurnSession::ask_number(const std::string& question, double usual) {
  line_.end();
  terminal_->forget_keys();
  print(question);
  std::string typed;
  while (!over()) {
    for (const char key : terminal_->keys(kWaitMs)) {
      loop_->other_key();
      if (ends(key)) {
        print("\n");
        return std::nullopt;
      }
      if (key == 'a' && typed.empty()) {
        print("again\n");
        return 0.0;
      }
      if ((key == kDelete || key == kBackspace) && !typed.empty()) {
        typed.pop_back();
        print("\b \b");
      } else if (((key >= '0' && key <= '9') || key == '.') && typed.size() < kDigits) {
        typed += key;
        print(std::string(1, key));
      } else if (enters(key)) {
        char* end = nullptr;
        const double value = typed.empty() ? usual : std::strtod(typed.c_str(), &end);
        if (typed.empty() || (*end == '\0' && value > 0.0)) {
          print(typed.empty() ? format("%g\n", usual) : "\n");
          return value;
        }
        print("\n" + labelled("", "A number above 0, as 1 or 0.95: "));
        typed.clear();
      }
    }
  }
  print("\n");
  return std::nullopt;
}

int TurnSession::finish() {
  const bool asked_by_signal = stop_asked() || terminal_->closed();
  loop_->end();
  while (loop_->running()) {
    if (line_.due(0, 1)) {
      line_.draw("power", "goes off");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(kWaitMs));
  }
  const TurnStatus& status = loop_->status();
  line_.end();
  terminal_.reset();
  if (status.end == TurnEnd::kFault) {
    say("fault", fault_text(status.fault));
  } else if (status.end == TurnEnd::kNobodyThere) {
    say("ended", "nobody pressed a key for five minutes");
  }
  if (status.refused_frames > 0) {
    say("refused",
        format("%llu frames that this tool may not send", static_cast<unsigned long long>(status.refused_frames)));
  }
  if (status.power_off) {
    say("power", "off on all four drives");
  } else {
    say("power", "NOT KNOWN TO BE OFF: a drive does not say so. Keep away from the wheels and cut the supply");
  }
  return status.end == TurnEnd::kAsked && status.power_off && !asked_by_signal ? exit_status::kEnded
                                                                               : exit_status::kFaultOrStop;
}

}  // namespace ivo::firmware::wheels
