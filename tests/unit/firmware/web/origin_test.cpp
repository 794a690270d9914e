#include "firmware/web/origin.hpp"

#include <gtest/gtest.h>

#include "firmware/web/http.hpp"

namespace ivo::firmware::web {
namespace {

TEST(Origin, IsOursWhenItIsTheHostThatWasAsked) {
  EXPECT_TRUE(same_origin("http://robot.local:8080", "robot.local:8080", false, {}));
  EXPECT_TRUE(same_origin("http://ROBOT.local:8080", "robot.LOCAL:8080", false, {}));
  EXPECT_TRUE(same_origin("http://robot", "robot:80", false, {}));
  EXPECT_TRUE(same_origin("https://robot", "robot", true, {}));
  EXPECT_TRUE(same_origin("https://[fe80::1]:8443", "[fe80::1]:8443", true, {}));
  EXPECT_TRUE(same_origin("http://[::1]", "[::1]:80", false, {}));
}

TEST(Origin, IsNotOursOtherwise) {
  for (const char* origin : {"", "null", "http://", "http://evil.example", "https://robot:8080", "http://robot:8081",
                             "http://robot", "http://robot:8080.evil.example", "http://robot:8080/", "robot:8080"}) {
    EXPECT_FALSE(same_origin(origin, "robot:8080", false, {})) << origin;
  }
  EXPECT_FALSE(same_origin("http://robot", "robot", true, {}));
  EXPECT_FALSE(same_origin("", "", false, {}));
  EXPECT_FALSE(same_origin("http://", "", false, {}));
}

TEST(Origin, MayBeNamed) {
  const std::vector<std::string> others{"http://tablet:8000"};
  EXPECT_TRUE(same_origin("http://tablet:8000", "robot:8080", false, others));
  EXPECT_FALSE(same_origin("http://tablet:8001", "robot:8080", false, others));
  EXPECT_FALSE(same_origin("", "robot:8080", false, {""}));
}

TEST(Origin, KnowsThisMachinesNames) {
  for (const char* host : {"localhost", "localhost:8080", "127.0.0.1:1", "127.9.9.9", "[::1]", "[::1]:8080"}) {
    EXPECT_TRUE(is_this_machine(host)) << host;
  }
  for (const char* host :
       {"", "robot", "127.0.0.1.evil.example", "evil.example:127", "[::2]", "localhost.evil.example"}) {
    EXPECT_FALSE(is_this_machine(host)) << host;
  }
}

TEST(Cookie, IsFoundByItsWholeNameOnce) {
  EXPECT_EQ(cookie_value("ivo=abc", "ivo"), "abc");
  EXPECT_EQ(cookie_value("a=1; ivo=abc; b=2", "ivo"), "abc");
  EXPECT_EQ(cookie_value("ivo2=abc; xivo=abc", "ivo"), "");
  EXPECT_EQ(cookie_value("ivo=abc; ivo=def", "ivo"), "");
  EXPECT_EQ(cookie_value("", "ivo"), "");
  EXPECT_EQ(bearer_token("Bearer abc"), "abc");
  EXPECT_EQ(bearer_token("Basic abc"), "");
}

}  // namespace
}  // namespace ivo::firmware::web
