#include "firmware/web/server.hpp"

#include <libwebsockets.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/ssl.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <map>
#include <optional>
#include <utility>

#include "firmware/files/text_file.hpp"
#include "firmware/web/connection_limits.hpp"
#include "firmware/web/http_exchange.hpp"
#include "firmware/web/web_socket.hpp"

namespace ivo::firmware::web {
namespace {

constexpr std::chrono::microseconds kTurnEvery = std::chrono::milliseconds(10);
constexpr Duration kGoodbye = std::chrono::milliseconds(500);
constexpr const char* kPageProtocol = "ivo-console";
constexpr std::string_view kPagePath = "/session";

std::string& last_log_line() {
  static std::string line;
  return line;
}

void keep_log_line(int /*level*/, const char* line) { last_log_line() = line; }

Instant now_of_server() {
  return Instant(std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch()));
}

/// So that what is written is what is read: no backlog of old statuses in the kernel.
void keep_little_unsent(int socket) {
  const int bytes = 16'384;
  (void)::setsockopt(socket, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &bytes, sizeof(bytes));
  const int at_once = 1;
  (void)::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof(at_once));
}

std::string address_text(const sockaddr_storage& address) {
  std::array<char, 64> name{};
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): how the system calls want it
  const int failed = ::getnameinfo(reinterpret_cast<const sockaddr*>(&address), sizeof(address), name.data(),
                                   name.size(), nullptr, 0, NI_NUMERICHOST);
  return failed == 0 ? name.data() : "";
}

}  // namespace

class ServerLoop {
 public:
  ServerLoop(Hub& hub, HttpDesk& desk, HttpDesk::Said said) : hub_(hub), desk_(desk), said_(std::move(said)) {}
  ServerLoop(const ServerLoop&) = delete;
  ServerLoop& operator=(const ServerLoop&) = delete;
  ~ServerLoop() { end(); }

  [[nodiscard]] Result<void> listen(const Listening& listening);
  void run(const std::atomic<bool>& stop);
  [[nodiscard]] int port() const { return lws_get_vhost_listen_port(host_); }

  static int on_event(lws* connection, lws_callback_reasons reason, void* user, void* in, size_t size);

 private:
  struct Turn {
    lws_sorted_usec_list_t timer{};  // the first member: the library hands out its address
    ServerLoop* loop = nullptr;
  };
  struct Exchange {
    HttpRequest request;
    HttpReply reply;
    bool then_close = false;
  };

  static void on_turn(lws_sorted_usec_list_t* timer);
  void turn();
  void end();
  [[nodiscard]] int event(lws* connection, lws_callback_reasons reason, void* in, std::size_t size);
  [[nodiscard]] int asked(lws* connection, std::string_view path);
  [[nodiscard]] int body(lws* connection, std::string_view part);
  [[nodiscard]] int answer(lws* connection, const HttpAnswer& answer, bool then_close);
  [[nodiscard]] int answer_more(lws* connection);
  [[nodiscard]] int upgrade(lws* connection, std::string_view to);
  [[nodiscard]] int established(lws* connection);
  void closed(lws* connection);
  void instantiated(lws* connection);

  Hub& hub_;
  HttpDesk& desk_;
  HttpDesk::Said said_;
  lws_context* context_ = nullptr;
  lws_vhost* host_ = nullptr;
  std::array<lws_protocols, 3> protocols_{};
  Turn turn_;
  bool ending_ = false;
  ConnectionLimits limits_;
  std::map<lws*, std::string> addresses_;
  std::map<lws*, Exchange> exchanges_;
  struct Visitor {
    Paired paired;
    bool ros = false;
  };
  std::map<lws*, Visitor> visitors_;  // between their request and their WebSocket
  std::map<lws*, WebSocket> sockets_;
};

Result<void> ServerLoop::listen(const Listening& listening) {
  lws_set_log_level(LLL_ERR, keep_log_line);
  for (std::size_t i = 0; i + 1 < protocols_.size(); ++i) {
    protocols_.at(i).name = i == 0 ? "http" : kPageProtocol;
    protocols_.at(i).callback = on_event;
    protocols_.at(i).rx_buffer_size = 4096;
  }
  const bool tls = !listening.certificate.empty();
  const bool six = listening.address.find(':') != std::string::npos;
  lws_context_creation_info info{};
  info.port = CONTEXT_PORT_NO_LISTEN;
  info.uid = info.gid = static_cast<decltype(info.gid)>(-1);
  info.user = this;
  info.options = LWS_SERVER_OPTION_EXPLICIT_VHOSTS | LWS_SERVER_OPTION_VALIDATE_UTF8 |
                 (tls ? LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT : 0);
  info.server_string = "ivo-console";
  context_ = lws_create_context(&info);
  if (context_ == nullptr) {
    return Error{"libwebsockets does not start: " + last_log_line()};
  }
  const bool everywhere = listening.address == "0.0.0.0" || listening.address == "::";
  info.port = listening.port;
  info.iface = everywhere ? nullptr : listening.address.c_str();
  info.protocols = protocols_.data();
  info.options |= LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND | (six ? 0 : LWS_SERVER_OPTION_DISABLE_IPV6);
  info.keepalive_timeout = 30;
  info.timeout_secs = 10;
  info.alpn = "http/1.1";
  if (tls) {
    info.ssl_cert_filepath = listening.certificate.c_str();
    info.ssl_private_key_filepath = listening.key.c_str();
    info.ssl_options_set = static_cast<long>(SSL_OP_NO_SSLv3 | SSL_OP_NO_TLSv1 | SSL_OP_NO_TLSv1_1);
  }
  host_ = lws_create_vhost(context_, &info);
  if (host_ == nullptr) {
    return Error{listening.address + ":" + std::to_string(listening.port) + ": cannot be listened at" +
                 (tls ? ", or not with that certificate" : "") +
                 "; expected an address of this machine and a free port"};
  }
  turn_.loop = this;
  on_turn(&turn_.timer);
  return {};
}

