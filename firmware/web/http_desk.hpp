// Answers every request that is no WebSocket, and says who may open one. Knows nothing of connections.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/base/time.hpp"
#include "firmware/web/http.hpp"
#include "firmware/web/hub.hpp"
#include "firmware/web/pairing_code.hpp"
#include "firmware/web/site.hpp"
#include "firmware/web/token_store.hpp"

namespace ivo::firmware::web {

struct HttpRules {
  bool tls = false;
  std::vector<std::string> origins;  ///< beyond the server's own
  std::string machine;               ///< this machine's name
};

class HttpDesk {
 public:
  /// Bytes of a body: of POST /pair, and of PUT /areas.geojson.
  static constexpr std::size_t kLongestPairing = 1024;
  static constexpr std::size_t kLongestAreas = 1U << 20U;
  /// One line for a person who watches the server.
  using Said = std::function<void(const std::string& line)>;

  /// All outlive this.
  HttpDesk(const Site& site, Hub& hub, TokenStore& tokens, PairingCode& code, HttpRules rules, Said said);

  [[nodiscard]] HttpAnswer answer(const HttpRequest& request, Instant now);
  /// What is refused before its body of `announced` bytes is read; none: answer() has the answer.
  [[nodiscard]] std::optional<HttpAnswer> refusal(const HttpRequest& request, std::size_t announced);
  /// What is refused when it was sent to a name that is not ours; none otherwise.
  [[nodiscard]] std::optional<HttpAnswer> foreign_host(const HttpRequest& request);
  [[nodiscard]] HttpAnswer not_paired();
  /// Who opens a WebSocket with that request; none: nobody may.
  [[nodiscard]] std::optional<Paired> visitor(const HttpRequest& request);
  /// Of who was a visitor before.
  [[nodiscard]] bool still_paired(const Paired& paired) { return tokens_.holds(paired); }
  /// Of a body that the request may bring; 0: none.
  [[nodiscard]] static std::size_t longest_body(const HttpRequest& request) noexcept;

 private:
  [[nodiscard]] bool origin_is_ours(const HttpRequest& request);
  [[nodiscard]] std::optional<Paired> paired(const HttpRequest& request);
  [[nodiscard]] HttpAnswer pair(const HttpRequest& request, Instant now);
  [[nodiscard]] HttpAnswer put_areas(const HttpRequest& request, const Paired& paired, Instant now);
  [[nodiscard]] HttpAnswer document(const std::string& path);
  [[nodiscard]] HttpAnswer screen(const HttpRequest& request) const;

  /// What is made of several documents, as long as none of them changes.
  struct Made {
    std::array<std::uint32_t, 3> of{};  // revisions of mission, map and areas
    HttpAnswer areas;
    HttpAnswer keepout_yaml;
    HttpAnswer keepout_pgm;
  };
  [[nodiscard]] const Made& made();

  const Site& site_;
  Hub& hub_;
  TokenStore& tokens_;
  PairingCode& code_;
  HttpRules rules_;
  Said said_;
  std::optional<Made> made_;
};

}  // namespace ivo::firmware::web
