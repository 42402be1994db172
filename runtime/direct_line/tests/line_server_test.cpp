// SPDX-License-Identifier: Apache-2.0
// A hostile client at the direct line of a host, over real sockets and TLS: tickets that are
// forged, replayed, expired, withdrawn, of others; orders beyond a ticket, and floods.
#include "rave/direct_line/line_server.hpp"

#include <gtest/gtest.h>

#include "line_fixture.hpp"

namespace rave::direct_line {
namespace {

using namespace testing;
using web::testing::RawSocket;

TEST_F(DirectLine, OrdersOfATicketReachTheRunWithItsName) {
  RawSocket anna = line();
  anna.send(drive(1, "green-1", R"("v":0.5,"w":-1,"echo":true)"));
  EXPECT_NE(anna.text_with("\"answer\"").find(R"("id":1,"good":true)"), std::string::npos);
  anna.send(R"({"type":"order","id":2,"kind":"goal","robot":"green-2","points":[[1,2]]})");
  EXPECT_NE(anna.text_with("\"answer\"").find("did goal green-2"), std::string::npos);
  anna.send(R"({"type":"order","id":3,"kind":"text","robot":"green-1","text":"refuse"})");
  EXPECT_NE(anna.text_with("\"answer\"").find(R"("id":3,"good":false,"text":"`ben` drives it")"),
            std::string::npos);
  anna.send(R"({"type":"ping","id":4})");
  EXPECT_EQ(anna.text_with("\"pong\""), R"({"type":"pong","id":4})");
  EXPECT_NE(anna.text_with("\"state\"").find(R"("leases":{"green-1":"anna"})"), std::string::npos);
  const auto asked = run_.asked();
  ASSERT_EQ(asked.size(), 3U);
  ASSERT_TRUE(asked[0].is<request::Drive>());
  EXPECT_EQ(asked[0].as<request::Drive>()->w_radps, -1);
  for (const auto& request : asked) {
    EXPECT_EQ(request.by, "anna");
    EXPECT_FALSE(request.overrides);
  }
}

TEST_F(DirectLine, StopIsOfAllThatTheTicketCoversAndReleaseOfTheOwnTeam) {
  RawSocket anna = line();
  anna.send(R"({"type":"order","id":1,"kind":"stop"})");
  EXPECT_NE(anna.text_with("\"answer\"").find("\"good\":true"), std::string::npos);
  anna.send(R"({"type":"order","id":2,"kind":"release"})");
  EXPECT_NE(anna.text_with("\"answer\"").find("did release green-1; did release green-2"),
            std::string::npos);
  const auto asked = run_.asked();
  ASSERT_EQ(asked.size(), 3U);
  EXPECT_EQ(asked[0].robot, "");
  EXPECT_EQ(asked[2].robot, "green-2");
}

TEST_F(DirectLine, SuperUsersOverride) {
  Ticket boss = ticket();
  boss.role = "super_user";
  RawSocket line_of_boss = line(boss);
  line_of_boss.send(R"({"type":"order","id":1,"kind":"release","robot":"green-1"})");
  EXPECT_TRUE(run_.wait_for(1).at(0).overrides);
}

TEST_F(DirectLine, TicketsThatDoNotHoldAreRefusedAndLogged) {
  const testing::PageKey thief;
  expect_refused(sign_ticket(ticket(), new_signing_key()), page_,
                 "is not signed by the GUI Server");
  expect_refused(signed_ticket(), thief, "showed a ticket of `anna` without the key of the page");
  expect_refused("forged.ticket", page_, "not a valid ticket");
  Ticket other = ticket();
  other.run = "4567";
  expect_refused(sign_ticket(other, signer_), page_, "the ticket is for another run");
  other = ticket();
  other.host = "right";
  expect_refused(sign_ticket(other, signer_), page_,
                 "the ticket is for host `right`, and this is `left`");
  other = ticket();
  other.expires_s = now_ms_ / 1000 - 60;
  expect_refused(sign_ticket(other, signer_), page_, "the ticket has expired 60 s ago");
  expect_refused(signed_ticket(), page_, "but this page is from https://evil.example",
                 "https://evil.example");
  EXPECT_TRUE(journal_.has("somebody (127.0.0.1)"));
  EXPECT_FALSE(journal_.has("has connected"));
  EXPECT_TRUE(run_.asked().empty());
}

TEST_F(DirectLine, AProofIsForOneChallengeAndOneAddress) {
  const std::string text = signed_ticket();
  RawSocket first = dial();
  const std::string proof = page_.sign(proof_text(challenge_of(first), address(), text));
  const std::string replayed =
      R"({"type":"hello","ticket":")" + text + R"(","proof":")" + base64_of(proof) + "\"}";
  RawSocket second = dial();
  EXPECT_NE(challenge_of(second), "");
  second.send(replayed);
  EXPECT_EQ(second.close_code(), 4401);
  // A host in the middle has led the page elsewhere.
  RawSocket third = dial();
  const std::string elsewhere =
      page_.sign(proof_text(challenge_of(third), "evil.example:8090", text));
  third.send(R"({"type":"hello","ticket":")" + text + R"(","proof":")" + base64_of(elsewhere) +
             "\"}");
  EXPECT_EQ(third.close_code(), 4401);
  first.send(replayed);
  EXPECT_NE(first.text_with("\"welcome\""), "");
}