void ServerLoop::on_turn(lws_sorted_usec_list_t* timer) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): its address is that of its Turn
  ServerLoop& loop = *reinterpret_cast<Turn*>(timer)->loop;
  loop.turn();
  lws_sul_schedule(loop.context_, 0, timer, on_turn, kTurnEvery.count());
}

void ServerLoop::turn() {
  const Instant now = now_of_server();
  hub_.turn(now);
  for (auto& [connection, socket] : sockets_) {
    if (ending_) {
      lws_callback_on_writable(connection);
    } else if (!socket.turn(now)) {
      lws_set_timeout(connection, PENDING_TIMEOUT_USER_REASON_BASE, LWS_TO_KILL_ASYNC);
    }
  }
}

void ServerLoop::run(const std::atomic<bool>& stop) {
  while (!stop.load()) {
    if (lws_service(context_, 0) < 0) {
      break;
    }
  }
  end();
}

void ServerLoop::end() {
  if (context_ == nullptr) {
    return;
  }
  ending_ = true;
  const Instant until = now_of_server() + kGoodbye;
  while (!sockets_.empty() && now_of_server() < until && lws_service(context_, 0) >= 0) {
  }
  lws_sul_cancel(&turn_.timer);
  lws_context_destroy(std::exchange(context_, nullptr));
}

int ServerLoop::on_event(lws* connection, lws_callback_reasons reason, void* /*user*/, void* in, size_t size) {
  lws_context* const context = connection != nullptr ? lws_get_context(connection) : nullptr;
  auto* const loop = context != nullptr ? static_cast<ServerLoop*>(lws_context_user(context)) : nullptr;
  return loop != nullptr ? loop->event(connection, reason, in, size) : 0;
}

int ServerLoop::event(lws* connection, lws_callback_reasons reason, void* in, std::size_t size) {
  const std::string_view text(in != nullptr ? static_cast<const char*>(in) : "", in != nullptr ? size : 0);
  switch (reason) {
    case LWS_CALLBACK_FILTER_NETWORK_CONNECTION:
      return limits_.allows(address_text(static_cast<lws_filter_network_conn_args*>(in)->cli_addr)) ? 0 : -1;
    case LWS_CALLBACK_SERVER_NEW_CLIENT_INSTANTIATED:
      instantiated(connection);
      return 0;
    case LWS_CALLBACK_HTTP:
      return asked(connection, text);
    case LWS_CALLBACK_HTTP_BODY:
    case LWS_CALLBACK_HTTP_BODY_COMPLETION:
      return body(connection, reason == LWS_CALLBACK_HTTP_BODY ? text : std::string_view());
    case LWS_CALLBACK_HTTP_WRITEABLE:
      return answer_more(connection);
    case LWS_CALLBACK_HTTP_CONFIRM_UPGRADE:
      return upgrade(connection, in != nullptr ? static_cast<const char*>(in) : "");
    case LWS_CALLBACK_ESTABLISHED:
      return established(connection);
    case LWS_CALLBACK_CLOSED:
    case LWS_CALLBACK_WSI_DESTROY:
      closed(connection);
      return 0;
    default:
      break;
  }
  const auto found = sockets_.find(connection);
  if (found == sockets_.end()) {
    return 0;
  }
  const Instant now = now_of_server();
  WebSocket& socket = found->second;
  if (ending_ && reason == LWS_CALLBACK_SERVER_WRITEABLE) {
    lws_close_reason(connection, LWS_CLOSE_STATUS_GOINGAWAY, nullptr, 0);
    return -1;
  }
  const bool goes_on = reason == LWS_CALLBACK_RECEIVE            ? socket.received(text, now)
                       : reason == LWS_CALLBACK_RECEIVE_PONG     ? socket.pong(now)
                       : reason == LWS_CALLBACK_SERVER_WRITEABLE ? socket.writable(now)
                                                                 : true;
  return goes_on ? 0 : -1;
}

void ServerLoop::instantiated(lws* connection) {
  const std::string address = peer_of(connection);
  if (addresses_.emplace(connection, address).second) {
    limits_.opened(address);
  }
  keep_little_unsent(lws_get_socket_fd(connection));
}

