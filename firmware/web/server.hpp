// The server itself: connections of libwebsockets on one side, the hub and the desk on the other. One thread.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "config/base/result.hpp"
#include "firmware/web/http_desk.hpp"
#include "firmware/web/hub.hpp"

namespace ivo::firmware::web {

struct Listening {
  std::string address = "127.0.0.1";  ///< "0.0.0.0" or "::": all of this machine's
  int port = 8080;                    ///< 0: any that is free
  std::string certificate;            ///< file; empty: without TLS
  std::string key;                    ///< file
};

class ServerLoop;

class Server {
 public:
  /// Fails when it cannot listen there, or not with that certificate. `hub` and `desk` outlive this.
  [[nodiscard]] static Result<Server> listen(const Listening& listening, Hub& hub, HttpDesk& desk, HttpDesk::Said said);
  Server(Server&&) noexcept;
  Server& operator=(Server&&) = delete;
  ~Server();

  [[nodiscard]] int port() const;
  /// Until `stop` is set; then says goodbye to everybody. `turned` is called a hundred times a second meanwhile.
  void run(const std::atomic<bool>& stop, std::function<void()> turned);

 private:
  explicit Server(std::unique_ptr<ServerLoop> loop);

  std::unique_ptr<ServerLoop> loop_;
};

}  // namespace ivo::firmware::web
