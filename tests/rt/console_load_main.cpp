// console_load PATH MESSAGES GARBAGE SECONDS: two clients of the console's socket, one that sends so many messages a
// second, by turns a ping, an area and the place of agent 1, and one that sends so many packets a second of which none
// is a message. Both read what comes and heed nothing. Ends early with the controller, and says what it sent and heard.
// Seeded: each run sends the same.
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <thread>

#include "firmware/console/console_messages.hpp"
#include "firmware/console/socket_path.hpp"

namespace ivo::firmware::console {
namespace {

using Clock = std::chrono::steady_clock;

struct Sent {
  int messages = 0;
  int garbage = 0;
  int full = 0;  // the controller was slower than we
  int heard = 0;
};

bool gone(int error) { return error == EPIPE || error == ECONNRESET; }

// False when the controller has ended.
bool say(int socket, const void* packet, std::size_t size, int& count, int& full) {
  if (::send(socket, packet, size, MSG_DONTWAIT | MSG_NOSIGNAL) >= 0) {
    ++count;
    return true;
  }
  ++full;
  return !gone(errno);
}

AreaCommand area(std::uint32_t sequence) {
  AreaCommand area;
  area.header = {.kind = Kind::kPutArea, .size = sizeof(AreaCommand), .sequence = sequence};
  area.slot = kAreaSlots - 1;
  area.agent = 1;
  area.corners = 3;
  area.corner[0] = {3.0, 3.0};
  area.corner[1] = {6.0, 3.0};
  area.corner[2] = {3.0, 6.0 + sequence % 7};
  return area;
}

PoseCommand pose(std::uint32_t sequence) {
  PoseCommand pose;
  pose.header = {.kind = Kind::kPose, .size = sizeof(PoseCommand), .sequence = sequence};
  pose.agent = 1;
  pose.x_m = 3.0 + sequence % 7;
  pose.y_m = 3.0;
  return pose;
}

template <class Message>
bool say(int socket, const Message& message, int& count, int& full) {
  return say(socket, &message, sizeof(message), count, full);
}

bool say_in_turn(int socket, Sent& sent) {
  const std::uint32_t sequence = static_cast<std::uint32_t>(sent.messages) + 1;
  switch (sequence % 3) {
    case 0:
      return say(socket, pose(sequence), sent.messages, sent.full);
    case 1:
      return say(socket, Command{.header = {.kind = Kind::kPing, .size = sizeof(Command), .sequence = sequence}},
                 sent.messages, sent.full);
    default:
      return say(socket, area(sequence), sent.messages, sent.full);
  }
}

void hear(int socket, int& heard) {
  std::array<std::byte, sizeof(DocumentPart)> packet{};
  while (::recv(socket, packet.data(), packet.size(), MSG_DONTWAIT) > 0) {
    ++heard;
  }
}

class Garbage {
 public:
  bool send(int socket, Sent& sent) {
    Command spoilt{.header = {.kind = Kind::kPing, .size = sizeof(Command), .sequence = 1}};
    std::size_t size = sizeof(spoilt);
    switch (random_() % 10) {
      case 0:
        spoilt.header.magic = static_cast<std::uint32_t>(random_()) | 1U << 31U;
        break;
      case 1:
        spoilt.header.version = static_cast<std::uint16_t>(kVersion + 1 + random_() % 100);
        break;
      case 2:
        spoilt.header.kind = static_cast<Kind>(16 + random_() % 1000);
        break;
      case 3:
        spoilt.header.size = 25 + static_cast<std::uint32_t>(random_() % 1000);
        break;
      case 4:
        spoilt.argument = 1;
        break;
      case 5:
        spoilt.header.sequence = 2 + static_cast<std::uint32_t>(random_() % 1000);
        break;
      case 6:
        size = random_() % sizeof(spoilt);
        break;
      case 7:
        return say(socket, spoilt_area(), sent.garbage, sent.full);
      case 8:
        return say(socket, spoilt_pose(), sent.garbage, sent.full);
      default:
        for (std::byte& byte : noise_) {
          byte = static_cast<std::byte>(random_());
        }
        return say(socket, noise_.data(), sizeof(Command) + 1 + random_() % 1000, sent.garbage, sent.full);
    }
    return say(socket, &spoilt, size, sent.garbage, sent.full);
  }

 private:
  static constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

  AreaCommand spoilt_area() {
    AreaCommand spoilt = area(1);
    switch (random_() % 6) {
      case 0:
        spoilt.slot = static_cast<std::uint8_t>(kAreaSlots + random_() % 100);
        break;
      case 1:
        spoilt.corners = static_cast<std::uint8_t>(random_() % 3);
        break;
      case 2:
        spoilt.corners = static_cast<std::uint8_t>(kAreaCorners + 1 + random_() % 100);
        break;
      case 3:
        spoilt.corner[random_() % 3].x_m = kNotANumber;
        break;
      case 4:
        spoilt.corner[3 + random_() % (kAreaCorners - 3)].y_m = 1.0;
        break;
      default:
        spoilt.header.size = sizeof(PoseCommand);
        break;
    }
    return spoilt;
  }

  PoseCommand spoilt_pose() {
    PoseCommand spoilt = pose(1);
    switch (random_() % 5) {
      case 0:
        spoilt.agent = static_cast<std::uint8_t>(kAgents + random_() % 100);
        break;
      case 1:
        spoilt.zero[random_() % spoilt.zero.size()] = 1;
        break;
      case 2:
        spoilt.x_m = -std::numeric_limits<double>::infinity();
        break;
      case 3:
        spoilt.heading_rad = kNotANumber;
        break;
      default:
        spoilt.age_s = 11.0;
        break;
    }
    return spoilt;
  }

  std::mt19937 random_{1};
  std::array<std::byte, 1100> noise_{};
};

int load(const std::string& path, int messages, int garbage, int seconds) {
  const Result<hal::FileDescriptor> polite = connect_to(path);
  const Result<hal::FileDescriptor> rude = connect_to(path);
  for (const Result<hal::FileDescriptor>* socket : {&polite, &rude}) {
    if (!*socket) {
      (void)std::fprintf(stderr, "console_load: %s\n", socket->error().message.c_str());
      return 1;
    }
  }
  Sent sent;
  Garbage noise;
  const Clock::time_point begin = Clock::now();
  bool here = true;
  // A tick of ten milliseconds sends what is due by then.
  for (long tick = 0; here && tick < 100L * seconds; ++tick) {
    std::this_thread::sleep_until(begin + std::chrono::milliseconds(10 * tick));
    while (here && sent.messages < messages * tick / 100) {
      here = say_in_turn(polite.value().get(), sent);
    }
    for (long due = garbage * tick / 100 - sent.garbage - sent.full; here && due > 0; --due) {
      here = noise.send(rude.value().get(), sent);
    }
    hear(polite.value().get(), sent.heard);
    hear(rude.value().get(), sent.heard);
  }
  std::printf("%d messages, %d of garbage sent; %d not taken; %d messages heard\n", sent.messages, sent.garbage,
              sent.full, sent.heard);
  return 0;
}

}  // namespace
}  // namespace ivo::firmware::console

int main(int argc, char** argv) {
  if (argc != 5) {
    (void)std::fprintf(stderr, "usage: console_load PATH MESSAGES GARBAGE SECONDS\n");
    return 2;
  }
  return ivo::firmware::console::load(argv[1], std::atoi(argv[2]), std::atoi(argv[3]), std::atoi(argv[4]));
}
