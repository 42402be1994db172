// SPDX-License-Identifier: Apache-2.0
// Orders from a page, over the server of the run: the same orders at the same steps to robots in
// one process and in several; two pages of one person; and what they say to one another.
#include <fstream>
#include <optional>
#include <sstream>

#include "held_run.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/merge.hpp"
#include "rave/record/run_messages.hpp"
#include "rave/record/run_reader.hpp"
#include "signed_in.hpp"

namespace rave::cli_test {
namespace {

using web::testing::RawSocket;

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
    wait_until([&] { return SignedIn::is_in(content_of(output_ + ".log")); });
    person_.emplace(content_of(output_ + ".log"));
  }
  [[nodiscard]] RawSocket page() const { return person_->page(); }
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
  /// The hash of a run in which a page asks all kinds of things.
  std::string hash_of_orders(const std::string& name, const Words& more) {
    start(name, with_page(more));
    sign_in();
    go_to(450);
    {
      RawSocket page = this->page();
      give(page, order("goal", 1, R"(,"points":[[-2.5,-3]])"));
      give(page, order("path", 2, R"(,"points":[[3,-2.8],[3.2,-2.8]],"speed":0.3)"));
      give(page, order("text", 2, R"(,"text":"hello")"));
      give(page, order("place", 0, R"(,"points":[[2.5,0.5]],"yaw":1.5)"));
      give(page, R"("type":"say","to":"all","text":"what I say changes nothing")");
      give(page, R"("type":"say","to":"role","name":"commander","text":"nor to commanders")");
      go_to(600);
      give(page, order("goal", 0, R"(,"points":[[2.2,-0.5]])"));
      give(page, order("drive", 1, R"(,"v":0.2,"w":0.3)"));
      // Nobody says it again, so it becomes a zero; the lease that ends gives it to its program.
      wait_until([&] { return driven_by("bert").empty(); });
      go_to(700);
      give(page, order("cancel", 0));
    }
    return end_of_show();
  }
  /// Who has the lease of a robot; empty: nobody.
  [[nodiscard]] std::string driven_by(const std::string& robot) const {
    std::istringstream lines(rave({"ps", "--robots"}).out);
    // Of several processes the host and the manager tell of it.
    for (std::string line; std::getline(lines, line);) {
      const bool its = line.find("  " + robot + ' ') != std::string::npos;
      if (its && line.find(" drives it") != std::string::npos) return line;
    }
    return {};
  }
  /// What the record of the run says of the chat.
  [[nodiscard]] std::vector<record::RunChat> chat() const {
    std::vector<record::RunChat> lines;
    const auto run = record::open_run(output_);
    EXPECT_TRUE(run) << run.error().text();
    const auto reader = record::McapReader::open(run->file);
    EXPECT_TRUE(reader) << reader.error().text();
    const auto read = record::for_each_message(
        *reader, record::topic::kChat, [&](const record::MessageView& message) -> Status {
          RAVE_TRY_ASSIGN(auto said, record::decode_chat(message.bytes));
          lines.push_back(std::move(said.second));
          return {};
        });
    EXPECT_TRUE(read);
    return lines;
  }

  std::optional<SignedIn> person_;
};

TEST_F(PageOrders, TheHashIsThatOfOneProcessAndTheChatIsInTheRecord) {
  const auto expect_chat = [this] {
    const auto lines = chat();
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[0].from, "the operator");
    EXPECT_EQ(lines[0].role, "super_user");
    EXPECT_EQ(lines[0].to, "all");
    EXPECT_EQ(lines[0].text, "what I say changes nothing");
    EXPECT_EQ(lines[1].to, "role");
    EXPECT_EQ(lines[1].name, "commander");
  };
  const std::string alone = hash_of_orders("alone", {});
  ASSERT_EQ(alone.size(), 16U) << alone;
  expect_verified(false);
  expect_chat();
  const std::string events = content_of(output_ + "/events.log");
  for (const std::string order : {"drive 0.20 m/s, 0.30 rad/s (by hand: the operator)",
                                  "place 2.50, 0.50, yaw 86 deg (by hand: the operator)"}) {
    EXPECT_NE(events.find(order), std::string::npos) << order << "\n" << events;
  }
  EXPECT_EQ(events.find("drive 0.00"), std::string::npos)
      << "a page that goes stops nothing that it drove long ago";
  EXPECT_EQ(events.find("what I say"), std::string::npos)
      << "not everybody who reads this may know";
  EXPECT_EQ(hash_of_orders("split", split()), alone);
  expect_verified(true);
  expect_chat();
}

TEST_F(PageOrders, TwoPagesOfOnePersonAskOneAnother) {
  pace_ = "0.5x";
  start("pages", with_page({"--no-record"}));
  HeldRun::give({"resume"});
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

TEST_F(PageOrders, APageThatIsLoadedAnewHasItsRobots) {
  pace_ = "0.5x";
  start("reload", with_page({"--no-record"}));
  HeldRun::give({"resume"});
  sign_in();
  {
    RawSocket page = this->page();
    give(page, order("goal", 1, R"(,"points":[[-2.5,-3]])"));
  }
  RawSocket again = page();
  EXPECT_NE(again.text_with(R"("lease":"the operator","yours":true)"), "");
  give(again, order("goal", 1, R"(,"points":[[-2.6,-3]])"));
}

}  // namespace
}  // namespace rave::cli_test
