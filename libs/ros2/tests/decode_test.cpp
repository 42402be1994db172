// SPDX-License-Identifier: Apache-2.0
// What the messages are on the wire: bytes written down by hand from the rules of CDR.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/bus/sequence.hpp"
#include "rave/bus_testing/cdr.hpp"
#include "rave/ros2/validate.hpp"

namespace rave::ros2 {
namespace {

using bus::testing::DecodedAs;
using bus::testing::encode_as;

/// Little endian, each value aligned to its size from the first byte behind the encapsulation.
class Bytes {
 public:
  template <class Value>
  Bytes& put(Value value) {
    while (bytes_.size() % sizeof value != 0) bytes_.push_back(std::byte{0});
    const auto* const raw = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), raw, raw + sizeof value);
    return *this;
  }
  Bytes& text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    for (const char c : text) bytes_.push_back(static_cast<std::byte>(c));
    bytes_.push_back(std::byte{0});
    return *this;
  }
  Bytes& header(std::string_view frame) { return put(7).put(8U).text(frame); }
  [[nodiscard]] const std::vector<std::byte>& all() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

TEST(Ros2Decode, TypesHaveTheNamesOfRos2AndNoKey) {
  EXPECT_STREQ(descriptor_of<LaserScan>().m_typename, "sensor_msgs::msg::dds_::LaserScan_");
  EXPECT_STREQ(descriptor_of<Twist>().m_typename, "geometry_msgs::msg::dds_::Twist_");
  EXPECT_STREQ(descriptor_of<TfMessage>().m_typename, "tf2_msgs::msg::dds_::TFMessage_");
  EXPECT_STREQ(descriptor_of<RangeReading>().m_typename, "sensor_msgs::msg::dds_::Range_");
  EXPECT_EQ(descriptor_of<LaserScan>().m_nkeys, 0U);
  EXPECT_EQ(descriptor_of<LaserScan>().type_information.sz, 0U)
      << "or an end that describes it in other words does not match";
}

TEST(Ros2Decode, AScan) {
  Bytes bytes;
  bytes.header("laser");
  for (const float value : {-1.F, 1.F, 0.5F, 0.F, 0.1F, 0.05F, 8.F}) bytes.put(value);
  bytes.put(3U).put(1.F).put(2.F).put(3.F).put(0U);
  DecodedAs<LaserScan> scan(descriptor_of<LaserScan>());
  ASSERT_TRUE(scan.decode(bytes.all()));
  EXPECT_STREQ(scan.sample().header.frame_id, "laser");
  EXPECT_EQ(scan.sample().header.stamp.nanosec, 8U);
  EXPECT_EQ(scan.sample().range_max, 8);
  EXPECT_EQ(bus::elements(scan.sample().ranges)[2], 3);
  EXPECT_EQ(encode_as(descriptor_of<LaserScan>(), scan.sample()), bytes.all());
}

TEST(Ros2Decode, Odometry) {
  Bytes bytes;
  bytes.header("odom").text("base_link");
  for (int i = 0; i < 7 + 36 + 6 + 36; ++i) bytes.put(static_cast<double>(i));
  DecodedAs<Odometry> odometry(descriptor_of<Odometry>());
  ASSERT_TRUE(odometry.decode(bytes.all()));
  EXPECT_STREQ(odometry.sample().child_frame_id, "base_link");
  EXPECT_EQ(odometry.sample().pose.pose.orientation.w, 6);
  EXPECT_EQ(odometry.sample().pose.covariance[35], 42);
  EXPECT_EQ(odometry.sample().twist.twist.angular.z, 48);
  EXPECT_EQ(encode_as(descriptor_of<Odometry>(), odometry.sample()), bytes.all());
}

TEST(Ros2Decode, BothFormsOfARangeAreRead) {
  for (const bool with_variance : {false, true}) {
    Bytes bytes;
    bytes.header("sonar").put(std::uint8_t{1});
    for (const float value : {0.3F, 0.02F, 4.F, 1.5F}) bytes.put(value);
    if (with_variance) bytes.put(0.01F);
    DecodedAs<RangeReading> range(descriptor_of<RangeReading>());
    ASSERT_TRUE(range.decode(bytes.all())) << with_variance;
    EXPECT_EQ(range.sample().range, 1.5F);
    DecodedAs<Range> strict(descriptor_of<Range>());
    EXPECT_EQ(strict.decode(bytes.all()), with_variance);
  }
}

TEST(Ros2Decode, LengthsThatTheBytesDoNotHaveAreRefusedBeforeMemoryIsTaken) {
  Bytes bytes;
  bytes.header("laser");
  for (int i = 0; i < 7; ++i) bytes.put(1.F);
  bytes.put(0xffffffffU);
  DecodedAs<LaserScan> scan(descriptor_of<LaserScan>());
  EXPECT_FALSE(scan.decode(bytes.all()));
}

TEST(Ros2Decode, NoStartOfAMessageIsTakenForAWhole) {
  Bytes bytes;
  bytes.put(1U).header("map").text("odom");
  for (int i = 0; i < 7; ++i) bytes.put(1.0);
  for (std::size_t size = 0; size < bytes.all().size(); ++size) {
    DecodedAs<TfMessage> tf(descriptor_of<TfMessage>());
    EXPECT_FALSE(tf.decode(std::span(bytes.all()).first(size))) << size;
  }
}

/// Whether a file of the fuzz target's corpus holds a message that passes; its first byte is for
/// the target.
template <class Message>
bool good(const std::string& name) {
  std::ifstream file(RAVE_SOURCE_DIR "/libs/ros2/tests/corpus_ros2/" + name, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (text.empty()) return false;
  DecodedAs<Message> message(descriptor_of<Message>());
  return message.decode(std::as_bytes(std::span(text)).subspan(1), (text[0] & '\x80') != 0) &&
         validate(message.sample());
}

TEST(Ros2Decode, TheCorpusGetsThrough) {
  EXPECT_TRUE(good<String>("string"));
  EXPECT_TRUE(good<PoseStamped>("pose"));
  EXPECT_TRUE(good<Twist>("twist"));
  EXPECT_TRUE(good<Twist>("twist_big_endian"));
  EXPECT_TRUE(good<TwistStamped>("twist_stamped"));
  EXPECT_TRUE(good<LaserScan>("scan"));
  EXPECT_TRUE(good<RangeReading>("range"));
  EXPECT_TRUE(good<Range>("range_2023"));
  EXPECT_TRUE(good<Imu>("imu"));
  EXPECT_TRUE(good<NavSatFix>("fix"));
  EXPECT_TRUE(good<BatteryState>("battery"));
  EXPECT_TRUE(good<Odometry>("odometry"));
  EXPECT_TRUE(good<TfMessage>("tf"));
  EXPECT_TRUE(good<Clock>("clock"));
}

}  // namespace
}  // namespace rave::ros2
