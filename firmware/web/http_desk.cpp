#include "firmware/web/http_desk.hpp"

#include <array>
#include <utility>
#include <variant>

#include "firmware/files/json_value.hpp"
#include "firmware/web/area_exchange.hpp"
#include "firmware/web/origin.hpp"
#include "firmware/web/status_json.hpp"

namespace ivo::firmware::web {
namespace {

using console::Document;

HttpAnswer error(int status, std::string_view code) { return answer_of(status, error_text(code)); }

HttpAnswer not_stored(HttpAnswer answer) {
  answer.headers.emplace_back("cache-control:", "no-store");
  return answer;
}

struct Served {
  std::string_view path;
  Document document;
  std::string_view type;
};
constexpr std::array<Served, 6> kServed{{
    {"/grid/map", Document::kMap, "application/octet-stream"},
    {"/grid/probability", Document::kProbability, "application/octet-stream"},
    {"/grid/searched", Document::kSearched, "application/octet-stream"},
    {"/aerial.png", Document::kAerial, "image/png"},
    {"/report.json", Document::kReport, "application/json"},
    {"/plan.json", Document::kPlan, "application/json"},
}};

struct Introduction {
  std::string code;
  std::string name;
};

std::optional<Introduction> introduction_of(const std::string& body) {
  const Result<Json> json = parse_strict_json(body, "pairing", "an object");
  if (!json || json.value().members.size() != 2) {
    return std::nullopt;
  }
  const Json* const code = json.value().member("code");
  const Json* const name = json.value().member("name");
  const bool right = code != nullptr && name != nullptr && code->kind == Json::Kind::kText &&
                     name->kind == Json::Kind::kText && code->text.size() == 6;
  return right ? std::optional(Introduction{code->text, name->text}) : std::nullopt;
}

}  // namespace

HttpDesk::HttpDesk(const Site& site, Hub& hub, TokenStore& tokens, PairingCode& code, HttpRules rules, Said said)
    : site_(site), hub_(hub), tokens_(tokens), code_(code), rules_(std::move(rules)), said_(std::move(said)) {}

std::size_t HttpDesk::longest_body(const HttpRequest& request) noexcept {
  const bool pairing = request.method == "POST" && request.path == "/pair";
  const bool areas = request.method == "PUT" && request.path == "/areas.geojson";
  return pairing ? kLongestPairing : areas ? kLongestAreas : 0;
}

bool HttpDesk::origin_is_ours(const HttpRequest& request) {
  if (same_origin(request.origin, request.host, rules_.tls, rules_.origins)) {
    return true;
  }
  hub_.refusals().count_foreign_origin();
  return false;
}

std::optional<Paired> HttpDesk::paired(const HttpRequest& request) {
  // What a browser sends by itself never counts as a token that somebody has typed in.
  const std::string& token = request.bearer.empty() ? request.token : request.bearer;
  return token.empty() ? std::nullopt : tokens_.find(token);
}

std::optional<Paired> HttpDesk::visitor(const HttpRequest& request) {
  const bool program = request.origin.empty() && !request.bearer.empty();
  return program || origin_is_ours(request) ? paired(request) : std::nullopt;
}

std::optional<HttpAnswer> HttpDesk::foreign_host(const HttpRequest& request) {
  if (own_host(request.host, rules_.machine, rules_.origins)) {
    return std::nullopt;
  }
  hub_.refusals().count_foreign_host();
  return error(403, "foreign_host");
}

HttpAnswer HttpDesk::not_paired() {
  hub_.refusals().count_not_paired();
  return error(403, "not_paired");
}

std::optional<HttpAnswer> HttpDesk::refusal(const HttpRequest& request, std::size_t announced) {
  const bool changes = request.method == "POST" || request.method == "PUT";
  if (changes) {
    if (std::optional<HttpAnswer> foreign = foreign_host(request)) {
      return foreign;
    }
  }
  if (announced > longest_body(request)) {
    hub_.refusals().count(Verdict::kTooLarge);
    return error(413, "too_large");
  }
  if (request.method == "PUT" && announced > 0 && !visitor(request)) {
    return not_paired();
  }
  return std::nullopt;
}

HttpAnswer HttpDesk::answer(const HttpRequest& request, Instant now) {
  const bool get = request.method == "GET";
  if (get) {
    if (const HttpAnswer* const file = site_.file(request.path)) {
      const bool known = !request.etag.empty() && request.etag == file->headers.back().second;
      return known ? HttpAnswer{.status = 304, .type = file->type, .body = nullptr, .headers = file->headers} : *file;
    }
    if (request.path == "/screen") {
      return screen(request);
    }
  }
  if (request.method == "POST" && request.path == "/pair") {
    return origin_is_ours(request) ? pair(request, now) : error(403, "foreign_origin");
  }
  const bool put = request.method == "PUT" && request.path == "/areas.geojson";
  if (!get && !put) {
    return error(405, "no_such_method");
  }
  const std::optional<Paired> who = get ? paired(request) : visitor(request);
  if (!who) {
    return not_paired();
  }
  return put ? put_areas(request, *who, now) : not_stored(document(request.path));
}

HttpAnswer HttpDesk::pair(const HttpRequest& request, Instant now) {
  const std::optional<Introduction> introduction = introduction_of(request.body);
  if (!introduction) {
    hub_.refusals().count(Verdict::kMalformed);
    return error(400, "malformed");
  }
  const PairingCode::Outcome outcome = code_.test(introduction->code, request.client, now);
  if (const auto* const wrong = std::get_if<PairingCode::Wrong>(&outcome)) {
    hub_.refusals().count_wrong_code();
    said_("a wrong code from " + request.client.group + "; " + std::to_string(wrong->left) + " tries are left");
    return answer_of(403, error_text("wrong_code", "left", wrong->left));
  }
  if (const auto* const locked = std::get_if<PairingCode::Locked>(&outcome)) {
    hub_.refusals().count_wrong_code();
    if (locked->anew) {
      said_("pairing is locked for " + request.client.group + " for " + std::to_string(locked->wait_s) + " s");
    }
    return answer_of(403, error_text("locked", "wait_s", locked->wait_s));
  }
  if (const auto* const closed = std::get_if<PairingCode::Closed>(&outcome)) {
    hub_.refusals().count_wrong_code();
    if (closed->anew) {
      said_("too many wrong codes: pairing is closed but for this machine, for " + std::to_string(closed->wait_s) +
            " s; the code is now " + code_.digits());
    }
    return answer_of(403, error_text("locked", "wait_s", closed->wait_s));
  }
  const Result<std::string> token = tokens_.add(introduction->name, Role::kOperator);
  if (!token) {
    said_(token.error().message);
    return error(500, "not_kept");
  }
  said_("paired: " + tidy_name(introduction->name) + "; the code is now " + code_.digits());
  constexpr int kHalfAYear_s = 180 * 24 * 3600;
  HttpAnswer done{.status = 204, .type = "", .body = nullptr, .headers = {}};
  done.headers.emplace_back("set-cookie:", "ivo=" + token.value() + "; HttpOnly; SameSite=Strict; Path=/; Max-Age=" +
                                               std::to_string(kHalfAYear_s) + (rules_.tls ? "; Secure" : ""));
  return not_stored(std::move(done));
}

HttpAnswer HttpDesk::put_areas(const HttpRequest& request, const Paired& paired, Instant now) {
  const Result<std::vector<Request>> requests = requests_of_geojson(request.body, hub_.view());
  if (!requests) {
    hub_.refusals().count(Verdict::kMalformed);
    return answer_of(400, json_text(Json{{"error", "malformed"}, {"text", requests.error().message}}));
  }
  for (const Request& one : requests.value()) {
    if (const std::optional<Verdict> verdict = hub_.ask(paired, one, now)) {
      return error(*verdict == Verdict::kNotAllowed ? 403 : 503, name_of(*verdict));
    }
  }
  return {.status = 202, .type = "", .body = nullptr, .headers = {}};
}

const HttpDesk::Made& HttpDesk::made() {
  const View& view = hub_.view();
  const std::array<std::uint32_t, 3> of{view.document(Document::kMission).revision,
                                        view.document(Document::kMap).revision,
                                        view.document(Document::kAreas).revision};
  if (made_ && made_->of == of) {
    return *made_;
  }
  std::optional<std::string> areas = areas_geojson(view);
  std::optional<KeepoutMask> mask = keepout_of(view);
  made_ =
      Made{.of = of,
           .areas = areas ? answer_of(200, std::move(*areas), "application/geo+json") : error(404, "none"),
           .keepout_yaml = mask ? answer_of(200, std::move(mask->yaml), "application/yaml") : error(404, "none"),
           .keepout_pgm = mask ? answer_of(200, std::move(mask->pgm), "image/x-portable-graymap") : error(404, "none")};
  return *made_;
}

HttpAnswer HttpDesk::document(const std::string& path) {
  const View& view = hub_.view();
  for (const Served& served : kServed) {
    if (path == served.path) {
      const KnownDocument& known = view.document(served.document);
      return known.there()
                 ? HttpAnswer{.status = 200, .type = std::string(served.type), .body = known.bytes, .headers = {}}
                 : error(404, "none");
    }
  }
  if (path == "/areas.geojson") {
    return made().areas;
  }
  if (path == "/keepout.yaml" || path == "/keepout.pgm") {
    return path == "/keepout.yaml" ? made().keepout_yaml : made().keepout_pgm;
  }
  return error(404, "no_such_path");
}

HttpAnswer HttpDesk::screen(const HttpRequest& request) const {
  // The host too: a name that a stranger's page has turned towards this machine is not this machine's.
  if (!request.client.this_machine || !is_this_machine(request.host)) {
    return error(403, "not_from_here");
  }
  return not_stored(
      answer_of(200,
                "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><meta http-equiv=\"refresh\" "
                "content=\"2\"><title>IVO</title><link rel=\"stylesheet\" href=\"/page.css\"></head>"
                "<body class=\"screen\"><h1 id=\"code\">" +
                    code_.digits() + "</h1></body></html>\n",
                "text/html; charset=utf-8"));
}

}  // namespace ivo::firmware::web
