// SPDX-License-Identifier: Apache-2.0
// Orders from a page, over the server of the run: the same orders at the same steps to robots in
// one process and in several; two pages of one person; and what they say to one another.
#include <fstream>

#include "held_run.hpp"
#include "raw_client.hpp"

namespace rave::cli_test {
namespace {

using gui_server::testing::RawClient;
using gui_server::testing::RawSocket;

class PageOrders : public HeldRun {
 protected:
  void SetUp() override {
    std::ofstream(folder_.path() / "index.html") << "<!doctype html><title>page</title>\n";
  }
  /// The words that serve a page beside a run.
  [[nodiscard]] Words with_page(Words words) const {
    words.insert(words.end(), {"--gui", "--page", folder_.path(), "--port", "0", "--no-open"});
    return words;
  }
  /// Signs in by the link that the run printed.
  void sign_in() {
    const std::string begin = "http://127.0.0.1:";
    wait_until([&] { return content_of(output_ + ".log").find("/enter") != std::string::npos; });
    const std::string said = content_of(output_ + ".log");
    const std::string place = said.substr(said.find(begin) + begin.size());
    port_ = static_cast<std::uint16_t>(std::stoi(place));
    const std::string target =
        place.substr(place.find('/'), place.find_first_of(" \n") - place.find('/'));
    RawClient client(port_, {});
    client.send(fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n\r\n",
                            target, port_));
    const std::string answer = client.read_all();
    const std::size_t at = answer.find("Set-Cookie: ");
    ASSERT_NE(at, std::string::npos) << answer;
    cookie_ = answer.substr(at + 12, answer.find(';', at) - at - 12);
  }
  [[nodiscard]] RawSocket page() const {
    return {
        port_, {}, fmt::format("Cookie: {}\r\nOrigin: http://127.0.0.1:{}\r\n", cookie_, port_)};
  }
  /// Sends a request and returns its answer.
  static std::string ask(RawSocket& page, const std::string& message) {
    static int number = 0;
    const std::string request = fmt::format("\"request\":{}", ++number);
    page.send(fmt::format("{{{},{}}}", message, request));
    return page.text_with(request);
  }
  static void give(RawSocket& page, const std::string& message) {
    EXPECT_NE(ask(page, message).find("\"good\":true"), std::string::npos) << message;
  }
  static std::string order(const std::string& kind, int slot, const std::string& more = {}) {
    return fmt::format(R"("type":"order","kind":"{}","slots":[{}]{})", kind, slot, more);
  }
  std::uint16_t port_ = 0;
  std::string cookie_;
};

TEST_F(PageOrders, TwoPagesOfOnePersonAskOneAnother) {
  start("pages", with_page({"--no-record"}));
  sign_in();
  RawSocket first = page();
  RawSocket second = page();
  give(first, order("goal", 1, R"(,"points":[[-2.5,-3]])"));
  const std::string refused = ask(second, order("goal", 1, R"(,"points":[[-2.5,-2.5]])"));
  EXPECT_NE(refused.find("you drive bert on another page: give it back there, or take it here"),
            std::string::npos)
      << refused;
  EXPECT_NE(first.text_with(R"("lease":"the operator","yours":true)"), "");
  EXPECT_NE(second.text_with(R"("lease":"the operator","yours":false)"), "");
  give(second, R"("type":"lease","do":"force","slots":[1])");
  EXPECT_NE(ask(first, order("cancel", 1)).find("on another page"), std::string::npos);
  give(second, order("cancel", 1));
  // To stop needs no lease.
  first.send(R"({"type":"halt","do":"stop","slots":[1]})");
  EXPECT_NE(first.text_with("\"to\":\"stop\"").find("\"good\":true"), std::string::npos);
}

}  // namespace
}  // namespace rave::cli_test
