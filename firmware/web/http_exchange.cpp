#include "firmware/web/http_exchange.hpp"

#include <libwebsockets.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>

namespace ivo::firmware::web {
namespace {

constexpr std::size_t kLongestHeader = 4096;
constexpr std::size_t kPartBytes = 16'384;

std::string header(lws* connection, lws_token_indexes token) {
  const int size = lws_hdr_total_length(connection, token);
  if (size <= 0 || static_cast<std::size_t>(size) >= kLongestHeader) {
    return "";
  }
  std::string value(static_cast<std::size_t>(size) + 1, '\0');
  const int copied = lws_hdr_copy(connection, value.data(), size + 1, token);
  value.resize(copied > 0 ? static_cast<std::size_t>(copied) : 0);
  return value;
}

std::string query_token(lws* connection) {
  constexpr std::string_view kName = "token=";
  std::array<char, 256> part{};
  for (int i = 0;; ++i) {
    const int size =
        lws_hdr_copy_fragment(connection, part.data(), static_cast<int>(part.size()), WSI_TOKEN_HTTP_URI_ARGS, i);
    if (size < 0) {
      return "";
    }
    const std::string_view argument(part.data(), static_cast<std::size_t>(size));
    if (argument.starts_with(kName)) {
      return std::string(argument.substr(kName.size()));
    }
  }
}

std::string method_of(lws* connection) {
  static constexpr std::array<std::pair<lws_token_indexes, const char*>, 7> kMethods{{
      {WSI_TOKEN_GET_URI, "GET"},
      {WSI_TOKEN_POST_URI, "POST"},
      {WSI_TOKEN_PUT_URI, "PUT"},
      {WSI_TOKEN_HEAD_URI, "HEAD"},
      {WSI_TOKEN_DELETE_URI, "DELETE"},
      {WSI_TOKEN_PATCH_URI, "PATCH"},
      {WSI_TOKEN_OPTIONS_URI, "OPTIONS"},
  }};
  for (const auto& [token, name] : kMethods) {
    if (lws_hdr_total_length(connection, token) > 0) {
      return name;
    }
  }
  return "";
}

/// The room of a header block, and what has been written of it.
struct Block {
  std::array<unsigned char, LWS_PRE + kLongestHeader> bytes{};
  unsigned char* at = bytes.data() + LWS_PRE;
  [[nodiscard]] unsigned char* end() { return bytes.data() + bytes.size() - 1; }
};

bool put(lws* connection, std::string_view name, std::string_view value, Block& block) {
  const std::string named(name);  // closed by a 0, as the library wants it
  // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast): the library's bytes are unsigned
  return lws_add_http_header_by_name(connection, reinterpret_cast<const unsigned char*>(named.c_str()),
                                     reinterpret_cast<const unsigned char*>(value.data()),
                                     static_cast<int>(value.size()), &block.at, block.end()) == 0;
  // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
}

}  // namespace

HttpRequest request_of(lws* connection, std::string path) {
  HttpRequest request;
  request.method = method_of(connection);
  request.path = std::move(path);
  request.host = header(connection, WSI_TOKEN_HOST);
  request.origin = header(connection, WSI_TOKEN_ORIGIN);
  request.token = cookie_value(header(connection, WSI_TOKEN_HTTP_COOKIE), "ivo");
  request.bearer = bearer_token(header(connection, WSI_TOKEN_HTTP_AUTHORIZATION));
  if (request.bearer.empty()) {
    request.bearer = query_token(connection);
  }
  request.etag = header(connection, WSI_TOKEN_HTTP_IF_NONE_MATCH);
  request.client = client_address(lws_get_socket_fd(connection));
  return request;
}

std::size_t announced_body(lws* connection) {
  constexpr std::size_t kUnknown = std::numeric_limits<std::size_t>::max();
  if (lws_hdr_total_length(connection, WSI_TOKEN_HTTP_TRANSFER_ENCODING) > 0) {
    return kUnknown;
  }
  const std::string text = header(connection, WSI_TOKEN_HTTP_CONTENT_LENGTH);
  std::size_t size = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), size);
  return text.empty() ? 0 : status == std::errc() && end == text.data() + text.size() ? size : kUnknown;
}

std::string subprotocol_of(lws* connection) { return header(connection, WSI_TOKEN_PROTOCOL); }

bool HttpReply::begin(lws* connection, const HttpAnswer& answer, bool then_close) {
  Block block;
  bool fits = lws_add_http_header_status(connection, static_cast<unsigned>(answer.status), &block.at, block.end()) == 0;
  if (answer.body != nullptr || (answer.status != 204 && answer.status != 304)) {
    const std::size_t size = answer.body == nullptr ? 0 : answer.body->size();
    fits = fits && put(connection, "content-length:", std::to_string(size), block);
  }
  if (answer.body != nullptr && !answer.type.empty()) {
    fits = fits && put(connection, "content-type:", answer.type, block);
  }
  for (const auto& [name, value] : answer.headers) {
    fits = fits && put(connection, name, value, block);
  }
  for (const auto& [name, value] : guarding_headers()) {
    fits = fits && put(connection, name, value, block);
  }
  if (then_close) {
    fits = fits && put(connection, "connection:", "close", block);
  }
  body_ = answer.body;
  from_ = 0;
  return fits && lws_finalize_write_http_header(connection, block.bytes.data() + LWS_PRE, &block.at, block.end()) == 0;
}

HttpReply::State HttpReply::go_on(lws* connection) {
  const std::size_t size = body_ == nullptr ? 0 : body_->size();
  const std::size_t count = std::min(size - from_, kPartBytes);
  if (count == 0) {
    return State::kDone;
  }
  std::array<unsigned char, LWS_PRE + kPartBytes> part{};
  std::copy_n(body_->begin() + static_cast<std::ptrdiff_t>(from_), count, part.begin() + LWS_PRE);
  from_ += count;
  const bool last = from_ == size;
  lws_set_timeout(connection, PENDING_TIMEOUT_HTTP_CONTENT, kPatience_s);
  const int written = lws_write(connection, part.data() + LWS_PRE, count, last ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP);
  return written < static_cast<int>(count) ? State::kBroken : last ? State::kDone : State::kMore;
}

}  // namespace ivo::firmware::web
