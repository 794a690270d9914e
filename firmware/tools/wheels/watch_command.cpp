#include <unistd.h>

#include <array>
#include <cstdio>
#include <memory>

#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/stop_signal.hpp"
#include "firmware/tools/terminal.hpp"
#include "firmware/tools/wheels/live_picture.hpp"
#include "firmware/tools/wheels/watch_text.hpp"
#include "firmware/tools/wheels/wheels_options.hpp"
#include "firmware/tools/wheels/wheels_world.hpp"

namespace ivo::firmware::wheels {
namespace {

constexpr Duration kLook = std::chrono::milliseconds(5);
constexpr int kDrawEvery = 20;  // looks
constexpr int kBatches = 4;     // of frames in one look: more than any bus carries

}  // namespace

int watch(const Options& options) {
  const Result<std::unique_ptr<World>> opened = World::open(options, World::Purpose::kLook);
  if (!opened) {
    return refuse(opened.error());
  }
  World& world = *opened.value();
  const bool live = isatty(STDOUT_FILENO) != 0;
  say("bus", world.description());
  say("robot", world.robot().name + ", " + world.robot_source());
  if (live) {
    say("watching", "nothing is sent; Ctrl-C ends");
    (void)std::printf("\n");
  }
  stop_on_signals();

  hal::Clock& clock = world.clock();
  const Instant begin = clock.now();
  BusListener listener(world.robot());
  LivePicture picture;
  ChangeLog changes(world.robot(), [&](const std::string& text) {
    say(format("%.3f s", seconds(clock.now() - begin)).c_str(), text);
  });
  const auto frames = std::make_unique<std::array<hal::ReceivedFrame, limits::kFramesPerCycle>>();
  int looks = 0;
  for (Instant now = begin; !stop_asked() && std::ferror(stdout) == 0;) {
    if (options.seconds && seconds(now - begin) >= *options.seconds) {
      break;
    }
    for (int batch = 0; batch < kBatches; ++batch) {
      const std::size_t count = world.bus().receive(*frames, now);
      for (std::size_t i = 0; i < count; ++i) {
        listener.on_frame((*frames)[i]);
      }
    }
    listener.update(now);
    const BusView bus{world.bus().state(), world.bus().counters()};
    if (!live) {
      changes.update(listener, bus, now);
    } else if (looks++ % kDrawEvery == 0) {
      picture.draw(watch_picture(listener, world.robot(), bus, now));
    }
    world.after_cycle();
    clock.sleep_until(now + kLook);
    now = clock.now();
  }
  (void)std::printf("\n");
  say("heard", format("%llu frames in %.1f s", static_cast<unsigned long long>(listener.frames()),
                      seconds(clock.now() - begin)));
  return exit_status::kEnded;
}

}  // namespace ivo::firmware::wheels
