#include "firmware/web/http_desk.hpp"

#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace ivo::firmware::web {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

class HttpDeskTest : public testing::Test {
 protected:
  HttpRequest request(std::string method, std::string path) const {
    HttpRequest request;
    request.method = std::move(method);
    request.path = std::move(path);
    request.host = "robot:8080";
    return request;
  }
  HttpRequest pairing(const std::string& code) const {
    HttpRequest pairing = request("POST", "/pair");
    pairing.origin = "http://robot:8080";
    pairing.body = "{\"code\":\"" + code + "\",\"name\":\"Ana\"}";
    return pairing;
  }
  HttpAnswer answer(const HttpRequest& request) { return desk_.answer(request, now_); }
  static std::string header(const HttpAnswer& answer, std::string_view name) {
    for (const auto& [key, value] : answer.headers) {
      if (key == name) {
        return value;
      }
    }
    return "";
  }
  std::string paired_token() {
    const std::string cookie = header(answer(pairing(code_.digits())), "set-cookie:");
    return cookie.substr(4, 64);
  }

  ScratchFolder folder_;
  ScratchFolder leaflet_;
  Instant now_{100s};
  const std::string page_ = folder_.put("index.html", "<!doctype html>");
  const std::string hidden_ = folder_.put(".secret.js", "hidden");
  const std::string other_ = folder_.put("tokens", "of nobody's business");
  Site site_ = std::move(Site::read(folder_.path(), leaflet_.path())).value();
  std::vector<std::string> said_;
  Hub hub_{folder_.path("nobody"), [](const std::string&) {}};
  TokenStore tokens_ = std::move(TokenStore::open(folder_.path("state"))).value();
  PairingCode code_;
  HttpDesk desk_{site_,
                 hub_,
                 tokens_,
                 code_,
                 {.tls = false, .origins = {"http://tablet:1"}, .machine = "robot"},
                 [this](const std::string& line) { said_.push_back(line); }};
};

TEST_F(HttpDeskTest, GivesThePageToEverybodyAndNothingElse) {
  EXPECT_EQ(answer(request("GET", "/")).status, 200);
  EXPECT_EQ(answer(request("GET", "/")).type, "text/html; charset=utf-8");
  for (const char* path : {"/tokens", "/.secret.js", "/index.html", "/grid/map", "/session", "/state/tokens", ""}) {
    EXPECT_EQ(answer(request("GET", path)).status, 403) << path;
  }
  EXPECT_EQ(answer(request("DELETE", "/")).status, 405);
}

TEST_F(HttpDeskTest, SendsAFileOnlyWhenItIsNew) {
  HttpRequest again = request("GET", "/");
  again.etag = header(answer(again), "etag:");
  EXPECT_EQ(answer(again).status, 304);
  EXPECT_EQ(answer(again).body, nullptr);
  again.etag = "\"other\"";
  EXPECT_EQ(answer(again).status, 200);
}

TEST_F(HttpDeskTest, PairsWithTheCodeAndSaysSo) {
  const HttpAnswer wrong = answer(pairing("nothex"));
  EXPECT_EQ(wrong.status, 403);
  EXPECT_EQ(*wrong.body, R"({"error":"wrong_code","left":4})");
  const std::string token = paired_token();
  EXPECT_EQ(tokens_.find(token)->role, Role::kOperator);
  ASSERT_EQ(said_.size(), 2U);
  EXPECT_EQ(said_[1], "paired: Ana; the code is now " + code_.digits());
  HttpRequest grid = request("GET", "/grid/map");
  grid.token = token;
  EXPECT_EQ(answer(grid).status, 404);
  EXPECT_EQ(hub_.refusals().wrong_code(), 1U);
}

TEST_F(HttpDeskTest, PairsNobodyFromAnotherOrigin) {
  for (const char* origin : {"", "http://evil.example", "https://robot:8080"}) {
    HttpRequest foreign = pairing(code_.digits());
    foreign.origin = origin;
    EXPECT_EQ(answer(foreign).status, 403) << origin;
  }
  EXPECT_EQ(hub_.refusals().foreign_origin(), 3U);
  HttpRequest named = pairing(code_.digits());
  named.origin = "http://tablet:1";
  EXPECT_EQ(answer(named).status, 204);
}

