#include "firmware/web/server.hpp"

#include <openssl/ssl.h>

#include <chrono>
#include <utility>

#include "firmware/files/text_file.hpp"
#include "firmware/web/server_loop.hpp"

namespace ivo::firmware::web {
namespace {

constexpr std::chrono::microseconds kTurnEvery = std::chrono::milliseconds(10);
constexpr Duration kLookEvery = std::chrono::seconds(1);  // whether who is connected is still paired
constexpr Duration kGoodbye = std::chrono::milliseconds(500);

std::string& last_log_line() {
  static std::string line;
  return line;
}

void keep_log_line(int /*level*/, const char* line) { last_log_line() = line; }

}  // namespace

Instant ServerLoop::now() {
  return Instant(std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch()));
}

int ServerLoop::port() const { return lws_get_vhost_listen_port(host_); }

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
  lws_sul_schedule(context_, 0, &turn_.timer, on_turn, kTurnEvery.count());
  return {};
}

void ServerLoop::on_turn(lws_sorted_usec_list_t* timer) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): its address is that of its Turn
  ServerLoop& loop = *reinterpret_cast<Turn*>(timer)->loop;
  loop.turn();
  lws_sul_schedule(loop.context_, 0, timer, on_turn, kTurnEvery.count());
}

void ServerLoop::turn() {
  const Instant at = now();
  hub_.turn(at);
  if (turned_) {
    turned_();
  }
  for (const auto& [connection, guest] : guests_) {
    if (at >= guest.until && !sockets_.contains(connection)) {
      lws_set_timeout(connection, PENDING_TIMEOUT_USER_REASON_BASE, LWS_TO_KILL_ASYNC);
    }
  }
  const bool looks = at - looked_at_ >= kLookEvery;
  looked_at_ = looks ? at : looked_at_;
  for (auto& [connection, socket] : sockets_) {
    if (ending_) {
      lws_callback_on_writable(connection);
    } else if (!socket.turn(at) || (looks && forgotten(socket))) {
      lws_set_timeout(connection, PENDING_TIMEOUT_USER_REASON_BASE, LWS_TO_KILL_ASYNC);
    }
  }
}

bool ServerLoop::forgotten(WebSocket& socket) {
  const bool is = !desk_.still_paired(socket.session().paired());
  if (is) {
    socket.close_because("no longer paired");
  }
  return is;
}

void ServerLoop::run(const std::atomic<bool>& stop, std::function<void()> turned) {
  turned_ = std::move(turned);
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
  const Instant until = now() + kGoodbye;
  while (!sockets_.empty() && now() < until && lws_service(context_, 0) >= 0) {
  }
  lws_sul_cancel(&turn_.timer);
  lws_context_destroy(std::exchange(context_, nullptr));
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
void Server::run(const std::atomic<bool>& stop, std::function<void()> turned) { loop_->run(stop, std::move(turned)); }

}  // namespace ivo::firmware::web
