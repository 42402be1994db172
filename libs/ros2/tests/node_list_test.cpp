// SPDX-License-Identifier: Apache-2.0
// What others are told of nodes and types, read by a participant of plain DDS.
#include "rave/ros2/node_list.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "../src/make_end.hpp"
#include "idl/ros2/rmw_dds_common.h"
#include "rave/bus/sequence.hpp"
#include "rave/ros2/reader.hpp"
#include "rave/ros2/type_hash.hpp"
#include "rave/ros2/waiter.hpp"
#include "rave/ros2/writer.hpp"

namespace rave::ros2 {
namespace {

struct Iron {
  using Info = rmw_dds_common_msg_dds__ParticipantEntitiesInfo_;
  static constexpr NodeForm kForm = NodeForm::kIron;
  static dds_topic_descriptor_t type() {
    return rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc;
  }
};

struct Humble {
  using Info = rmw_dds_common_msg_dds__ParticipantEntitiesInfoBefore2023_;
  static constexpr NodeForm kForm = NodeForm::kHumble;
  static dds_topic_descriptor_t type() {
    dds_topic_descriptor_t type = rmw_dds_common_msg_dds__ParticipantEntitiesInfoBefore2023__desc;
    type.m_typename = Iron::type().m_typename;
    return type;
  }
};

std::unique_ptr<Participant> participant(NodeForm nodes) {
  Network network;
  network.domain = 91 + static_cast<std::uint32_t>(::getpid()) % 90;
  network.nodes = nodes;
  network.node = "wheels";
  network.node_namespace = "/cart";
  auto opened = Participant::open(network);
  EXPECT_TRUE(opened) << opened.error().message;
  return opened ? *std::move(opened) : nullptr;
}

using Guids = std::set<std::vector<std::uint8_t>>;

std::vector<std::uint8_t> guid_of(dds_entity_t entity, std::size_t size) {
  dds_guid_t guid{};
  EXPECT_EQ(dds_get_guid(entity, &guid), DDS_RETCODE_OK);
  std::vector<std::uint8_t> bytes(std::begin(guid.v), std::end(guid.v));
  bytes.resize(size);
  return bytes;
}

Guids guids_in(const auto& sequence) {
  Guids found;
  for (const auto& gid : bus::elements(sequence)) {
    found.emplace(std::begin(gid.data), std::end(gid.data));
  }
  return found;
}

template <class Form>
class Ros2Nodes : public ::testing::Test {
 protected:
  using Info = typename Form::Info;

  void SetUp() override {
    listener_ = participant(NodeForm::kNone);
    auto made = make_end(listener_->handle(), Form::type(), "ros_discovery_info",
                         {.durable = true, .depth = 100}, true);
    ASSERT_TRUE(made) << made.error().message;
    reader_ = *made;
    auto waiter = Waiter::create(*listener_);
    ASSERT_TRUE(waiter && waiter->watch(reader_));
    waiter_.emplace(std::move(*waiter));
  }

  /// Looks at what comes until something is as wanted.
  template <class Wanted>
  void await(Wanted&& wanted) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    bool found = false;
    while (!found && std::chrono::steady_clock::now() < end) {
      bus::Loan loan;
      bus::take(reader_, loan);
      for (std::size_t i = 0; i < loan.size; ++i) {
        if (!loan.infos[i].valid_data) continue;
        found = wanted(*static_cast<const Info*>(loan.samples[i])) || found;
      }
      bus::give_back(reader_, loan);
      if (!found) waiter_->wait(Duration{20'000'000});
    }
    EXPECT_TRUE(found);
  }

  std::unique_ptr<Participant> listener_;
  dds_entity_t reader_ = 0;
  std::optional<Waiter> waiter_;
};

using Forms = ::testing::Types<Iron, Humble>;
TYPED_TEST_SUITE(Ros2Nodes, Forms);

TYPED_TEST(Ros2Nodes, AreToldWithTheirEndsAlsoToWhoComesLate) {
  const auto robot = participant(TypeParam::kForm);
  auto reader = Reader<Twist>::create(*robot, "/cart/cmd_vel", kReadNewest);
  ASSERT_TRUE(reader);
  constexpr std::size_t kSize = sizeof(TypeParam::Info::gid.data);
  const std::vector<std::uint8_t> self = guid_of(robot->handle(), kSize);
  {
    auto first = Writer<Odometry>::create(*robot, "/cart/odom");
    auto second = Writer<String>::create(*robot, "/cart/robot_description", kWriteKept);
    ASSERT_TRUE(first && second);
    robot->announce();
    this->await([&](const typename TypeParam::Info& info) {
      EXPECT_TRUE(std::ranges::equal(info.gid.data, self));
      const auto nodes = bus::elements(info.node_entities_info_seq);
      EXPECT_EQ(nodes.size(), 1U);
      EXPECT_STREQ(nodes[0].node_namespace, "/cart");
      EXPECT_STREQ(nodes[0].node_name, "wheels");
      EXPECT_EQ(guids_in(nodes[0].reader_gid_seq), (Guids{guid_of(reader->handle(), kSize)}));
      EXPECT_EQ(guids_in(nodes[0].writer_gid_seq).size(), 2U);
      return true;
    });
  }
  robot->announce();
  this->await([](const typename TypeParam::Info& info) {
    return bus::elements(info.node_entities_info_seq)[0].writer_gid_seq._length == 0;
  });
}

/// All that somebody says of itself beside its data, as text.
std::string user_data(const dds_qos_t* qos) {
  void* value = nullptr;
  std::size_t size = 0;
  if (!dds_qget_userdata(qos, &value, &size)) return "";
  std::string text(static_cast<const char*>(value), size);
  dds_free(value);
  return text;
}

TEST(Ros2TypeHash, IsWhatAnEndSaysOfItsType) {
  const auto us = participant(NodeForm::kNone);
  auto writer = make_end(us->handle(), descriptor_of<Clock>(), "rt/clock", kWrite, false);
  ASSERT_TRUE(writer);
  const bus::Qos qos(dds_create_qos());
  ASSERT_EQ(dds_get_qos(*writer, qos.get()), DDS_RETCODE_OK);
  // As the interfaces of ROS 2 Jazzy have it.
  EXPECT_EQ(user_data(qos.get()),
            "typehash=RIHS01_692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564;");
  ASSERT_EQ(dds_get_qos(us->handle(), qos.get()), DDS_RETCODE_OK);
  EXPECT_EQ(user_data(qos.get()), "enclave=/;");
  EXPECT_EQ(type_hash_of("nobody::msg::dds_::Knows_"), "");
  for (const auto& type : {descriptor_of<NavSatFix>(), descriptor_of<RangeReading>()}) {
    EXPECT_EQ(type_hash_of(type.m_typename).size(), 71U) << type.m_typename;
  }
}

}  // namespace
}  // namespace rave::ros2