TEST_F(HttpDeskTest, MarksItsCookieSecureOverTls) {
  HttpDesk desk(site_, hub_, tokens_, code_, {.tls = true, .origins = {}, .machine = "robot"},
                [](const std::string&) {});
  HttpRequest secure = pairing(code_.digits());
  secure.origin = "https://robot:8080";
  EXPECT_TRUE(header(desk.answer(secure, now_), "set-cookie:").ends_with("; Secure"));
}

TEST_F(HttpDeskTest, LetsInWhoIsPairedFromOurPageAndProgramsWithTheirToken) {
  const std::string token = paired_token();
  HttpRequest visit = request("GET", "/session");
  visit.token = token;
  EXPECT_FALSE(desk_.visitor(visit).has_value());  // a cookie alone may be sent by any page
  visit.origin = "http://robot:8080";
  EXPECT_EQ(desk_.visitor(visit)->name, "Ana");
  visit.origin = "http://evil.example";
  EXPECT_FALSE(desk_.visitor(visit).has_value());
  HttpRequest program = request("GET", "/");
  program.bearer = token;
  EXPECT_TRUE(desk_.visitor(program).has_value());
  program.origin = "http://evil.example";
  EXPECT_FALSE(desk_.visitor(program).has_value());
  program.origin = "";
  program.bearer = "wrong";
  EXPECT_FALSE(desk_.visitor(program).has_value());
}

TEST_F(HttpDeskTest, ShowsTheCodeOnThisMachineAlone) {
  HttpRequest screen = request("GET", "/screen");
  screen.client.this_machine = true;
  EXPECT_EQ(answer(screen).status, 403);
  screen.host = "localhost:8080";
  EXPECT_NE(answer(screen).body->find(code_.digits()), std::string::npos);
  screen.client.this_machine = false;
  EXPECT_EQ(answer(screen).status, 403);
}

TEST_F(HttpDeskTest, RefusesWhatComesForAnotherHost) {
  HttpRequest rebound = pairing(code_.digits());
  rebound.host = "evil.example:8080";
  rebound.origin = "http://evil.example:8080";
  const std::optional<HttpAnswer> refusal = desk_.refusal(rebound, 60);
  ASSERT_TRUE(refusal.has_value());
  EXPECT_EQ(refusal->status, 403);
  EXPECT_EQ(*refusal->body, R"({"error":"foreign_host"})");
  EXPECT_EQ(hub_.refusals().foreign_host(), 1U);
  rebound.host = "tablet:8080";
  EXPECT_FALSE(desk_.refusal(rebound, 60).has_value());
  EXPECT_TRUE(desk_.foreign_host(request("GET", "/")) == std::nullopt);
}

TEST_F(HttpDeskTest, ReadsABodyOnlyOfWhoMaySendIt) {
  HttpRequest put = request("PUT", "/areas.geojson");
  put.origin = "http://robot:8080";
  EXPECT_EQ(desk_.refusal(put, 100)->status, 403);
  EXPECT_EQ(hub_.refusals().not_paired(), 1U);
  put.token = paired_token();
  EXPECT_FALSE(desk_.refusal(put, 100).has_value());
  EXPECT_EQ(desk_.refusal(put, HttpDesk::kLongestAreas + 1)->status, 413);
  EXPECT_EQ(desk_.refusal(request("GET", "/"), 1)->status, 413);
  EXPECT_EQ(hub_.refusals().of(Verdict::kTooLarge), 2U);
  EXPECT_FALSE(desk_.refusal(pairing(""), 60).has_value());
}

TEST_F(HttpDeskTest, MakesAreasAndMaskOnceAsLongAsNothingChanges) {
  const std::string token = paired_token();
  for (const char* path : {"/areas.geojson", "/keepout.pgm", "/keepout.yaml"}) {
    HttpRequest get = request("GET", path);
    get.token = token;
    EXPECT_EQ(answer(get).status, 404);
    EXPECT_EQ(answer(get).body, answer(get).body) << path;
  }
}

