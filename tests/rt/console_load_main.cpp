// console_load PATH PINGS GARBAGE SECONDS: two clients of the console's socket, one that sends so many pings a second
// and one that sends so many packets a second of which none is a message. Both read what comes and heed nothing. Ends
// early with the controller, and says what it sent and heard. Seeded: each run sends the same.
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <thread>

#include "firmware/console/console_messages.hpp"
#include "firmware/console/socket_path.hpp"

namespace ivo::firmware::console {
namespace {

using Clock = std::chrono::steady_clock;

struct Sent {
  int pings = 0;
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

void hear(int socket, int& heard) {
  std::array<std::byte, sizeof(Status)> packet{};
  while (::recv(socket, packet.data(), packet.size(), MSG_DONTWAIT) > 0) {
    ++heard;
  }
}

class Garbage {
 public:
  bool send(int socket, Sent& sent) {
    Command spoilt{.header = {.kind = Kind::kPing, .size = sizeof(Command), .sequence = 1}};
    std::size_t size = sizeof(spoilt);
    switch (random_() % 8) {
      case 0:
        spoilt.header.magic = static_cast<std::uint32_t>(random_()) | 1U << 31U;
        break;
      case 1:
        spoilt.header.version = static_cast<std::uint16_t>(kVersion + 1 + random_() % 100);
        break;
      case 2:
        spoilt.header.kind = static_cast<Kind>(6 + random_() % 1000);
        break;
      case 3:
        spoilt.header.size = 25 + static_cast<std::uint32_t>(random_() % 1000);
        break;
      case 4:
        spoilt.zero = 1;
        break;
      case 5:
        spoilt.header.sequence = 2 + static_cast<std::uint32_t>(random_() % 1000);
        break;
      case 6:
        size = random_() % sizeof(spoilt);
        break;
      default:
        for (std::byte& byte : noise_) {
          byte = static_cast<std::byte>(random_());
        }
        return say(socket, noise_.data(), sizeof(Command) + 1 + random_() % 1000, sent.garbage, sent.full);
    }
    return say(socket, &spoilt, size, sent.garbage, sent.full);
  }

 private:
  std::mt19937 random_{1};
  std::array<std::byte, 1100> noise_{};
};

int load(const std::string& path, int pings, int garbage, int seconds) {
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
  std::uint32_t sequence = 0;
  const Clock::time_point begin = Clock::now();
  bool here = true;
  // A tick of ten milliseconds sends what is due by then.
  for (long tick = 0; here && tick < 100L * seconds; ++tick) {
    std::this_thread::sleep_until(begin + std::chrono::milliseconds(10 * tick));
    while (here && sent.pings < pings * tick / 100) {
      const Command ping{.header = {.kind = Kind::kPing, .size = sizeof(Command), .sequence = ++sequence}};
      here = say(polite.value().get(), &ping, sizeof(ping), sent.pings, sent.full);
    }
    for (long due = garbage * tick / 100 - sent.garbage - sent.full; here && due > 0; --due) {
      here = noise.send(rude.value().get(), sent);
    }
    hear(polite.value().get(), sent.heard);
    hear(rude.value().get(), sent.heard);
  }
  std::printf("%d pings, %d of garbage sent; %d not taken; %d messages heard\n", sent.pings, sent.garbage, sent.full,
              sent.heard);
  return 0;
}

}  // namespace
}  // namespace ivo::firmware::console

int main(int argc, char** argv) {
  if (argc != 5) {
    (void)std::fprintf(stderr, "usage: console_load PATH PINGS GARBAGE SECONDS\n");
    return 2;
  }
  return ivo::firmware::console::load(argv[1], std::atoi(argv[2]), std::atoi(argv[3]), std::atoi(argv[4]));
}
