// One request and its answer on a connection of libwebsockets.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "firmware/web/http.hpp"

struct lws;

namespace ivo::firmware::web {

/// What has been asked, as its headers say; the body comes later.
[[nodiscard]] HttpRequest request_of(lws* connection, std::string path);
/// As the headers announce it: 0 without; larger than any limit when it cannot be known.
[[nodiscard]] std::size_t announced_body(lws* connection);
/// The subprotocol that a WebSocket asks for.
[[nodiscard]] std::string subprotocol_of(lws* connection);

/// Writes an answer as fast as it is read.
class HttpReply {
 public:
  static constexpr int kPatience_s = 20;  ///< with a client that does not read

  /// Writes the headers. False: the connection is to be closed at once.
  [[nodiscard]] bool begin(lws* connection, const HttpAnswer& answer, bool then_close);
  enum class State : unsigned char { kMore, kDone, kBroken };
  /// Writes a part of the body.
  [[nodiscard]] State go_on(lws* connection);

 private:
  std::shared_ptr<const std::string> body_;
  std::size_t from_ = 0;
};

}  // namespace ivo::firmware::web
