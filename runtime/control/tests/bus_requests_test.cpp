// SPDX-License-Identifier: Apache-2.0
#include "rave/control/bus_requests.hpp"

#include <gtest/gtest.h>

#include "rave/control/protocol.hpp"

namespace rave::control {
namespace {

/// A run that serves what it was asked when it is told to.
class BusRequestsTest : public ::testing::Test {
 protected:
  void begin(bool live) {
    runtime::RunStatus status{"tests", "", 0, 10, 1, live, false, false, {}, {}};
    status.robots.push_back({"anna", true, true, false});
    control_.begin(std::move(status));
  }
  void serve() {
    control_.serve(
        [](const request::Request& request) -> Result<std::string> {
          if (request.robot == "nobody") return fail(ErrorCode::kNotFound, "there is \x1b nobody");
          return "did it to " + request.robot;
        },
        [](runtime::RunStatus&) {});
  }
  static Answer answer_of(const bus::BegunRequest& begun) {
    const auto line = begun.answer();
    EXPECT_TRUE(line);
    if (!line) return {};
    EXPECT_EQ(line->find('\n'), std::string::npos);
    const auto answer = parse_answer(*line);
    EXPECT_TRUE(answer) << *line;
    return answer ? *answer : Answer{};
  }

  runtime::RunControl control_;
  bus::BeginRequest requests_ = bus_requests_of(control_);
};

TEST_F(BusRequestsTest, WhatTheRunDoesIsAnsweredWhenItIsDone) {
  begin(false);
  const bus::BegunRequest begun = requests_(R"({"rave":2,"do":"stop","robot":"anna"})");
  EXPECT_EQ(begun.told, R"({"rave": 2, "do": "stop", "robot": "anna"})");
  EXPECT_FALSE(begun.answer());
  serve();
  const Answer answer = answer_of(begun);
  EXPECT_TRUE(answer.good);
  EXPECT_EQ(answer.text, "did it to anna");
  const bus::BegunRequest other = requests_(R"({"rave":2,"do":"stop","robot":"nobody"})");
  serve();
  EXPECT_FALSE(answer_of(other).good);
}

TEST_F(BusRequestsTest, ARunThatEndsAnswersWhatIsOpen) {
  const bus::BegunRequest early = requests_(R"({"rave":2,"do":"stop"})");
  EXPECT_FALSE(answer_of(early).good);
  begin(false);
  const bus::BegunRequest begun = requests_(R"({"rave":2,"do":"stop"})");
  EXPECT_FALSE(begun.answer());
  control_.end();
  const Answer answer = answer_of(begun);
  EXPECT_FALSE(answer.good);
  EXPECT_NE(answer.text.find("has ended"), std::string::npos) << answer.text;
}

TEST_F(BusRequestsTest, StatusAndPausesAreAnsweredAtOnce) {
  begin(false);
  const bus::BegunRequest status = requests_(R"({"rave":2,"do":"status"})");
  EXPECT_TRUE(status.told.empty());
  EXPECT_EQ(answer_of(status).status.scenario, "tests");
  const bus::BegunRequest pause = requests_(R"({"rave":2,"do":"pause"})");
  EXPECT_FALSE(pause.told.empty());
  EXPECT_TRUE(answer_of(pause).good);
  EXPECT_TRUE(control_.paused());
}

TEST_F(BusRequestsTest, NonsenseIsRefusedWithASentenceAndLogged) {
  begin(true);
  for (const char* const line :
       {"", "x", "[]", R"({"rave":9,"do":"stop"})", R"({"rave":2,"do":"explode"})",
        R"({"rave":2,"do":"stop","robot":7})", R"({"rave":2,"do":"pause"})"}) {
    const bus::BegunRequest begun = requests_(line);
    const Answer answer = answer_of(begun);
    EXPECT_FALSE(answer.good) << line;
    EXPECT_FALSE(answer.text.empty()) << line;
    EXPECT_FALSE(begun.told.empty()) << line;
  }
  const bus::BegunRequest endless = requests_(std::string(kMaxLineBytes + 1, 'x'));
  EXPECT_NE(answer_of(endless).text.find("longer than 65536 bytes"), std::string::npos);
}

}  // namespace
}  // namespace rave::control
