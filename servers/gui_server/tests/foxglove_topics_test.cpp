// SPDX-License-Identifier: Apache-2.0
#include "foxglove/foxglove_topics.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sodium.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "fake_run.hpp"
#include "foxglove/foxglove_scene.hpp"
#include "rave/base/file.hpp"

namespace rave::gui_server {
namespace {

using Json = nlohmann::ordered_json;
using Kind = FoxgloveTopics::Kind;

TEST(FoxgloveWire, PutsNumbersLittleEndian) {
  EXPECT_EQ(foxglove_data(0x01020304, 0x1122334455667788, "{}"),
            std::string("\x01\x04\x03\x02\x01\x88\x77\x66\x55\x44\x33\x22\x11{}", 15));
  EXPECT_EQ(foxglove_time(5), std::string("\x02\x05\0\0\0\0\0\0\0", 9));
  EXPECT_EQ(foxglove_ns(1.25), 1'250'000'000U);
  EXPECT_EQ(foxglove_ns(-1), 0U);
}

TEST(FoxgloveWire, SaysWhatItIsAndHas) {
  const Json info = Json::parse(foxglove_server_info("rave", "s"));
  EXPECT_EQ(info.dump(),
            R"({"op":"serverInfo","name":"rave","capabilities":["time"],"metadata":{},)"
            R"("sessionId":"s"})");
  const std::vector<FoxgloveChannel> channels = {{7, "/a", "x.Y", "{}"}};
  EXPECT_EQ(foxglove_advertise(channels),
            R"({"op":"advertise","channels":[{"id":7,"topic":"/a","encoding":"json",)"
            R"("schemaName":"x.Y","schema":"{}","schemaEncoding":"jsonschema"}]})");
  EXPECT_EQ(foxglove_unadvertise(channels), R"({"op":"unadvertise","channelIds":[7]})");
  EXPECT_EQ(foxglove_status(FoxgloveLevel::kError, "no \"way\""),
            R"({"op":"status","level":2,"message":"no \"way\""})");
}

TEST(FoxgloveTopics, AreThoseOfTheSource) {
  const testing::FakeRun run;
  const FoxgloveTopics topics(run, 5);
  ASSERT_EQ(topics.topics().size(), 10U);
  EXPECT_EQ(topics.topics().front().channel.id, 5U);
  EXPECT_EQ(topics.topic_of(4), nullptr);
  EXPECT_EQ(topics.topic_of(15), nullptr);
  EXPECT_EQ(topics.topic_of(14)->channel.topic, "/scan/spy-4/scan");
  EXPECT_EQ(topics.topic_of(14)->sensor, (LookedAt{3, 0}));
  for (const FoxgloveChannel& channel : topics.channels()) {
    const Json schema = Json::parse(channel.schema, nullptr, false);
    ASSERT_TRUE(schema.is_object()) << channel.topic;
    EXPECT_EQ(schema.at("title"), channel.schema_name);
  }
}

/// Every member of a message is one that its schema has, of its type.
void expect_described(const Json& value, const Json& schema, const std::string& where) {
  const auto type = schema.at("type").get<std::string>();
  if (type == "object") {
    ASSERT_TRUE(value.is_object()) << where;
    for (const auto& [name, member] : value.items()) {
      ASSERT_TRUE(schema.at("properties").contains(name)) << where << "." << name;
      expect_described(member, schema["properties"][name], fmt::format("{}.{}", where, name));
    }
  } else if (type == "array") {
    ASSERT_TRUE(value.is_array()) << where;
    for (const Json& item : value) expect_described(item, schema.at("items"), where + "[]");
  } else {
    EXPECT_TRUE((type == "string" && value.is_string()) ||
                (type == "number" && value.is_number()) ||
                (type == "integer" && value.is_number_integer()) ||
                (type == "boolean" && value.is_boolean()))
        << where << ": " << value.dump();
  }
}

class FoxgloveMessages : public ::testing::Test {
 protected:
  void expect_valid(Kind kind, const std::string& message) const {
    for (const auto& topic : topics_.topics()) {
      if (topic.kind != kind) continue;
      return expect_described(Json::parse(message), Json::parse(topic.channel.schema), "");
    }
    FAIL();
  }