TEST_F(DirectLine, NothingIsTakenBeforeATicket) {
  for (const std::string& message :
       {drive(1, "green-1"), std::string(R"({"type":"order","id":1,"kind":"stop"})"),
        std::string(R"({"type":"ping","id":1})"),
        "{\"type\":\"ticket\",\"ticket\":\"" + signed_ticket() + "\"}"}) {
    RawSocket socket = dial();
    socket.send(message);
    EXPECT_EQ(socket.close_code(), 4401) << message;
  }
  EXPECT_TRUE(run_.asked().empty());
}

TEST_F(DirectLine, OrdersBeyondTheTicketAreRefusedAndLogged) {
  RawSocket anna = line();
  int id = 0;
  for (const char* const order :
       {R"("kind":"drive","robot":"blue-1","v":1,"w":0)",
        R"("kind":"goal","robot":"blue-1","points":[[0,0]])",
        R"("kind":"release","robot":"blue-1")", R"("kind":"take","robot":"blue-1","force":true)",
        R"("kind":"drive","robot":"nobody","v":1,"w":0)"}) {
    anna.send(fmt::format(R"({{"type":"order","id":{},{}}})", ++id, order));
    const std::string answer = anna.text_with("\"answer\"");
    EXPECT_NE(answer.find("your rights do not include"), std::string::npos) << answer;
  }
  EXPECT_TRUE(run_.asked().empty());
  EXPECT_TRUE(journal_.has(
      "refused drive of anna (127.0.0.1): your rights do not include `drive` of `blue-1`"))
      << journal_.text();
  anna.send(drive(9, "green-1", R"("v":NaN,"w":0)"));
  EXPECT_NE(anna.text_with("\"answer\"").find("\"good\":false"), std::string::npos);
  EXPECT_TRUE(run_.asked().empty());
}

TEST_F(DirectLine, AWithdrawalEndsLinesAndTheirTickets) {
  RawSocket anna = line();
  anna.send(drive(1, "green-1"));
  EXPECT_EQ(run_.wait_for(1).size(), 1U);
  // Of somebody else, of another run, of a stranger, and of an epoch that is over: nothing happens.
  server_->withdraw(sign_withdrawal({"0123", "ben", 9}, signer_));
  server_->withdraw(sign_withdrawal({"4567", "anna", 9}, signer_));
  server_->withdraw(sign_withdrawal({"0123", "anna", 9}, new_signing_key()));
  server_->withdraw(sign_withdrawal({"0123", "anna", 5}, signer_));
  anna.send(R"({"type":"ping","id":1})");
  EXPECT_NE(anna.text_with("\"pong\""), "");
  EXPECT_FALSE(journal_.has("rights changed"));
  server_->withdraw(sign_withdrawal({"0123", "anna", 9}, signer_));
  EXPECT_EQ(anna.close_code(), 4403);
  // What was driven stands.
  const auto asked = run_.wait_for(2);
  ASSERT_EQ(asked.size(), 2U);
  EXPECT_EQ(asked[1].action, request::Action(request::Drive()));
  expect_refused(signed_ticket(), page_, "the ticket of `anna` was withdrawn");
  Ticket next = ticket();
  next.epoch = 9;
  EXPECT_NE(line(next).answer(), "");
}