TEST_F(HttpDeskTest, CountsWhatItRefuses) {
  HttpRequest odd = pairing("");
  odd.body = "nonsense";
  EXPECT_EQ(answer(odd).status, 400);
  EXPECT_EQ(answer(request("GET", "/plan.json")).status, 403);
  HttpRequest put = request("PUT", "/areas.geojson");
  put.origin = "http://robot:8080";
  put.token = paired_token();
  EXPECT_EQ(answer(put).status, 400);
  EXPECT_EQ(hub_.refusals().of(Verdict::kMalformed), 2U);
  EXPECT_EQ(hub_.refusals().not_paired(), 1U);
}

TEST_F(HttpDeskTest, SaysALockOnceAndNoCodeWithATry) {
  const std::string code = code_.digits();
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(answer(pairing("nothex")).status, 403);
  }
  EXPECT_EQ(said_.size(), 5U);
  for (const std::string& line : said_) {
    EXPECT_EQ(line.find(code), std::string::npos) << line;
  }
  EXPECT_EQ(hub_.refusals().wrong_code(), 20U);
}

TEST_F(HttpDeskTest, TakesBodiesWhereOneBelongs) {
  EXPECT_EQ(HttpDesk::longest_body(request("POST", "/pair")), HttpDesk::kLongestPairing);
  EXPECT_EQ(HttpDesk::longest_body(request("PUT", "/areas.geojson")), HttpDesk::kLongestAreas);
  EXPECT_EQ(HttpDesk::longest_body(request("POST", "/")), 0U);
  EXPECT_EQ(HttpDesk::longest_body(request("GET", "/pair")), 0U);
}

TEST(SiteFolder, IsRefusedWithoutAPage) {
  const ScratchFolder empty;
  EXPECT_EQ(Site::read(empty.path(), empty.path()).error().message,
            empty.path() + ": holds no index.html; expected the page's files");
  EXPECT_TRUE(Site::read(empty.path("none"), empty.path()).error().message.starts_with(empty.path("none")));
}

class HubTest : public testing::Test {
 protected:
  HubTest() { hub_.turn(now_); }
  std::string next(Session& session) {
    const std::optional<Frame> frame = session.next(now_);
    return frame ? frame->bytes : "";
  }

  const ScratchFolder nowhere_;
  Instant now_{100s};
  Hub hub_{nowhere_.path("nobody"), [](const std::string&) {}};
  const Paired ana_{.hash = "a", .role = Role::kOperator, .name = "Ana"};
};

TEST_F(HubTest, GreetsThenSaysTheStatus) {
  Session& session = hub_.came(ana_, false, now_);
  EXPECT_EQ(next(session), R"({"type":"hello","protocol":1,"screen":1,"name":"Ana","may_operate":true})");
  EXPECT_TRUE(next(session).starts_with(R"({"type":"status","controller":"none")"));
  EXPECT_EQ(next(session), "");
}

TEST_F(HubTest, SaysAStatusTwiceASecondAndWhenSomethingIsNew) {
  Session& session = hub_.came(ana_, false, now_);
  int statuses = 0;
  for (int i = 0; i < 100; ++i) {
    now_ += std::chrono::milliseconds(10);
    hub_.turn(now_);
    statuses += next(session).starts_with(R"({"type":"status")") ? 1 : 0;
  }
  EXPECT_GE(statuses, 2);
  EXPECT_LE(statuses, 4);
}