int ServerLoop::asked(lws* connection, std::string_view path) {
  Exchange& exchange = exchanges_[connection];
  exchange = {};
  exchange.request = request_of(connection, std::string(path));
  const std::size_t announced = announced_body(connection);
  const std::size_t most = HttpDesk::longest_body(exchange.request);
  if (announced > most) {
    return answer(connection, answer_of(413, "{\"error\":\"too_large\"}"), true);
  }
  if (announced > 0) {
    return 0;  // its body comes
  }
  return answer(connection, desk_.answer(exchange.request, now_of_server()), false);
}

int ServerLoop::body(lws* connection, std::string_view part) {
  const auto found = exchanges_.find(connection);
  if (found == exchanges_.end()) {
    return -1;
  }
  HttpRequest& request = found->second.request;
  if (part.empty()) {
    return answer(connection, desk_.answer(request, now_of_server()), false);
  }
  if (request.body.size() + part.size() > HttpDesk::longest_body(request)) {
    return -1;
  }
  request.body += part;
  return 0;
}

int ServerLoop::answer(lws* connection, const HttpAnswer& answer, bool then_close) {
  Exchange& exchange = exchanges_[connection];
  exchange.then_close = then_close;
  if (!exchange.reply.begin(connection, answer, then_close)) {
    return -1;
  }
  if (answer.body == nullptr || answer.body->empty()) {
    exchanges_.erase(connection);
    return then_close || lws_http_transaction_completed(connection) != 0 ? -1 : 0;
  }
  lws_callback_on_writable(connection);
  return 0;
}

int ServerLoop::answer_more(lws* connection) {
  const auto found = exchanges_.find(connection);
  if (found == exchanges_.end()) {
    return 0;
  }
  switch (found->second.reply.go_on(connection)) {
    case HttpReply::State::kMore:
      lws_callback_on_writable(connection);
      return 0;
    case HttpReply::State::kDone: {
      const bool then_close = found->second.then_close;
      exchanges_.erase(found);
      return then_close || lws_http_transaction_completed(connection) != 0 ? -1 : 0;
    }
    case HttpReply::State::kBroken:
      break;
  }
  return -1;
}

int ServerLoop::upgrade(lws* connection, std::string_view to) {
  if (to != "websocket") {
    return -1;
  }
  std::array<char, 256> path{};
  if (lws_hdr_copy(connection, path.data(), static_cast<int>(path.size()), WSI_TOKEN_GET_URI) <= 0) {
    return -1;
  }
  const HttpRequest request = request_of(connection, path.data());
  const bool page = request.path == kPagePath && subprotocol_of(connection) == kPageProtocol;
  const std::optional<Paired> paired = desk_.visitor(request);
  if (paired) {
    visitors_[connection] = {.paired = *paired, .ros = !page};
    return 0;
  }
  HttpReply reply;
  if (!reply.begin(connection, answer_of(403, "{\"error\":\"not_paired\"}"), true) ||
      reply.go_on(connection) != HttpReply::State::kDone) {
    return -1;
  }
  return 1;
}

int ServerLoop::established(lws* connection) {
  const auto found = visitors_.find(connection);
  if (found == visitors_.end()) {
    return -1;
  }
  const Visitor visitor = found->second;
  visitors_.erase(found);
  const Instant now = now_of_server();
  Session& session = hub_.came(visitor.paired, visitor.ros, now);
  sockets_.try_emplace(connection, connection, session, visitor.ros, now);
  said_("screen " + std::to_string(session.screen()) + ", " + visitor.paired.name + (visitor.ros ? " (ROS)" : "") +
        ": connected");
  lws_callback_on_writable(connection);
  return 0;
}

void ServerLoop::closed(lws* connection) {
  if (const auto found = sockets_.find(connection); found != sockets_.end()) {
    const Screen screen = found->second.session().screen();
    said_("screen " + std::to_string(screen) + ", " + found->second.session().paired().name + ": " +
          found->second.complaint());
    sockets_.erase(found);
    hub_.went(screen, now_of_server());
  }
  exchanges_.erase(connection);
  visitors_.erase(connection);
  if (const auto found = addresses_.find(connection); found != addresses_.end()) {
    limits_.closed(found->second);
    addresses_.erase(found);
  }
}

Server::Server(std::unique_ptr<ServerLoop> loop) : loop_(std::move(loop)) {}
Server::Server(Server&&) noexcept = default;
Server::~Server() = default;

Result<Server> Server::listen(const Listening& listening, Hub& hub, HttpDesk& desk, HttpDesk::Said said) {
  for (const std::string& file : {listening.certificate, listening.key}) {
    if (const Result<std::string> text = file.empty() ? std::string() : read_file(file); !text) {
      return text.error();
    }
  }
  auto loop = std::make_unique<ServerLoop>(hub, desk, std::move(said));
  if (const Result<void> listens = loop->listen(listening); !listens) {
    return listens.error();
  }
  return Server(std::move(loop));
}

int Server::port() const { return loop_->port(); }
void Server::run(const std::atomic<bool>& stop) { loop_->run(stop); }

}  // namespace ivo::firmware::web
