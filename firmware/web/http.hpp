// A request and its answer, free of how they travel.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/web/client_address.hpp"

namespace ivo::firmware::web {

struct HttpRequest {
  std::string method;  ///< "GET"
  std::string path;    ///< "/pair", decoded, without what follows a question mark
  std::string host;    ///< "robot.local:8080"
  std::string origin;  ///< empty: none was said
  std::string token;   ///< of the cookie
  std::string bearer;  ///< of "Authorization: Bearer", or of ?token=
  std::string etag;    ///< of If-None-Match
  std::string body;
  ClientAddress client;
};

struct HttpAnswer {
  int status = 200;
  std::string type = "application/json";
  std::shared_ptr<const std::string> body;                   ///< null: none
  std::vector<std::pair<std::string, std::string>> headers;  ///< beyond those that all have
};

[[nodiscard]] inline HttpAnswer answer_of(int status, std::string body, std::string type = "application/json") {
  return {.status = status,
          .type = std::move(type),
          .body = std::make_shared<const std::string>(std::move(body)),
          .headers = {}};
}

/// What every answer carries: nothing runs but what this server itself serves, and nobody frames it.
[[nodiscard]] const std::vector<std::pair<std::string_view, std::string_view>>& guarding_headers();

/// The value of the cookie `name` in a Cookie header; empty: there is none, or it is there twice.
[[nodiscard]] std::string cookie_value(std::string_view header, std::string_view name);
/// The token of "Bearer ..."; empty otherwise.
[[nodiscard]] std::string bearer_token(std::string_view header);

}  // namespace ivo::firmware::web