TEST_F(HubTest, AnswersEveryMessageButForAFloodWithoutForm) {
  Session& session = hub_.came(ana_, false, now_);
  (void)next(session);
  session.hear(R"({"seq":1,"do":"beat","seen":9})", false, now_);
  EXPECT_EQ(next(session), R"({"type":"answer","seq":1,"verdict":"not_fresh"})");
  for (int i = 0; i < 10'000; ++i) {
    session.hear("nonsense", false, now_);
  }
  EXPECT_FALSE(session.overfull());
  EXPECT_EQ(hub_.refusals().of(Verdict::kMalformed), 10'000U);
}

TEST_F(HubTest, NumbersTheStatusesOfEachPageForItself) {
  Session& first = hub_.came(ana_, false, now_);
  (void)next(first);
  EXPECT_NE(next(first).find(",\"n\":1}"), std::string::npos);
  now_ += 1s;
  hub_.turn(now_);
  EXPECT_NE(next(first).find(",\"n\":2}"), std::string::npos);
  Session& second = hub_.came(ana_, false, now_);
  (void)next(second);
  EXPECT_NE(next(second).find(",\"n\":1}"), std::string::npos);
}

TEST_F(HubTest, IsFreshByTheAgeOfTheStatusThatWasSeenNotByWhatArrives) {
  Session& session = hub_.came(ana_, false, now_);
  (void)next(session);
  (void)next(session);
  session.hear(R"({"seq":1,"do":"beat","seen":1})", false, now_);
  EXPECT_FALSE(session.fresh(1, now_));  // not written yet
  session.written(now_);
  session.hear(R"({"seq":2,"do":"beat","seen":2})", false, now_);
  EXPECT_FALSE(session.fresh(1, now_));  // there was no such status
  session.hear(R"({"seq":3,"do":"beat","seen":1})", false, now_ + 1s);
  EXPECT_TRUE(session.fresh(1, now_ + 1s));
  EXPECT_FALSE(session.fresh(0, now_ + 1s));
  EXPECT_FALSE(session.fresh(1, now_ + 1s + Duration(1)));
  for (int i = 0; i < 2; ++i) {
    EXPECT_NE(next(session).find("not_fresh"), std::string::npos);
  }
  EXPECT_NE(next(session).find("accepted"), std::string::npos);
  now_ += 1500ms;
  session.hear(R"({"seq":4,"do":"beat","seen":1})", false, now_);  // it was held up on its way
  EXPECT_NE(next(session).find("not_fresh"), std::string::npos);
  EXPECT_EQ(hub_.refusals().of(Verdict::kNotFresh), 3U);
}

TEST_F(HubTest, ARosClientIsFreshByThePingThatItAnswers) {
  Session& session = hub_.came(ana_, true, now_);
  session.alive(1, now_);
  EXPECT_FALSE(session.fresh(0, now_));
  session.pinged(1, now_);
  session.alive(1, now_ + 1s + Duration(1));
  EXPECT_FALSE(session.fresh(0, now_ + 1s + Duration(1)));
  session.pinged(2, now_ + 2s);
  session.alive(2, now_ + 3s);
  EXPECT_TRUE(session.fresh(0, now_ + 4s));
  EXPECT_FALSE(session.fresh(0, now_ + 4s + Duration(1)));
}

TEST_F(HubTest, ShowsLayersToEveryPageOnce) {
  Session& session = hub_.came(ana_, false, now_);
  (void)next(session);
  (void)next(session);
  hub_.show({.name = LayerName::kScan, .at = now_, .points = {{1, 2}}, .heading_rad = 0.0});
  EXPECT_EQ(next(session), R"({"type":"layer","name":"scan","age_s":0,"points_m":[[1,2]]})");
  EXPECT_EQ(next(session), "");
}

TEST_F(HubTest, ShowsALayerFiveTimesASecondAtMostAndToTheCentimetre) {
  Session& session = hub_.came(ana_, false, now_);
  (void)next(session);
  (void)next(session);
  int scans = 0;
  for (int i = 0; i < 100; ++i) {
    hub_.show({.name = LayerName::kScan, .at = now_, .points = {{1.23456, -0.001}}, .heading_rad = 0.0});
    const std::string text = next(session);
    scans += text.starts_with(R"({"type":"layer","name":"scan")") ? 1 : 0;
    EXPECT_TRUE(scans != 1 || text.empty() || text.find("[[1.23,0]]") != std::string::npos ||
                text.find("[[1.23,-0]]") != std::string::npos)
        << text;
    now_ += 10ms;
  }
  EXPECT_EQ(scans, 5);
  hub_.show({.name = LayerName::kPeople, .at = now_, .points = {}, .heading_rad = 0.0});
}

}  // namespace
}  // namespace ivo::firmware::web
