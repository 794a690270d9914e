#include "firmware/console/socket_path.hpp"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace ivo::firmware::console {
namespace {

constexpr mode_t kMode = 0660;
constexpr int kWaiting = 8;  // connections that nobody has taken yet

Error failure(const std::string& path, const char* what) {
  return Error{path + ": " + what + ": " + std::strerror(errno)};
}

Result<sockaddr_un> address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof(address.sun_path)) {
    return Error{"\"" + path + "\" is no name for a socket; expected a path of 1 to " +
                 std::to_string(sizeof(address.sun_path) - 1) + " bytes"};
  }
  path.copy(&address.sun_path[0], path.size());
  return address;
}

// NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): how the system calls want it
const sockaddr* general(const sockaddr_un& address) { return reinterpret_cast<const sockaddr*>(&address); }

hal::FileDescriptor made(int flags) {
  return hal::FileDescriptor(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | flags, 0));
}

/// Removes the socket of a process that is gone; fails with whatever else is there.
Result<void> remove_what_is_left(const std::string& path, const sockaddr_un& address) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) {
    return failure(path, "cannot be listened at");
  }
  if (!S_ISSOCK(status.st_mode)) {
    return Error{path + ": is there already and is no socket; expected a name that is free"};
  }
  const hal::FileDescriptor asking = made(SOCK_NONBLOCK);
  if (::connect(asking.get(), general(address), sizeof(address)) == 0 || errno != ECONNREFUSED) {
    return Error{path + ": another process listens there; expected one controller at a time"};
  }
  return ::unlink(path.c_str()) == 0 ? Result<void>() : failure(path, "cannot be replaced");
}

std::uint64_t inode_of(const std::string& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 ? status.st_ino : 0;
}

Result<hal::FileDescriptor> connected(const std::string& path, int flags) {
  const Result<sockaddr_un> address = address_of(path);
  if (!address) {
    return address.error();
  }
  hal::FileDescriptor connection = made(flags);
  if (!connection.valid() || ::connect(connection.get(), general(address.value()), sizeof(sockaddr_un)) != 0) {
    return errno == ECONNREFUSED || errno == ENOENT
               ? Error{path + ": nobody listens there; expected a controller that runs, as ivo run --console " + path}
               : failure(path, "cannot be connected to");
  }
  return connection;
}

}  // namespace

Listener::Listener(std::string path, hal::FileDescriptor socket)
    : path_(std::move(path)), inode_(inode_of(path_)), socket_(std::move(socket)) {}

void Listener::close() {
  if (socket_.valid() && inode_of(path_) == inode_) {
    (void)::unlink(path_.c_str());
  }
  socket_.close();
}

Result<Listener> Listener::at(const std::string& path) {
  const Result<sockaddr_un> address = address_of(path);
  if (!address) {
    return address.error();
  }
  hal::FileDescriptor listener = made(SOCK_NONBLOCK);
  // Before the name is there, so that nobody gets in early; again after, for the umask may have taken the group's part.
  if (!listener.valid() || ::fchmod(listener.get(), kMode) != 0) {
    return failure(path, "cannot be listened at");
  }
  const auto bound = [&] { return ::bind(listener.get(), general(address.value()), sizeof(sockaddr_un)) == 0; };
  if (!bound()) {
    if (errno != EADDRINUSE) {
      return failure(path, "cannot be listened at");
    }
    if (const Result<void> removed = remove_what_is_left(path, address.value()); !removed) {
      return removed.error();
    }
    if (!bound()) {
      return failure(path, "cannot be listened at");
    }
  }
  if (::chmod(path.c_str(), kMode) != 0 || ::listen(listener.get(), kWaiting) != 0) {
    const Error error = failure(path, "cannot be listened at");
    (void)::unlink(path.c_str());
    return error;
  }
  return Listener(path, std::move(listener));
}

Result<hal::FileDescriptor> connect_to(const std::string& path) { return connected(path, 0); }

Result<hal::FileDescriptor> connect_at_once(const std::string& path) { return connected(path, SOCK_NONBLOCK); }

}  // namespace ivo::firmware::console
