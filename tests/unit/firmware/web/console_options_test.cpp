#include "firmware/web/console_options.hpp"

#include <gtest/gtest.h>

namespace ivo::firmware::web {
namespace {

Result<ConsoleOptions> options_of(const std::vector<const char*>& arguments, const std::string& state_home = "") {
  return parse_console_options(arguments, {.program_folder = "/opt/ivo", .state_home = state_home});
}

std::string complaint_of(const std::vector<const char*>& arguments) {
  const auto options = options_of(arguments);
  return options ? "taken" : options.error().message;
}

TEST(ConsoleOptions, ServeThisMachineAloneUnlessTold) {
  const ConsoleOptions options = options_of({}).value();
  EXPECT_EQ(options.listening.address, "127.0.0.1");
  EXPECT_EQ(options.listening.port, 8080);
  EXPECT_EQ(options.socket, "/run/ivo/console.sock");
  EXPECT_EQ(options.page, "/opt/ivo/web");
  EXPECT_EQ(options.state, "/var/lib/ivo-console");
  EXPECT_EQ(options_of({}, "/home/ana/.local/state").value().state, "/home/ana/.local/state/ivo-console");
}

TEST(ConsoleOptions, TakeTheirValues) {
  const ConsoleOptions options =
      options_of({"--socket", "/s", "--listen=::", "--port", "0", "--certificate", "c", "--key", "k", "--origin",
                  "http://a:1", "--origin", "https://b", "--web", "w", "--leaflet", "l", "--state", "d"})
          .value();
  EXPECT_EQ(options.listening.address, "::");
  EXPECT_EQ(options.listening.port, 0);
  EXPECT_EQ(options.origins, (std::vector<std::string>{"http://a:1", "https://b"}));
  EXPECT_EQ(options.leaflet, "l");
  const ConsoleOptions token = options_of({"--new-token", "rviz", "--role", "operator"}).value();
  EXPECT_EQ(token.new_token, "rviz");
  EXPECT_EQ(token.role, Role::kOperator);
  EXPECT_TRUE(options_of({"--paired"}).value().paired);
  EXPECT_EQ(options_of({"--forget", "0123abcd"}).value().forget, "0123abcd");
  EXPECT_TRUE(options_of({"--help"}).value().help);
}

TEST(ConsoleOptions, AreRefusedByName) {
  EXPECT_EQ(complaint_of({"--prot", "1"}), "\"--prot\" is no option; expected one that ivo-console --help shows");
  EXPECT_EQ(complaint_of({"8080"}), "\"8080\" is no option; expected one that ivo-console --help shows");
  EXPECT_EQ(complaint_of({"--paired=all"}), "--paired: \"all\" will not do; expected no value");
  EXPECT_EQ(complaint_of({"--port"}), "--port: has no value; expected one behind it");
  for (const char* port : {"-1", "65536", "80a", "eighty"}) {
    EXPECT_EQ(complaint_of({"--port", port}),
              "--port: \"" + std::string(port) + "\" will not do; expected a port, 0 to 65535");
  }
  EXPECT_EQ(complaint_of({"--role", "king", "--new-token", "x"}),
            "--role: \"king\" will not do; expected viewer or operator");
  EXPECT_EQ(complaint_of({"--origin", "tablet:80"}),
            "--origin: \"tablet:80\" will not do; expected http:// or https://, a host and perhaps a port");
  EXPECT_EQ(complaint_of({"--new-token", "x"}),
            "--new-token and --role: one is given without the other; expected both or none");
  EXPECT_EQ(complaint_of({"--certificate", "x"}),
            "--certificate and --key: one is given without the other; expected both or none");
}

}  // namespace
}  // namespace ivo::firmware::web
