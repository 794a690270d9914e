#include "hal/linux/gpio_lines.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "tests/unit/hal/fake_gpiod.hpp"

struct gpiod_chip {};
struct gpiod_line {
  ivo::hal::FakeLine* fake = nullptr;
};

namespace {

ivo::hal::FakeChip* the_chip = nullptr;
gpiod_chip chip_handle;
std::array<gpiod_line, 8> line_handles;

int fail(int error) {
  errno = error;
  return -1;
}

int logical(const ivo::hal::FakeLine& line) { return line.active_low ? 1 - line.level : line.level; }

int request(gpiod_line* handle, int flags, bool works) {
  ivo::hal::FakeLine& line = *handle->fake;
  if (!line.user.empty()) {
    return fail(EBUSY);
  }
  if (!works) {
    return fail(ENXIO);
  }
  line.requested = true;
  line.active_low = (flags & GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW) != 0;
  return 0;
}

}  // namespace

extern "C" {

gpiod_chip* gpiod_chip_open_lookup(const char* name) {
  if (the_chip == nullptr || std::string(name) != "gpiochip7") {
    errno = ENOENT;
    return nullptr;
  }
  if (the_chip->open_error != 0) {
    errno = the_chip->open_error;
    return nullptr;
  }
  the_chip->open = true;
  return &chip_handle;
}

void gpiod_chip_close(gpiod_chip* /*chip*/) { the_chip->open = false; }

unsigned int gpiod_chip_num_lines(gpiod_chip* /*chip*/) { return 8; }

gpiod_line* gpiod_chip_get_line(gpiod_chip* /*chip*/, unsigned int offset) {
  line_handles.at(offset).fake = &the_chip->lines.at(offset);
  return &line_handles.at(offset);
}

int gpiod_line_request_both_edges_events_flags(gpiod_line* line, const char* /*consumer*/, int flags) {
  const int result = request(line, flags, line->fake->edges_work);
  if (result == 0) {
    EXPECT_EQ(pipe(line->fake->pipe.data()), 0);
  }
  return result;
}

int gpiod_line_request_input_flags(gpiod_line* line, const char* /*consumer*/, int flags) {
  return request(line, flags, line->fake->input_works);
}

const char* gpiod_line_consumer(gpiod_line* line) {
  return line->fake->user == "?" ? nullptr : line->fake->user.c_str();
}

int gpiod_line_event_get_fd(gpiod_line* line) { return line->fake->pipe[0]; }

int gpiod_line_get_value(gpiod_line* line) { return line->fake->readable ? logical(*line->fake) : fail(ENODEV); }

int gpiod_line_event_read(gpiod_line* line, gpiod_line_event* event) {
  return read(line->fake->pipe[0], &event->event_type, sizeof event->event_type) > 0 ? 0 : fail(ENODEV);
}

}  // extern "C"

