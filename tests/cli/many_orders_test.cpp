// SPDX-License-Identifier: Apache-2.0
// Orders of a person to all robots of a run at once, over the bus (topic rave/command): each is
// answered by the host of its robot, however many they are.
#include <fmt/format.h>

#include <chrono>
#include <future>

#include "bus_requests.hpp"
#include "rave/control/command_sender.hpp"
#include "stranger.hpp"

namespace rave::cli_test {
namespace {

using Answer = std::future<Result<std::string>>;

const request::Goal kGoal{{0, 15}, {}};

class ManyOrders : public BusRequests {
 protected:
  void start_with_sender(const std::string& scenario, bool live) {
    Words more = {"--duration", "100000", "--no-record", "--run", run_.text()};
    // In real time nothing of this scenario needs a manager.
    if (!live) {
      more.insert(more.end(), {"--pace", "1x"});
      start("env", "env", scenario, more);
    }
    start_host("one", scenario, more);
    start_host("two", scenario, more);
    wait_until(
        [this] {
          const std::string listed = near({"ps", "--robots"}).out;
          return listed.find("left-100") != std::string::npos &&
                 listed.find("right-100") != std::string::npos;
        },
        "both hosts run");
    for (const char* const team : {"left", "right"}) {
      for (int i = 1; i <= 100; ++i) robots_.push_back(fmt::format("{}-{}", team, i));
    }
    auto sender = control::CommandSender::open(stranger_config(apart(), run_), robots_);
    ASSERT_TRUE(sender) << sender.error().text();
    sender_ = *std::move(sender);
  }
  static request::Request order(request::Action action, const std::string& robot,
                                const std::string& by = "lisa") {
    return {std::move(action), robot, by};
  }
  std::string answer(request::Request request) {
    auto posted = sender_->post(std::move(request));
    if (!posted) return "not sent: " + posted.error().message;
    const auto result = posted->get();
    return result ? "done: " + *result : "refused: " + result.error().message;
  }
  /// All orders are on their way before the first answer is looked at.
  void order_all(const request::Action& action) {
    std::vector<Answer> answers;
    for (const std::string& robot : robots_) {
      auto posted = sender_->post(order(action, robot));
      ASSERT_TRUE(posted) << posted.error().text();
      answers.push_back(*std::move(posted));
    }
    for (std::size_t r = 0; r < robots_.size(); ++r) {
      const auto result = answers[r].get();
      ASSERT_TRUE(result) << robots_[r] << ": " << result.error().text();
      EXPECT_NE(result->find(robots_[r]), std::string::npos) << *result;
    }
  }
  [[nodiscard]] std::size_t robots_with(const std::string& text) const {
    const std::string listed = near({"ps", "--robots"}).out;
    std::size_t count = 0;
    for (std::size_t at = listed.find(text); at != std::string::npos;
         at = listed.find(text, at + 1))
      ++count;
    return count;
  }

  bus::RunId run_ = bus::RunId::random();
  std::vector<std::string> robots_;
  std::unique_ptr<control::CommandSender> sender_;
};

TEST_F(ManyOrders, InLockStepAllAreAnsweredAndObeyed) {
  start_with_sender("many_orders.yaml", false);
  order_all(kGoal);
  wait_until([this] { return robots_with("goal 0.00, 15.00") >= robots_.size(); }, "all go there");
  // Who drives is decided at the hosts, for each of their robots.
  EXPECT_EQ(answer(order(kGoal, "right-7", "mark")), "refused: `lisa` drives right-7");
  EXPECT_EQ(answer(order(request::Text{"hello"}, "left-3")),
            "refused: robot `left-3`, text: its program takes no texts");
  order_all(request::Cancel());
  wait_until([this] { return robots_with("goal 0.00, 15.00") == 0; }, "no order is left");
  end_by_hand("env");
}

TEST_F(ManyOrders, InRealTimeAllAreAnsweredAndObeyed) {
  start_with_sender("many_live_orders.yaml", true);
  order_all(kGoal);
  wait_until([this] { return robots_with("goal 0.00, 15.00") >= robots_.size(); }, "all go there");
  order_all(request::Cancel());
}

TEST_F(ManyOrders, AHostThatIsGoneDoesNotAnswerAndTheSenderSaysSo) {
  start_with_sender("many_live_orders.yaml", true);
  EXPECT_EQ(answer(order(kGoal, "right-1")).substr(0, 5), "done:");
  signal("two", SIGKILL);
  static_cast<void>(end_of("two"));
  EXPECT_EQ(answer(order(kGoal, "right-1")),
            "refused: the host of right-1 has not answered for 5 s; the order may still be carried "
            "out");
  EXPECT_EQ(answer(order(kGoal, "left-1")).substr(0, 5), "done:");
  EXPECT_EQ(answer(order(kGoal, "left-999")), "not sent: there is no robot `left-999`");
}

}  // namespace
}  // namespace rave::cli_test
