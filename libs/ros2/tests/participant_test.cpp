// SPDX-License-Identifier: Apache-2.0
// Two participants of one process, which talk over the loopback.
#include "rave/ros2/participant.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <limits>

#include "rave/bus/bus.hpp"
#include "rave/ros2/reader.hpp"
#include "rave/ros2/waiter.hpp"
#include "rave/ros2/writer.hpp"

namespace rave::ros2 {
namespace {

/// Tests of several processes at once must not meet; there is no tag in ROS 2.
std::uint32_t own_domain() { return 1 + static_cast<std::uint32_t>(::getpid()) % 90; }

std::unique_ptr<Participant> participant(const std::string& name) {
  Network network;
  network.name = name;
  network.domain = own_domain();
  auto opened = Participant::open(network);
  EXPECT_TRUE(opened) << opened.error().message;
  return opened ? *std::move(opened) : nullptr;
}

/// Looks again each time that something comes; a wait that ends by the clock has failed.
template <class Done>
bool eventually(const Waiter& waiter, Done&& done) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    waiter.wait(Duration{20'000'000});
  }
  return true;
}

TEST(Ros2Participant, AMessageCrosses) {
  const auto robot = participant("robot");
  const auto us = participant("us");
  auto writer = Writer<Twist>::create(*us, "/cart/cmd_vel");
  auto reader = Reader<Twist>::create(*robot, "/cart/cmd_vel", kReadNewest);
  auto waiter = Waiter::create(*robot);
  ASSERT_TRUE(writer && reader && waiter);
  ASSERT_TRUE(waiter->watch(reader->handle()));
  ASSERT_TRUE(eventually(*waiter, [&] {
    return writer->end().matched().size() == 1 && reader->end().matched().size() == 1;
  }));
  ASSERT_TRUE(writer->write({{0.5, 0, 0}, {0, 0, 0.25}}));
  Twist got{};
  ASSERT_TRUE(eventually(
      *waiter, [&] { return reader->take([&](const Twist& message) { got = message; }) > 0; }));
  EXPECT_EQ(got.linear.x, 0.5);
  EXPECT_EQ(got.angular.z, 0.25);
  Twist wrong{};
  wrong.linear.x = std::numeric_limits<double>::infinity();
  ASSERT_TRUE(writer->write(wrong));
  ASSERT_TRUE(eventually(*waiter, [&] {
    EXPECT_EQ(reader->take([](const Twist&) {}), 0U);
    return reader->refused() == 1;
  }));
  EXPECT_EQ(reader->trouble(), "twist.linear is inf, not within +-10000");
}

TEST(Ros2Participant, WhoComesLateGetsWhatIsKept) {
  const auto robot = participant("robot");
  const auto us = participant("us");
  auto writer = Writer<String>::create(*robot, "/cart/robot_description", kWriteKept);
  std::string text = "<robot/>";
  ASSERT_TRUE(writer && writer->write({text.data()}));
  auto reader = Reader<String>::create(*us, "/cart/robot_description", kReadKept);
  auto waiter = Waiter::create(*us);
  ASSERT_TRUE(reader && waiter && waiter->watch(reader->handle()));
  std::string got;
  ASSERT_TRUE(eventually(*waiter, [&] {
    return reader->take([&](const String& message) { got = message.data; }) > 0;
  }));
  EXPECT_EQ(got, "<robot/>");
}

TEST(Ros2Participant, AMismatchNamesThePolicyAndTheRemedy) {
  const auto robot = participant("robot");
  const auto us = participant("us");
  auto writer = Writer<String>::create(*robot, "/tf_static");
  auto reader = Reader<String>::create(*us, "/tf_static", kReadKept);
  auto waiter = Waiter::create(*us);
  ASSERT_TRUE(writer && reader && waiter);
  std::optional<std::string> said;
  ASSERT_TRUE(eventually(*waiter, [&] { return (said = reader->take_mismatch()).has_value(); }));
  EXPECT_EQ(*said,
            "a writer gets nothing through to us: durability does not match; make the writer "
            "transient-local, or the reader volatile");
  ASSERT_TRUE(eventually(*waiter, [&] { return (said = writer->take_mismatch()).has_value(); }));
  EXPECT_EQ(said->substr(0, 31), "a reader gets nothing from us: ");
}

TEST(Ros2Participant, SilenceIsExplained) {
  const auto us = participant("us");
  auto reader = Reader<LaserScan>::create(*us, "/scan", kReadNewest);
  ASSERT_TRUE(reader);
  const std::string domain = std::to_string(own_domain());
  EXPECT_EQ(reader->explain_silence(),
            "no other participant is in domain " + domain +
                " at 127.0.0.1; compare ROS_DOMAIN_ID, `interface`, `multicast` and `peers`");
  const auto robot = participant("robot");
  auto waiter = Waiter::create(*us);
  ASSERT_TRUE(waiter);
  const auto says = [&](const std::string& text) {
    EXPECT_TRUE(eventually(*waiter, [&] { return reader->explain_silence() == text; }))
        << reader->explain_silence();
  };
  says("no participant writes `/scan`, nor the type sensor_msgs/msg/LaserScan elsewhere");
  auto elsewhere = Writer<LaserScan>::create(*robot, "/front/scan");
  says("no participant writes `/scan`; the type sensor_msgs/msg/LaserScan is at /front/scan");
  {
    auto other = Writer<Imu>::create(*robot, "/scan");
    ASSERT_TRUE(other);
    says("topic `/scan` has the type sensor_msgs/msg/Imu; expected sensor_msgs/msg/LaserScan");
  }
  auto right = Writer<LaserScan>::create(*robot, "/scan");
  says("another participant writes `/scan`, but no message came");
}

TEST(Ros2Participant, ABusOfTheSameDomainIsNoHindrance) {
  const auto before = participant("before");
  bus::BusConfig config;
  config.participant = "host";
  config.run = bus::RunId::random();
  config.domain = own_domain();
  const auto bus = bus::Bus::open(config);
  ASSERT_TRUE(bus) << bus.error().message;
  const auto after = participant("after");
  ASSERT_TRUE(before && after);
}

TEST(Ros2Participant, WrongNetworksAreNamed) {
  Network network;
  network.interface = "no_such_interface";
  const std::string missing = "interface: this machine has no `no_such_interface`; ";
  EXPECT_EQ(Participant::open(network).error().message.substr(0, missing.size()), missing);
  network = {};
  network.domain = 231;
  EXPECT_EQ(Participant::open(network).error().message, "domain: found 231, expected 0 to 230");
}

TEST(Ros2Participant, ABellThatRangBeforeEndsTheNextWait) {
  const auto us = participant("us");
  auto waiter = Waiter::create(*us);
  ASSERT_TRUE(waiter);
  waiter->ring();
  waiter->wait(Duration{INT64_MAX / 2});
}

}  // namespace
}  // namespace rave::ros2
