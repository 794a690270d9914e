#include "hal/linux/gpio_lines.hpp"

#include <gpiod.h>
#include <poll.h>
#include <time.h>

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "hal/api/digital_io.hpp"

namespace ivo::hal {
namespace {

constexpr const char* kConsumer = "ivo";
// A contact that bounces tells of many edges; more than so many in one call wait for the next.
constexpr int kEdgesPerCall = 16;
// Nor does it make the thread spin.
constexpr Duration kAfterEdges = std::chrono::milliseconds(1);

struct CloseChip {
  void operator()(gpiod_chip* chip) const noexcept { gpiod_chip_close(chip); }  // releases its lines
};

struct Input {
  gpiod_line* line = nullptr;
  std::uint8_t bit = 0;
  bool tells_edges = false;
};

void wait_out(Duration time) noexcept {
  constexpr Duration::rep kSecond = 1'000'000'000;
  timespec left{.tv_sec = time.count() / kSecond, .tv_nsec = time.count() % kSecond};
  while (clock_nanosleep(CLOCK_MONOTONIC, 0, &left, &left) == EINTR) {
  }
}

class LibgpiodLines final : public GpioLines {
 public:
  LibgpiodLines(std::unique_ptr<gpiod_chip, CloseChip> chip, std::vector<Input> inputs)
      : chip_(std::move(chip)), inputs_(std::move(inputs)) {
    for (const Input& input : inputs_) {
      // poll() passes over what is below 0.
      polled_.push_back({input.tells_edges ? gpiod_line_event_get_fd(input.line) : -1, POLLIN, 0});
    }
  }

  std::uint8_t wait(Duration limit) noexcept override {
    const auto limit_ms = static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(limit).count());
    if (std::exchange(had_edges_, false)) {
      wait_out(kAfterEdges);
    }
    const int ready = poll(polled_.data(), polled_.size(), limit_ms);
    std::uint8_t pressed = 0;
    bool trouble = ready < 0;
    for (std::size_t i = 0; ready > 0 && i < inputs_.size(); ++i) {
      if ((polled_[i].revents & POLLIN) != 0) {
        had_edges_ = true;
        trouble = !take_edges(inputs_[i], pressed) || trouble;
      } else {
        trouble = polled_[i].revents != 0 || trouble;
      }
    }
    if (trouble) {
      wait_out(limit);
    }
    return pressed;
  }

  std::optional<std::uint8_t> read() noexcept override {
    std::uint8_t pressed = 0;
    for (const Input& input : inputs_) {
      const int value = gpiod_line_get_value(input.line);
      if (value < 0) {
        return std::nullopt;
      }
      pressed = static_cast<std::uint8_t>(pressed | (value != 0 ? input.bit : 0));
    }
    return pressed;
  }

 private:
  static bool take_edges(const Input& input, std::uint8_t& pressed) noexcept {
    pollfd more{gpiod_line_event_get_fd(input.line), POLLIN, 0};
    for (int edge = 0; edge < kEdgesPerCall; ++edge) {
      gpiod_line_event event{};
      if (gpiod_line_event_read(input.line, &event) < 0) {
        return false;
      }
      if (event.event_type == GPIOD_LINE_EVENT_RISING_EDGE) {
        pressed = static_cast<std::uint8_t>(pressed | input.bit);
      }
      if (poll(&more, 1, 0) <= 0) {
        break;
      }
    }
    return true;
  }

  std::unique_ptr<gpiod_chip, CloseChip> chip_;
  std::vector<Input> inputs_;
  std::vector<pollfd> polled_;
  bool had_edges_ = false;
};

std::string sentence_of(int error) { return std::strerror(error); }

Error chip_error(const std::string& chip, int error) {
  if (error == ENOENT || error == ENODEV || error == ENOTTY) {
    return {"inputs.chip: there is no GPIO chip \"" + chip +
            "\"; expected a name, number, path or label that gpiodetect lists"};
  }
  return {"inputs.chip: cannot open GPIO chip \"" + chip + "\": " + sentence_of(error)};
}

struct Wanted {
  std::string key;
  InputLine line;
  std::uint8_t bit = 0;
};

std::vector<Wanted> wanted_lines(const InputParameters& inputs) {
  std::vector<Wanted> wanted;
  if (inputs.emergency_stop) {
    wanted.push_back({"inputs.emergency_stop", *inputs.emergency_stop, 1});
  }
  for (std::size_t i = 0; i < inputs.bumpers.size(); ++i) {
    if (inputs.bumpers[i]) {
      wanted.push_back(
          {"inputs.bumpers[" + std::to_string(i) + "]", *inputs.bumpers[i], static_cast<std::uint8_t>(1U << (i + 1))});
    }
  }
  return wanted;
}

Result<Input> request(gpiod_chip* chip, const std::string& chip_name, const Wanted& wanted) {
  const std::string what = wanted.key + ": line " + std::to_string(wanted.line.line) + " of " + chip_name;
  const unsigned lines = gpiod_chip_num_lines(chip);
  if (wanted.line.line >= lines) {
    return Error{what + " does not exist; expected 0 to " + std::to_string(lines - 1)};
  }
  gpiod_line* const line = gpiod_chip_get_line(chip, wanted.line.line);
  if (line == nullptr) {
    return Error{what + " cannot be had: " + sentence_of(errno)};
  }
  const int flags = wanted.line.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
  if (gpiod_line_request_both_edges_events_flags(line, kConsumer, flags) == 0) {
    return Input{line, wanted.bit, true};
  }
  if (errno != EBUSY && gpiod_line_request_input_flags(line, kConsumer, flags) == 0) {
    return Input{line, wanted.bit, false};
  }
  const int error = errno;
  if (error == EBUSY) {
    const char* const user = gpiod_line_consumer(line);
    return Error{what + " is in use by " + (user != nullptr ? "\"" + std::string(user) + "\"" : "the kernel") +
                 "; expected a free one"};
  }
  return Error{what + " cannot be used as an input: " + sentence_of(error)};
}

}  // namespace

Result<std::unique_ptr<GpioLines>> open_gpio_lines(const InputParameters& inputs) {
  std::unique_ptr<gpiod_chip, CloseChip> chip(gpiod_chip_open_lookup(inputs.chip.c_str()));
  if (!chip) {
    return chip_error(inputs.chip, errno);
  }
  std::vector<Input> opened;
  for (const Wanted& wanted : wanted_lines(inputs)) {
    const Result<Input> input = request(chip.get(), inputs.chip, wanted);
    if (!input) {
      return input.error();
    }
    opened.push_back(input.value());
  }
  return std::unique_ptr<GpioLines>(std::make_unique<LibgpiodLines>(std::move(chip), std::move(opened)));
}

}  // namespace ivo::hal
