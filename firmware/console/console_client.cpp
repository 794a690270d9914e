#include "firmware/console/console_client.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <utility>

#include "firmware/console/socket_path.hpp"

namespace ivo::firmware::console {
namespace {

using Clock = std::chrono::steady_clock;

template <class Message>
std::optional<Message> read_as(Kind kind, const std::byte* packet, std::size_t size) {
  Message message;
  if (size != sizeof(Message)) {
    return std::nullopt;
  }
  std::memcpy(&message, packet, sizeof(Message));
  const Header& header = message.header;
  return header.magic == kMagic && header.version == kVersion && header.kind == kind && header.size == size
             ? std::optional(message)
             : std::nullopt;
}

}  // namespace

Result<ConsoleClient> ConsoleClient::connect(const std::string& path, std::chrono::seconds patience) {
  Result<hal::FileDescriptor> socket = connect_to(path);
  if (!socket) {
    return socket.error();
  }
  return ConsoleClient(path, std::move(socket).value(), patience);
}

Result<Status> ConsoleClient::status() {
  const Clock::time_point until = Clock::now() + patience_;
  for (;;) {
    const Result<Heard> heard = hear(until);
    if (!heard) {
      return heard.error();
    }
    if (heard.value().status) {
      return *heard.value().status;
    }
    if (heard.value().answer && heard.value().answer->verdict == Verdict::kTooManyClients) {
      return Error{path_ + ": " + std::to_string(kClients) +
                   " clients are connected already; expected one of them to go first"};
    }
  }
}

Result<std::string> ConsoleClient::document(Document document) {
  const std::optional<std::string>& whole = documents_[place_of(document)];
  const Clock::time_point until = Clock::now() + patience_;
  while (!whole) {
    if (const Result<Heard> heard = hear(until); !heard) {
      return heard.error();
    }
  }
  return *whole;
}

Result<Verdict> ConsoleClient::command(Kind kind, std::uint32_t question, std::uint32_t argument) {
  return say(Command{.header = {}, .question = question, .argument = argument}, kind);
}

Result<Verdict> ConsoleClient::put(AreaCommand area) { return say(area, Kind::kPutArea); }

Result<Verdict> ConsoleClient::report(PoseCommand pose) { return say(pose, Kind::kPose); }

template <class Message>
Result<Verdict> ConsoleClient::say(Message message, Kind kind) {
  message.header = {.kind = kind, .size = sizeof(Message), .sequence = ++said_};
  if (::send(socket_.get(), &message, sizeof(message), MSG_NOSIGNAL) != sizeof(message)) {
    return Error{path_ + ": the controller does not listen any more: " + std::strerror(errno)};
  }
  const Clock::time_point until = Clock::now() + patience_;
  for (;;) {
    const Result<Heard> heard = hear(until);
    if (!heard) {
      return heard.error();
    }
    if (heard.value().answer && heard.value().answer->of_sequence == said_) {
      return heard.value().answer->verdict;
    }
  }
}

void ConsoleClient::gather(const DocumentPart& part) {
  const auto number = static_cast<std::size_t>(part.document);
  if (number < 1 || number > kDocuments) {
    return;
  }
  DocumentAssembly& parts = parts_[number - 1];
  if (parts.add(part) == DocumentAssembly::Outcome::kWhole) {
    documents_[number - 1] = parts.take();
  }
}

Result<ConsoleClient::Heard> ConsoleClient::hear(Clock::time_point until) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
  pollfd input{.fd = socket_.get(), .events = POLLIN, .revents = 0};
  if (::poll(&input, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0))) <= 0) {
    return Error{path_ + ": the controller is silent; expected a status " + std::to_string(kStatusPerSecond) +
                 " times a second"};
  }
  std::array<std::byte, sizeof(DocumentPart)> packet{};
  const ssize_t size = ::recv(socket_.get(), packet.data(), packet.size(), MSG_TRUNC);
  if (size <= 0) {
    return Error{path_ + ": the controller has ended"};
  }
  Heard heard;
  heard.status = read_as<Status>(Kind::kStatus, packet.data(), static_cast<std::size_t>(size));
  heard.answer = read_as<Answer>(Kind::kAnswer, packet.data(), static_cast<std::size_t>(size));
  if (const auto part = read_as<DocumentPart>(Kind::kDocumentPart, packet.data(), static_cast<std::size_t>(size))) {
    gather(*part);
    return heard;
  }
  if (!heard.status && !heard.answer) {
    return Error{path_ + ": who listens there does not speak as this program does; expected version " +
                 std::to_string(kVersion) + " of the console's messages"};
  }
  return heard;
}

}  // namespace ivo::firmware::console
