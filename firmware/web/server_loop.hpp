// What libwebsockets calls: connections come and go, requests and messages arrive, there is room to write. The
// library's header stays within the sources that include this.
#pragma once

#include <libwebsockets.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "firmware/web/client_address.hpp"
#include "firmware/web/connection_limits.hpp"
#include "firmware/web/http_exchange.hpp"
#include "firmware/web/server.hpp"
#include "firmware/web/web_socket.hpp"

namespace ivo::firmware::web {

class ServerLoop {
 public:
  static constexpr const char* kPageProtocol = "ivo-console";
  /// For all that is no WebSocket: from the first byte to the whole request, and from each part of an answer to the
  /// next.
  static constexpr Duration kDeadline = std::chrono::seconds(30);

  ServerLoop(Hub& hub, HttpDesk& desk, HttpDesk::Said said) : hub_(hub), desk_(desk), said_(std::move(said)) {}
  ServerLoop(const ServerLoop&) = delete;
  ServerLoop& operator=(const ServerLoop&) = delete;
  ~ServerLoop() { end(); }

  [[nodiscard]] Result<void> listen(const Listening& listening);
  void run(const std::atomic<bool>& stop, std::function<void()> turned);
  [[nodiscard]] int port() const;

  static int on_event(lws* connection, lws_callback_reasons reason, void* user, void* in, size_t size);

 private:
  [[nodiscard]] static Instant now();
  struct Turn {
    lws_sorted_usec_list_t timer{};  // the first member: the library hands out its address
    ServerLoop* loop = nullptr;
  };
  struct Exchange {
    HttpRequest request;
    HttpReply reply;
    bool refused = false;  // what comes of its body counts for nothing
  };

  static void on_turn(lws_sorted_usec_list_t* timer);
  void turn();
  void end();
  [[nodiscard]] int event(lws* connection, lws_callback_reasons reason, void* in, std::size_t size);
  [[nodiscard]] int asked(lws* connection, std::string_view path);
  [[nodiscard]] int body(lws* connection, std::string_view part);
  [[nodiscard]] int answer(lws* connection, const HttpAnswer& answer);
  [[nodiscard]] int refuse(lws* connection, const HttpAnswer& answer);
  [[nodiscard]] int answer_more(lws* connection);
  [[nodiscard]] int upgrade(lws* connection, std::string_view to);
  [[nodiscard]] int established(lws* connection);
  void closed(lws* connection);
  void instantiated(lws* connection);
  void prolong(lws* connection);
  [[nodiscard]] bool forgotten(WebSocket& socket);

  Hub& hub_;
  HttpDesk& desk_;
  HttpDesk::Said said_;
  std::function<void()> turned_;
  lws_context* context_ = nullptr;
  lws_vhost* host_ = nullptr;
  std::array<lws_protocols, 3> protocols_{};
  Turn turn_;
  bool ending_ = false;
  Instant looked_at_{};
  ConnectionLimits limits_;
  struct Guest {
    ClientAddress address;
    Instant until{};  // of what is no WebSocket
  };
  std::map<lws*, Guest> guests_;  // all connections
  std::map<lws*, Exchange> exchanges_;
  struct Visitor {
    Paired paired;
    bool ros = false;
  };
  std::map<lws*, Visitor> visitors_;  // between their request and their WebSocket
  std::map<lws*, WebSocket> sockets_;
};

}  // namespace ivo::firmware::web