namespace ivo::hal {

FakeChip::FakeChip() { the_chip = this; }

FakeChip::~FakeChip() {
  for (const FakeLine& line : lines) {
    for (const int fd : line.pipe) {
      if (fd >= 0) {
        close(fd);
      }
    }
  }
  the_chip = nullptr;
}

void FakeChip::set(unsigned line, int level) {
  FakeLine& fake = lines.at(line);
  const int before = logical(fake);
  fake.level = level;
  if (fake.pipe[1] >= 0 && logical(fake) != before) {
    const int type = logical(fake) != 0 ? GPIOD_LINE_EVENT_RISING_EDGE : GPIOD_LINE_EVENT_FALLING_EDGE;
    EXPECT_EQ(write(fake.pipe[1], &type, sizeof type), static_cast<ssize_t>(sizeof type));
  }
}

void FakeChip::unplug() {
  for (FakeLine& line : lines) {
    line.readable = false;
    if (line.pipe[1] >= 0) {
      close(line.pipe[1]);  // the reader's end hangs up
      line.pipe[1] = -1;
    }
  }
}

namespace {

using std::chrono_literals::operator""ms;

InputParameters parameters() {
  InputParameters inputs;
  inputs.chip = "gpiochip7";
  inputs.emergency_stop = InputLine{.line = 5, .active_low = true};
  inputs.bumpers[0] = InputLine{.line = 2, .active_low = false};
  inputs.bumpers[6] = InputLine{.line = 3, .active_low = true};
  return inputs;
}

std::string complaint(const InputParameters& inputs) {
  const auto lines = open_gpio_lines(inputs);
  return lines ? "fine" : lines.error().message;
}

class GpioLinesTest : public testing::Test {
 protected:
  GpioLinesTest() {
    chip_.lines[5].level = chip_.lines[3].level = 1;  // closed contacts to the supply
  }
  void open() {
    auto lines = open_gpio_lines(parameters());
    ASSERT_TRUE(lines.ok()) << lines.error().message;
    lines_ = std::move(lines).value();
  }
  FakeChip chip_;
  std::unique_ptr<GpioLines> lines_;
};

TEST_F(GpioLinesTest, ReadEachInputInItsOwnSense) {
  open();
  EXPECT_EQ(lines_->read(), 0);
  chip_.set(5, 0);
  EXPECT_EQ(lines_->read(), 0b1) << "the emergency stop opens its contact, or its wire breaks";
  chip_.set(2, 1);
  EXPECT_EQ(lines_->read(), 0b11);
  chip_.set(3, 0);
  EXPECT_EQ(lines_->read(), 0b10000011);
  chip_.set(5, 1);
  EXPECT_EQ(lines_->read(), 0b10000010);
}

TEST_F(GpioLinesTest, TellOfAPressThatIsOverAndNotOfARelease) {
  open();
  chip_.set(5, 0);
  chip_.set(5, 1);
  chip_.set(3, 0);
  EXPECT_EQ(lines_->wait(10ms), 0b10000001);
  EXPECT_EQ(lines_->wait(1ms), 0) << "told once";
  chip_.set(3, 1);
  EXPECT_EQ(lines_->wait(10ms), 0) << "a release is no press";
}

TEST_F(GpioLinesTest, TakeTheEdgesOfABouncingContactInTurns) {
  open();
  for (int i = 0; i < 100; ++i) {
    chip_.set(2, 1 - i % 2);
  }
  int turns = 0;
  while (lines_->wait(1ms) != 0) {
    ++turns;
  }
  EXPECT_EQ(turns, 7) << "16 edges at a time";
}

TEST_F(GpioLinesTest, DoWithoutEdgesWhereTheChipHasNone) {
  chip_.lines[5].edges_work = chip_.lines[3].edges_work = chip_.lines[2].edges_work = false;
  open();
  EXPECT_EQ(lines_->wait(1ms), 0);
  chip_.set(5, 0);
  EXPECT_EQ(lines_->wait(1ms), 0);
  EXPECT_EQ(lines_->read(), 0b1);
}

TEST_F(GpioLinesTest, ReadNothingOfAChipThatIsUnplugged) {
  open();
  chip_.unplug();
  EXPECT_EQ(lines_->wait(1ms), 0);
  EXPECT_EQ(lines_->wait(1ms), 0);
  EXPECT_EQ(lines_->read(), std::nullopt);
}

TEST_F(GpioLinesTest, GiveTheChipBack) {
  open();
  EXPECT_TRUE(chip_.open);
  lines_.reset();
  EXPECT_FALSE(chip_.open);
}

TEST_F(GpioLinesTest, NameTheChipThatIsMissing) {
  InputParameters inputs = parameters();
  inputs.chip = "gpiochip9";
  EXPECT_EQ(complaint(inputs),
            "inputs.chip: there is no GPIO chip \"gpiochip9\"; expected a name, number, path or label that gpiodetect "
            "lists");
  chip_.open_error = EACCES;
  EXPECT_EQ(complaint(parameters()), "inputs.chip: cannot open GPIO chip \"gpiochip7\": Permission denied");
}

TEST_F(GpioLinesTest, NameTheLineThatDoesNotExist) {
  InputParameters inputs = parameters();
  inputs.bumpers[6]->line = 8;
  EXPECT_EQ(complaint(inputs), "inputs.bumpers[6]: line 8 of gpiochip7 does not exist; expected 0 to 7");
  EXPECT_FALSE(chip_.open) << "what was opened is closed again";
}

TEST_F(GpioLinesTest, NameWhoHasTheLine) {
  chip_.lines[2].user = "fan";
  EXPECT_EQ(complaint(parameters()),
            "inputs.bumpers[0]: line 2 of gpiochip7 is in use by \"fan\"; expected a free one");
  chip_.lines[2].user = "?";
  EXPECT_EQ(complaint(parameters()),
            "inputs.bumpers[0]: line 2 of gpiochip7 is in use by the kernel; expected a free one");
}

TEST_F(GpioLinesTest, NameTheLineThatIsNoInput) {
  chip_.lines[5].edges_work = chip_.lines[5].input_works = false;
  EXPECT_EQ(complaint(parameters()),
            "inputs.emergency_stop: line 5 of gpiochip7 cannot be used as an input: No such device or address");
}

}  // namespace
}  // namespace ivo::hal