TEST_F(DirectLine, AHostThatExpiresEndsTheLineAndARenewedOneGoesOn) {
  RawSocket anna = line();
  RawSocket ben = [this] {
    Ticket of_ben = ticket();
    of_ben.user = "ben";
    of_ben.nonce = "second";
    return line(of_ben);
  }();
  now_ms_ += (kTicketLife_s / 2) * 1000;
  anna.send(R"({"type":"ticket","ticket":")" + signed_ticket() + "\"}");
  EXPECT_NE(anna.text_with("\"renewed\""), "");
  // The ticket of somebody else does not make anna another.
  now_ms_ += (kTicketLife_s / 2 + kClockSlack_s + 1) * 1000;
  EXPECT_EQ(ben.close_code(), 4401);
  anna.send(drive(1, "green-1", R"("v":0,"w":0,"echo":true)"));
  EXPECT_NE(anna.text_with("\"answer\"").find("\"good\":true"), std::string::npos);
  Ticket of_ben = ticket();
  of_ben.user = "ben";
  anna.send(R"({"type":"ticket","ticket":")" + sign_ticket(of_ben, signer_) + "\"}");
  EXPECT_EQ(anna.close_code(), 4401);
}

TEST_F(DirectLine, TheRobotStandsWhenThePageIsGone) {
  {
    RawSocket anna = line();
    anna.send(drive(1, "green-1"));
    anna.send(drive(2, "green-2", R"("v":0,"w":0)"));
    EXPECT_EQ(run_.wait_for(2).size(), 2U);
  }
  const auto asked = run_.wait_for(3);
  ASSERT_GE(asked.size(), 3U);
  EXPECT_EQ(asked[2].action, request::Action(request::Drive()));
  EXPECT_EQ(asked[2].robot, "green-1");
  EXPECT_EQ(asked[2].by, "anna");
}

/// The run of the test tells of another's lease all the time, as one does that has just been asked.
TEST_F(DirectLine, APageThatIsGoneLeavesTheLeasesOfWhatItHasOrdered) {
  {
    RawSocket anna = line();
    anna.send(R"({"type":"order","id":1,"kind":"goal","robot":"green-2","points":[[1,2]]})");
    anna.send(R"({"type":"order","id":2,"kind":"stop","robot":"blue-1"})");
    EXPECT_EQ(run_.wait_for(2).size(), 2U);
  }
  const auto asked = run_.wait_for(3);
  ASSERT_EQ(asked.size(), 3U);
  EXPECT_EQ(asked[2].action, request::Action(request::Give{"anna"}));
  EXPECT_EQ(asked[2].robot, "green-2");
  EXPECT_EQ(asked[2].by, "anna");
  EXPECT_EQ(asked[2].page, asked[0].page);
}

TEST_F(DirectLine, ALeaseIsGivenOnlyToAPersonWhoIsHere) {
  RawSocket anna = line();
  const auto give = [&anna](const char* to) {
    anna.send(
        fmt::format(R"({{"type":"order","id":1,"kind":"give","robot":"green-1","to":"{}"}})", to));
    return anna.text_with("\"answer\"");
  };
  EXPECT_NE(
      give("ben").find("`ben` is not here, or may not command green-1; no other person who may "
                       "is here"),
      std::string::npos);
  Ticket of_ben = ticket();
  of_ben.user = "ben";
  of_ben.nonce = "second";
  const RawSocket ben = line(of_ben);
  EXPECT_NE(give("zoe").find("`zoe` is not here, or may not command green-1; it can be given to "
                             "ben"),
            std::string::npos);
  EXPECT_TRUE(run_.asked().empty());
  EXPECT_NE(give("ben").find("\"good\":true"), std::string::npos);
  EXPECT_NE(give("anna").find("\"good\":true"), std::string::npos) << "to her next page";
}

