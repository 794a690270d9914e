#include "firmware/web/server_loop.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <optional>

namespace ivo::firmware::web {
namespace {

constexpr std::string_view kPagePath = "/session";

/// So that what is written is what is read: no backlog of old statuses in the kernel.
void keep_little_unsent(int socket) {
  const int bytes = 16'384;
  (void)::setsockopt(socket, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &bytes, sizeof(bytes));
  const int at_once = 1;
  (void)::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof(at_once));
}

}  // namespace

int ServerLoop::on_event(lws* connection, lws_callback_reasons reason, void* user, void* in, size_t size) {
  lws_context* const context = connection != nullptr ? lws_get_context(connection) : nullptr;
  auto* const loop = context != nullptr ? static_cast<ServerLoop*>(lws_context_user(context)) : nullptr;
  if (loop != nullptr && reason == LWS_CALLBACK_FILTER_NETWORK_CONNECTION) {
    return loop->limits_.allows(client_address(static_cast<lws_filter_network_conn_args*>(user)->cli_addr)) ? 0 : -1;
  }
  return loop != nullptr ? loop->event(connection, reason, in, size) : 0;
}

int ServerLoop::event(lws* connection, lws_callback_reasons reason, void* in, std::size_t size) {
  const std::string_view text(in != nullptr ? static_cast<const char*>(in) : "", in != nullptr ? size : 0);
  switch (reason) {
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
    case LWS_CALLBACK_RAW_ADOPT:  // what is no HTTP: CONNECT, and whatever else the library would leave as it is
    case LWS_CALLBACK_RAW_RX:
      return -1;
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
  const Instant at = now();
  WebSocket& socket = found->second;
  if (ending_ && reason == LWS_CALLBACK_SERVER_WRITEABLE) {
    lws_close_reason(connection, LWS_CLOSE_STATUS_GOINGAWAY, nullptr, 0);
    return -1;
  }
  const bool goes_on = reason == LWS_CALLBACK_RECEIVE            ? socket.received(text, at)
                       : reason == LWS_CALLBACK_RECEIVE_PONG     ? socket.pong(text, at)
                       : reason == LWS_CALLBACK_SERVER_WRITEABLE ? socket.writable(at)
                                                                 : true;
  return goes_on ? 0 : -1;
}

void ServerLoop::instantiated(lws* connection) {
  const int socket = lws_get_socket_fd(connection);
  const Guest guest{.address = client_address(socket), .until = now() + kDeadline};
  if (guests_.emplace(connection, guest).second) {
    limits_.opened(guest.address);
  }
  keep_little_unsent(socket);
}

void ServerLoop::prolong(lws* connection) {
  if (const auto found = guests_.find(connection); found != guests_.end()) {
    found->second.until = now() + kDeadline;
  }
}

int ServerLoop::asked(lws* connection, std::string_view path) {
  Exchange& exchange = exchanges_[connection];
  exchange = {};
  exchange.request = request_of(connection, std::string(path));
  const std::size_t announced = announced_body(connection);
  if (const std::optional<HttpAnswer> refusal = desk_.refusal(exchange.request, announced)) {
    return refuse(connection, *refusal);
  }
  if (announced > 0) {
    return 0;  // its body comes
  }
  return answer(connection, desk_.answer(exchange.request, now()));
}

int ServerLoop::body(lws* connection, std::string_view part) {
  const auto found = exchanges_.find(connection);
  if (found == exchanges_.end()) {
    return -1;
  }
  if (found->second.refused) {
    return part.empty() ? -1 : 0;
  }
  HttpRequest& request = found->second.request;
  if (part.empty()) {
    return answer(connection, desk_.answer(request, now()));
  }
  if (request.body.size() + part.size() > HttpDesk::longest_body(request)) {
    return -1;
  }
  request.body += part;
  return 0;
}

int ServerLoop::answer(lws* connection, const HttpAnswer& answer) {
  Exchange& exchange = exchanges_[connection];
  if (!exchange.reply.begin(connection, answer, false)) {
    return -1;
  }
  if (answer.body == nullptr || answer.body->empty()) {
    exchanges_.erase(connection);
    return lws_http_transaction_completed(connection) != 0 ? -1 : 0;
  }
  lws_callback_on_writable(connection);
  return 0;
}

// Written at once, as a body may be on its way that the library would read first.
int ServerLoop::refuse(lws* connection, const HttpAnswer& answer) {
  Exchange& exchange = exchanges_[connection];
  exchange.refused = true;
  if (!exchange.reply.begin(connection, answer, true) || exchange.reply.go_on(connection) != HttpReply::State::kDone) {
    return -1;
  }
  lws_callback_on_writable(connection);
  return 0;
}

int ServerLoop::answer_more(lws* connection) {
  const auto found = exchanges_.find(connection);
  if (found == exchanges_.end()) {
    return 0;
  }
  if (found->second.refused) {
    return -1;
  }
  const HttpReply::State state = found->second.reply.go_on(connection);
  prolong(connection);
  switch (state) {
    case HttpReply::State::kMore:
      lws_callback_on_writable(connection);
      return 0;
    case HttpReply::State::kDone:
      exchanges_.erase(found);
      return lws_http_transaction_completed(connection) != 0 ? -1 : 0;
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
  const std::optional<HttpAnswer> foreign = desk_.foreign_host(request);
  const std::optional<Paired> paired = foreign ? std::nullopt : desk_.visitor(request);
  if (paired) {
    visitors_[connection] = {.paired = *paired, .ros = !page};
    return 0;
  }
  HttpReply reply;
  if (!reply.begin(connection, foreign ? *foreign : desk_.not_paired(), true) ||
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
  const Instant at = now();
  Session& session = hub_.came(visitor.paired, visitor.ros, at);
  sockets_.try_emplace(connection, connection, session, visitor.ros, at);
  said_("screen " + std::to_string(session.screen()) + ", " + visitor.paired.name + (visitor.ros ? " (ROS)" : "") +
        ": connected");
  lws_callback_on_writable(connection);
  return 0;
}

void ServerLoop::closed(lws* connection) {
  if (const auto found = sockets_.find(connection); found != sockets_.end()) {
    const Screen screen = found->second.session().screen();
    said_("screen " + std::to_string(screen) + ", " + found->second.session().paired().name + ": " +
          (ending_ ? "told that the server ends" : found->second.complaint()));
    sockets_.erase(found);
    hub_.went(screen, now());
  }
  exchanges_.erase(connection);
  visitors_.erase(connection);
  if (const auto found = guests_.find(connection); found != guests_.end()) {
    limits_.closed(found->second.address);
    guests_.erase(found);
  }
}

}  // namespace ivo::firmware::web