  testing::FakeRun run_;
  FoxgloveTopics topics_{run_, 1};
};

TEST_F(FoxgloveMessages, HaveRobotsWhereTheyAre) {
  PosesAt poses{1, 2.5, 250, {}};
  poses.robots = {{1.5, -2, std::acos(-1.0) / 2, 0.3, kKnown | kReal},
                  {},
                  {std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, kKnown},
                  {3, 4, 0, 0, kKnown | kStopped}};
  expect_valid(Kind::kTransforms, topics_.transforms(poses));
  const Json transforms = Json::parse(topics_.transforms(poses)).at("transforms");
  // Without a pose there is no place.
  ASSERT_EQ(transforms.size(), 2U);
  EXPECT_EQ(transforms[0].dump(),
            R"({"timestamp":{"sec":2,"nsec":500000000},"parent_frame_id":"world",)"
            R"("child_frame_id":"robot/walker-1","translation":{"x":1.5,"y":-2.0,"z":0},)"
            R"("rotation":{"x":0,"y":0,"z":0.707107,"w":0.707107}})");
  EXPECT_EQ(transforms[1].at("child_frame_id"), "robot/spy-4");
  expect_valid(Kind::kPoses, topics_.poses(poses));
  const Json robots = Json::parse(topics_.poses(poses)).at("robots");
  ASSERT_EQ(robots.size(), 4U);
  EXPECT_EQ(robots[0].at("speed_mps"), 0.3);
  EXPECT_EQ(robots[0].at("real"), true);
  EXPECT_EQ(robots[1].at("known"), false);
  EXPECT_EQ(robots[2].at("known"), false);
  EXPECT_EQ(robots[3].at("stopped"), true);
}

TEST_F(FoxgloveMessages, HavePointsOfRaysThatHit) {
  const std::string message = topics_.points({1, 0, 0, 0.5, 1, 1, {2.5F}});
  expect_valid(Kind::kScan, message);
  const Json cloud = Json::parse(message);
  EXPECT_EQ(cloud.at("frame_id"), "robot/spy-2");
  EXPECT_EQ(cloud.at("pose").at("position").dump(), R"({"x":0.1,"y":0.0,"z":0.15})");
  EXPECT_EQ(cloud.at("fields").size(), 3U);
  const auto text = cloud.at("data").get<std::string>();
  std::array<float, 3> point{};
  std::size_t size = 0;
  ASSERT_EQ(
      sodium_base642bin(reinterpret_cast<unsigned char*>(point.data()), sizeof point, text.data(),
                        text.size(), nullptr, &size, nullptr, sodium_base64_VARIANT_ORIGINAL),
      0);
  EXPECT_EQ(size, 12U);
  EXPECT_EQ(point, (std::array<float, 3>{2.5F, 0, 0}));
  const float none = std::numeric_limits<float>::infinity();
  EXPECT_EQ(Json::parse(topics_.points({1, 0, 0, 0.5, 1, 1, {none}})).at("data"), "");
  EXPECT_EQ(topics_.points({1, 3, 0, 0.5, 1, 1, {1}}), "");
}

TEST_F(FoxgloveMessages, HaveEventsAndTheClock) {
  const std::string log =
      FoxgloveTopics::log({3.5, 3.5, 1, "stopped", LogEvent::Level::kWarn, "spy-2: stopped", {1}});
  expect_valid(Kind::kLog, log);
  EXPECT_EQ(Json::parse(log).at("level"), 3);
  PlayState state;
  state.kind = PlayState::Kind::kPaused;
  state.now_s = 1.5;
  expect_valid(Kind::kRun, FoxgloveTopics::run(state));
  EXPECT_EQ(Json::parse(FoxgloveTopics::run(state)).at("state"), "paused");
}

TEST_F(FoxgloveMessages, HaveShapesOfBodies) {
  const Json robot = robot_entity(topics_.robots()[0], kKnown | kStopped | kStale, 1);
  EXPECT_EQ(robot.at("frame_id"), "robot/walker-1");
  EXPECT_EQ(robot.at("cylinders")[0].at("size").dump(), R"({"x":0.4,"y":0.4,"z":0.3})");
  EXPECT_EQ(robot.at("cylinders")[0].at("color").at("a"), 0.3);
  EXPECT_EQ(robot.at("texts")[0].at("text"), "walker-1");
  FoxgloveScene scene;
  scene.anew = true;
  scene.gone = {"9"};
  for (const Json& body : Json::parse(run_.bodies_json())) {
    scene.entities.push_back(body_entity(body, 1));
  }
  // An outline with a corner that points inwards, turned by a quarter.
  scene.entities.push_back(body_entity(
      Json::parse(R"({"id":5,"name":"l","kind":"wall","pose":[1,1,1.5707963267948966],"shapes":[)"
                  R"({"polygon":[[0,0],[2,0],[2,1],[1,1],[1,2],[0,2]],"z":[0,1]}],)"
                  R"("colour":"#ff0080"})"),
      1));
  const std::string message = scene_update(std::move(scene), 1);
  expect_valid(Kind::kScene, message);
  const Json update = Json::parse(message);
  EXPECT_EQ(update.at("deletions").size(), 2U);
  const Json& hall = update.at("entities")[1];
  EXPECT_EQ(hall.at("frame_id"), "world");
  EXPECT_EQ(hall.at("cubes")[0].at("pose").at("position").dump(), R"({"x":2.0,"y":3.0,"z":1.0})");
  EXPECT_EQ(hall.at("cubes")[0].at("size").dump(), R"({"x":2.0,"y":0.2,"z":2.0})");
  const Json& corner = update.at("entities")[2];
  ASSERT_GE(corner.at("cubes").size() + corner.at("triangles").size(), 2U);
  for (const Json& piece : corner.at("triangles")) {
    EXPECT_EQ(piece.at("pose").at("position").dump(), R"({"x":1.0,"y":1.0,"z":0.0})");
    EXPECT_EQ(piece.at("color").at("r"), 1.0);
    const std::size_t points = piece.at("points").size();
    for (const Json& index : piece.at("indices")) EXPECT_LT(index.get<std::size_t>(), points);
    EXPECT_EQ(piece.at("indices").size(), 3 * (2 * (points / 2 - 2) + points));
  }
}

/// All strings of a document that begin like a topic.
void collect_topics(const Json& value, std::set<std::string>& topics) {
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    if (text.starts_with('/')) topics.insert(text.substr(0, text.find('.')));
  } else if (value.is_structured()) {
    for (const auto& [name, member] : value.items()) {
      if (name.starts_with('/')) topics.insert(name);
      collect_topics(member, topics);
    }
  }
}

TEST_F(FoxgloveMessages, AreWhatTheLayoutShows) {
  const auto text = read_file(RAVE_FOXGLOVE_LAYOUT, 100'000);
  ASSERT_TRUE(text) << text.error().text();
  const Json layout = Json::parse(*text, nullptr, false);
  ASSERT_TRUE(layout.is_object());
  std::set<std::string> shown;
  collect_topics(layout, shown);
  std::set<std::string> known;
  for (const auto& topic : topics_.topics()) known.insert(topic.channel.topic);
  EXPECT_GE(shown.size(), 4U);
  for (const std::string& topic : shown) EXPECT_TRUE(known.contains(topic)) << topic;
  // Each panel of the arrangement has its settings.
  const std::string arrangement = layout.at("layout").dump();
  for (const auto& [panel, settings] : layout.at("configById").items()) {
    EXPECT_NE(arrangement.find('"' + panel + '"'), std::string::npos) << panel;
  }
}

}  // namespace
}  // namespace rave::gui_server