TEST_F(DirectLine, TheRobotStandsWhenTheHostEnds) {
  RawSocket anna = line();
  anna.send(drive(1, "green-1"));
  EXPECT_EQ(run_.wait_for(1).size(), 1U);
  server_.reset();
  ASSERT_EQ(run_.wait_for(2).size(), 2U);
  EXPECT_EQ(run_.asked()[1].action, request::Action(request::Drive()));
  EXPECT_EQ(anna.close_code(), 1001);
}

TEST_F(DirectLine, TheNewerLineOfAPageStays) {
  RawSocket old = line();
  RawSocket young = line();
  EXPECT_EQ(old.close_code(), 4408);
  young.send(R"({"type":"ping","id":7})");
  EXPECT_NE(young.text_with("\"pong\""), "");
}

TEST_F(DirectLine, OfManyDrivesTheNewestCountsAndAStopIsNotHeldUp) {
  RawSocket anna = line();
  run_.stuck = true;
  for (int i = 0; i < 400; ++i) {
    anna.send(drive(i, "green-1", fmt::format(R"("v":{},"w":0)", 0.001 * i).c_str()));
  }
  anna.send(R"({"type":"order","id":500,"kind":"stop"})");
  anna.send(R"({"type":"ping","id":1})");
  EXPECT_NE(anna.text_with("\"pong\""), "");
  run_.stuck = false;
  const auto asked = run_.wait_for(3);
  ASSERT_GE(asked.size(), 3U);
  EXPECT_LE(asked.size(), 4U);
  // The first one was under way already; what came in between is old.
  EXPECT_TRUE(asked[1].is<request::Stop>());
  EXPECT_EQ(asked.back().action, request::Action(request::Drive{0.001 * 399, 0}));
}

TEST_F(DirectLine, FloodsEndTheLineAndHarmNobodyElse) {
  Ticket of_ben = ticket();
  of_ben.user = "ben";
  of_ben.nonce = "second";
  RawSocket ben = line(of_ben);
  RawSocket anna = line();
  for (int i = 0; i < 2000; ++i) anna.send(drive(i, "green-1"));
  EXPECT_EQ(anna.close_code(), 4429);
  EXPECT_TRUE(journal_.has("cut off anna (127.0.0.1): too many messages"));
  RawSocket nonsense = line();
  for (int i = 0; i < 30; ++i) nonsense.send("{}");
  EXPECT_EQ(nonsense.close_code(), 4400);
  EXPECT_TRUE(journal_.has("cut off anna (127.0.0.1): malformed messages"));
  ben.send(R"({"type":"order","id":1,"kind":"stop"})");
  EXPECT_NE(ben.text_with("\"answer\"").find("\"good\":true"), std::string::npos);
  RawSocket large = dial();
  EXPECT_NE(challenge_of(large), "");
  large.send(std::string(400'000, ' '));
  EXPECT_EQ(large.close_code(), 1009);
}

TEST_F(DirectLine, StrangersHaveFiveSecondsAndFewPlaces) {
  std::vector<std::unique_ptr<RawSocket>> strangers;
  for (int i = 0; i < 65; ++i) strangers.push_back(std::make_unique<RawSocket>(dial()));
  EXPECT_EQ(strangers.front()->close_code(), 4429) << "the oldest goes";
  EXPECT_EQ(strangers.back()->close_code(), 4401);
  EXPECT_TRUE(journal_.has("showed no ticket"));
  EXPECT_NE(line().answer(), "");
}

TEST(DirectLineOptions, AnotherAddressNeedsTls) {
  runtime::RunControl control;
  LineOptions options;
  options.address = "0.0.0.0";
  const auto started = LineServer::start(options, control);
  ASSERT_FALSE(started);
  EXPECT_NE(started.error().message.find("a direct line on 0.0.0.0 needs TLS"), std::string::npos);
  options.address = "127.0.0.1";
  const auto here = LineServer::start(options, control);
  ASSERT_TRUE(here) << here.error().text();
  EXPECT_EQ((*here)->url(), fmt::format("ws://127.0.0.1:{}/ws", (*here)->port()));
}

}  // namespace
}  // namespace rave::direct_line
