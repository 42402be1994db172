// SPDX-License-Identifier: Apache-2.0
// A client that has an observer's session, or none, and tries everything: over real sockets and
// real TLS, against a whole server. What it may not know is searched for in every byte that it
// gets.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "hostile_fixture.hpp"

namespace rave::gui_server::testing {
namespace {

std::string bytes_of(auto value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

/// As frames.cpp has it, whose quantum is a float.
std::string bytes_of_place(double x_m) {
  return bytes_of(static_cast<std::int32_t>(std::lround(x_m / double{1e-4F})));
}

/// What nobody of team green may be told, as it would be encoded.
std::vector<std::string> secrets() {
  return {"spy-",
          "secret-pond",
          bytes_of(FakeRun::kSecretRange_m),
          bytes_of(FakeRun::kHalfRange_m),
          bytes_of(FakeRun::kSecretVariance_m2),
          bytes_of_place(FakeRun::kSecretX_m),
          bytes_of_place(FakeRun::kSecretTruth_m),
          bytes_of_place(FakeRun::kOpenTruth_m)};
}

constexpr const char* kLookAtAll =
    R"({"type":"look","poses":true,"true_poses":true,"parts":true,"max_hz":60,)"
    R"("readings":[[0,0],[1,0],[2,0],[3,0],[4294967295,0]],"variances":[0,1,2,3,4294967295]})";

/// Looks at everything until so many readings came; acknowledges frames as a page does.
void look_until(RawSocket& socket, int readings) {
  socket.send(kLookAtAll);
  int frames = 2;
  while (readings > 0 || frames > 0) {
    const auto frame = socket.next();
    ASSERT_TRUE(frame) << "the connection ended";
    if (frame->opcode != 2 || frame->payload.empty()) continue;
    if (frame->payload[0] == 2) --readings;
    if (frame->payload[0] != 1 || frame->payload.size() < 8) continue;
    --frames;
    std::uint32_t sequence = 0;
    std::memcpy(&sequence, frame->payload.data() + 4, sizeof sequence);
    socket.send(fmt::format(R"({{"type":"ack","sequence":{}}})", sequence));
  }
}

TEST_F(Hostile, ASuperUserGetsWhatIsSearchedForBelow) {
  RawSocket boss = super_user();
  look_until(boss, 8);
  for (const std::string& secret : secrets()) {
    EXPECT_NE(boss.heard().find(secret), std::string::npos) << secret;
  }
}

TEST_F(Hostile, AnObserverGetsNothingThatIsWithheldWhateverTheyAsk) {
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  ASSERT_TRUE(eve.answer().starts_with("HTTP/1.1 101")) << eve.answer();
  for (const char* const request :
       {R"({"type":"transport","do":"pause"})", R"({"type":"transport","do":"seek","value":0})",
        R"({"type":"transport","do":"step","value":5})",
        R"({"type":"halt","do":"stop","slots":[]})", R"({"type":"halt","do":"stop","slots":[0]})",
        R"({"type":"halt","do":"release","slots":[1]})",
        R"({"type":"halt","do":"stop","slots":[2,3]})",
        R"({"type":"set_right","role":"observer","class":"pose","reach":"all"})",
        R"({"type":"set_right","user":"eve","class":"recording","reach":"all"})",
        R"({"type":"see_as","role":"super_user"})", R"({"type":"see_as","user":"ada"})"}) {
    eve.send(request);
    EXPECT_NE(eve.text_with("\"type\":\"answer\"").find("\"good\":false"), std::string::npos)
        << request;
  }
  look_until(eve, 4);
  // What team blue knows together is theirs alone.
  EXPECT_EQ(eve.heard().find("global blue"), std::string::npos);
  eve.send(R"({"type":"look_maps","maps":[]})");
  eve.send(R"({"type":"look_maps","maps":["global blue","all"]})");
  for (bool all = false; !all;) {
    const auto frame = eve.next();
    ASSERT_TRUE(frame) << "the connection ended";
    all = frame->opcode == 2 && frame->payload.size() >= 8 && frame->payload[0] == 4;
  }
  const std::string& heard = eve.heard();
  for (const std::string& secret : secrets()) {
    EXPECT_EQ(heard.find(secret), std::string::npos) << secret;
  }
  // What they may see is there.
  EXPECT_NE(heard.find("walker-3"), std::string::npos);
  EXPECT_NE(heard.find("walker-1: at home"), std::string::npos);
  EXPECT_NE(heard.find("hall"), std::string::npos);
  EXPECT_NE(heard.find(bytes_of(FakeRun::kOpenRange_m)), std::string::npos);
  EXPECT_NE(heard.find(bytes_of(FakeRun::kOpenVariance_m2)), std::string::npos);
  EXPECT_NE(heard.find(R"("hidden":["virtual"])"), std::string::npos);
  EXPECT_EQ(heard.find("nowhere"), std::string::npos);
  EXPECT_EQ(run_->halted_robots, 0);
  EXPECT_EQ(run_->moved, 0);
}

/// Whether variances came before the second frame of poses.
bool hears_variances(RawSocket& socket, std::string_view look) {
  socket.send(look);
  bool variances = false;
  for (int frames = 2; frames > 0;) {
    const auto frame = socket.next();
    if (!frame) return variances;
    if (frame->opcode != 2 || frame->payload.empty()) continue;
    if (frame->payload[0] == 3 && frame->payload.size() > 20) variances = true;
    if (frame->payload[0] == 1 && (frame->payload[1] & 1) == 0) --frames;
  }
  return variances;
}

TEST_F(Hostile, VariancesNeedNoReadingsAndComeOnlyWhereTheyAreLookedAt) {
  constexpr const char* kReadings =
      R"({"type":"look","poses":true,"true_poses":false,"parts":false,"max_hz":60,"readings":[[0,0]]})";
  constexpr const char* kVariances =
      R"({"type":"look","poses":true,"true_poses":false,"parts":false,"max_hz":60,"readings":[],"variances":[0]})";
  RawSocket reader = super_user();
  EXPECT_FALSE(hears_variances(reader, kReadings));
  RawSocket watcher = super_user();
  EXPECT_TRUE(hears_variances(watcher, kVariances));
}

/// Looks at true poses until a frame of poses came; whether one of true poses came before it.
bool hears_truth(RawSocket& socket) {
  socket.send(kLookAtAll);
  bool truth = false;
  for (int frames = 3; frames > 0;) {
    const auto frame = socket.next();
    if (!frame) return truth;
    if (frame->opcode != 2 || frame->payload.size() < 8 || frame->payload[0] != 1) continue;
    const bool is_truth = (frame->payload[1] & 2) != 0;
    truth = truth || is_truth;
    if (is_truth || (frame->payload[1] & 1) != 0) continue;
    --frames;
    std::uint32_t sequence = 0;
    std::memcpy(&sequence, frame->payload.data() + 4, sizeof sequence);
    socket.send(fmt::format(R"({{"type":"ack","sequence":{}}})", sequence));
  }
  return truth;
}

TEST_F(Hostile, TruePosesAreNotEvenGatheredForWhoMayNotHaveThem) {
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  EXPECT_NE(eve.text_with("\"why_not\"").find("\"true_pose\":\"Your rights"), std::string::npos);
  EXPECT_FALSE(hears_truth(eve));
  EXPECT_FALSE(run_->asked_truth);
  RawSocket boss = super_user();
  EXPECT_TRUE(hears_truth(boss));
  EXPECT_TRUE(run_->asked_truth);
  // Of their own team, when that is given, and of nobody else.
  set_right(boss, "observer", "true_pose", "\"own\"");
  eve.send(R"({"type":"ack","sequence":1000000})");
  EXPECT_TRUE(hears_truth(eve));
  EXPECT_NE(eve.heard().find(bytes_of_place(FakeRun::kOpenTruth_m)), std::string::npos);
  EXPECT_EQ(eve.heard().find(bytes_of_place(FakeRun::kSecretTruth_m)), std::string::npos);
  // And no longer when it is taken back.
  set_right(boss, "observer", "true_pose", "\"none\"");
  EXPECT_NE(eve.text_with("\"roster\""), "");
  eve.send(R"({"type":"ack","sequence":1000000})");
  EXPECT_FALSE(hears_truth(eve));
}

/// Looks at all maps until so many tiles came; acknowledges frames as a page does.
void look_at_maps_until(RawSocket& socket, int tiles, int frames) {
  socket.send(R"({"type":"look_maps","maps":[0,1,2,3]})");
  socket.send(kLookAtAll);
  bool globals = false;
  while (tiles > 0 || frames > 0 || !globals) {
    const auto frame = socket.next();
    ASSERT_TRUE(frame) << "the connection ended";
    if (frame->opcode != 2 || frame->payload.size() < 8) continue;
    if (frame->payload[0] == 4) --tiles;
    if (frame->payload[0] != 1) continue;
    --frames;
    std::uint32_t sequence = 0;
    std::memcpy(&sequence, frame->payload.data() + 4, sizeof sequence);
    socket.send(fmt::format(R"({{"type":"ack","sequence":{}}})", sequence));
    if (frames == 4) {
      globals = true;
      socket.send(R"({"type":"look_maps","maps":["all","of spy-2","world file",4294967294]})");
    }
  }
}

std::string text_of_cells(const std::vector<std::uint8_t>& cells) {
  return {cells.begin(), cells.end()};
}

TEST_F(Hostile, MapsOfOthersAreNotEncodedWhateverIsAskedFor) {
  RawSocket boss = super_user();
  look_at_maps_until(boss, 6, 12);
  for (const auto& cells : {FakeRun::kOpenCells, FakeRun::kGlobalCells, FakeRun::kSecretCells}) {
    EXPECT_NE(boss.heard().find(text_of_cells(cells)), std::string::npos);
  }
  run_->asked_maps = 0;
  boss.send(R"({"type":"look_maps","maps":[]})");
  // Team green is theirs: their own maps and the global one, nothing of team blue.
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  look_at_maps_until(eve, 3, 12);
  const std::string& heard = eve.heard();
  EXPECT_NE(heard.find(text_of_cells(FakeRun::kOpenCells)), std::string::npos);
  EXPECT_NE(heard.find(text_of_cells(FakeRun::kGlobalCells)), std::string::npos);
  EXPECT_EQ(heard.find(text_of_cells(FakeRun::kSecretCells)), std::string::npos);
  EXPECT_EQ(heard.find("spy-"), std::string::npos);
  // Nobody even makes the maps of the others for them.
  EXPECT_EQ(run_->asked_maps & 0b1010, 0);
  EXPECT_EQ(run_->asked_maps & 0b0101, 0b0101);
}

TEST_F(Hostile, WhoGetsNoMapsGetsNoneAndNoNameOfOne) {
  RawSocket boss = super_user();
  set_right(boss, "observer", "maps", "\"none\"");
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  EXPECT_NE(eve.text_with("\"why_not\"").find("\"maps\":\"Your rights"), std::string::npos);
  look_at_maps_until(eve, 0, 12);
  const std::string& heard = eve.heard();
  for (const auto& cells : {FakeRun::kOpenCells, FakeRun::kGlobalCells, FakeRun::kSecretCells}) {
    EXPECT_EQ(heard.find(text_of_cells(cells)), std::string::npos);
  }
  EXPECT_NE(heard.find(R"({"type":"maps","maps":[]})"), std::string::npos);
  EXPECT_EQ(run_->asked_maps, 0);
  // A right that is given counts on the open connection.
  set_right(boss, "observer", "maps", "[\"green\"]");
  EXPECT_NE(eve.text_with("\"type\":\"maps\"").find("walker-3"), std::string::npos);
  // Pictures that were on their way meanwhile.
  eve.send(R"({"type":"ack","sequence":1000000})");
  look_at_maps_until(eve, 3, 12);
  EXPECT_EQ(eve.heard().find(text_of_cells(FakeRun::kSecretCells)), std::string::npos);
}

TEST_F(Hostile, RightsThatChangeAreInForceOnOpenConnections) {
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  EXPECT_NE(eve.text_with("\"roster\"").find("walker-1"), std::string::npos);
  RawSocket boss = super_user();
  set_right(boss, "observer", "pose", "[\"blue\"]");
  const std::string other = eve.text_with("\"roster\"");
  EXPECT_EQ(other.find("walker"), std::string::npos);
  EXPECT_NE(other.find("spy-2"), std::string::npos);
  // Their teams did not change, so of these robots they get no readings, and no sensors to ask for.
  EXPECT_EQ(other.find("scan"), std::string::npos);
  // And they outlive the server.
  server_.reset();
  auto again = GuiServer::start(options_, run_);
  ASSERT_TRUE(again) << again.error().text();
  server_ = *std::move(again);
  EXPECT_TRUE(audited("pose of observer: blue"));
}

TEST_F(Hostile, SeeAsShowsExactlyWhatSomebodyGets) {
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  const std::string hers = eve.text_with("\"roster\"");
  RawSocket boss = super_user();
  EXPECT_NE(boss.text_with("\"roster\""), hers);
  boss.send(R"({"type":"see_as","user":"eve"})");
  const std::string hello = boss.text_with("\"hello\"");
  EXPECT_NE(hello.find(R"("user":{"name":"eve","role":"observer"})"), std::string::npos) << hello;
  EXPECT_NE(hello.find(R"("seen_by":{"name":"you","role":"super_user"})"), std::string::npos);
  EXPECT_EQ(boss.text_with("\"roster\""), hers);
  // With her eyes nothing can be changed; with their own again it can.
  boss.send(R"({"type":"set_right","role":"observer","class":"pose","reach":"all"})");
  EXPECT_NE(boss.text_with("\"to\":\"set_right\"").find("\"good\":false"), std::string::npos);
  boss.send(R"({"type":"see_as"})");
  EXPECT_NE(boss.text_with("\"roster\"").find("spy-2"), std::string::npos);
  set_right(boss, "observer", "pose", "\"all\"");
}

TEST_F(Hostile, ACommanderStopsOnlyWhatTheyMay) {
  RawSocket boss = super_user();
  set_right(boss, "commander", "stop", "\"own\"");
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  ben.send(R"({"type":"halt","do":"stop","slots":[1]})");
  EXPECT_NE(ben.text_with("\"to\":\"stop\"").find("\"good\":false"), std::string::npos);
  EXPECT_EQ(run_->halted_robots, 0);
  ben.send(R"({"type":"halt","do":"stop","slots":[]})");
  EXPECT_NE(ben.text_with("\"to\":\"stop\"").find("\"good\":true"), std::string::npos);
  EXPECT_EQ(run_->halted_robots, 2);
  EXPECT_TRUE(audited(R"("what":"stop","user":"ben")")) << audit();
}

}  // namespace
}  // namespace rave::gui_server::testing
