// SPDX-License-Identifier: Apache-2.0
#include "ros2/tf_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "rave/math/scalar.hpp"
#include "rave/ros2/convert.hpp"

namespace rave::ros2_driver {
namespace {

/// Transforms, whose texts live here.
class Transforms {
 public:
  explicit Transforms(TfTree& tree) : tree_(tree) {}
  Status put(std::string parent, std::string child, const Pose2& pose, std::int32_t sec,
             bool is_static = false) {
    ros2::TransformStamped one{};
    one.header.frame_id = parent.data();
    one.header.stamp.sec = sec;
    one.child_frame_id = child.data();
    one.transform.translation = {pose.x, pose.y, 0};
    one.transform.rotation = leaning ? ros2::Quaternion{std::sqrt(0.5), 0, 0, std::sqrt(0.5)}
                                     : ros2::quaternion_of(pose.yaw);
    return tree_.add(one, is_static);
  }
  bool leaning = false;

 private:
  TfTree& tree_;
};

TEST(Ros2TfTree, ComposesTheChain) {
  TfTree tree;
  Transforms tf(tree);
  ASSERT_TRUE(tf.put("map", "odom", {1, 2, kPi / 2}, 5));
  ASSERT_TRUE(tf.put("odom", "base_footprint", {3, 0, 0}, 7));
  ASSERT_TRUE(tf.put("/base_footprint", "/base_link", {0, 0.5, 0}, 9, true));
  const auto found = tree.find("map", "base_link");
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->X_AB.x, 0.5, 1e-12);
  EXPECT_NEAR(found->X_AB.y, 5, 1e-12);
  EXPECT_NEAR(found->X_AB.yaw, kPi / 2, 1e-12);
  EXPECT_EQ(found->stamp_ns, 5'000'000'000) << "the oldest; a static transform has no time";
  for (const char* const child : {"odom", "base_footprint", "base_link"}) {
    EXPECT_TRUE(tree.needs(child, "base_link")) << child;
  }
  EXPECT_FALSE(tree.needs("laser", "base_link"));
  EXPECT_FALSE(tree.needs("base_link", "odom"));
  ASSERT_TRUE(tf.put("odom", "base_footprint", {4, 0, 0}, 8));
  EXPECT_NEAR(tree.find("map", "base_link")->X_AB.y, 6, 1e-12) << "the newest counts";
}

TEST(Ros2TfTree, ALinkThatIsRepeatedDoesNotRefreshTheOthers) {
  TfTree tree;
  Transforms tf(tree);
  ASSERT_TRUE(tf.put("odom", "base_link", {3, 0, 0}, 4));
  for (std::int32_t sec = 4; sec < 20; ++sec) {
    ASSERT_TRUE(tf.put("map", "odom", {1, 2, 0}, sec));
    EXPECT_EQ(tree.find("map", "base_link")->stamp_ns, 4'000'000'000);
  }
  ASSERT_TRUE(tf.put("odom", "base_link", {3, 0, 0}, 21));
  EXPECT_EQ(tree.find("map", "base_link")->stamp_ns, 19'000'000'000);
}

TEST(Ros2TfTree, APoseWhoseAgeNobodyKnowsIsNone) {
  TfTree tree;
  Transforms tf(tree);
  ASSERT_TRUE(tf.put("map", "odom", {}, 5, true));
  ASSERT_TRUE(tf.put("odom", "base_link", {}, 0));
  EXPECT_EQ(tree.find("map", "base_link").error().message,
            "the transform from `odom` to `base_link` has no stamp, so its age is unknown");
  ASSERT_TRUE(tf.put("odom", "base_link", {}, 5, true));
  EXPECT_EQ(tree.find("map", "base_link").error().message,
            "all transforms from `map` to `base_link` are static: the pose of a robot changes");
}

TEST(Ros2TfTree, SaysWhereTheChainEnds) {
  TfTree tree;
  Transforms tf(tree);
  ASSERT_TRUE(tf.put("odom", "base_link", {}, 1));
  EXPECT_EQ(tree.find("map", "base_link").error().message,
            "no transform leads from `map` to `base_link`: `odom` has no parent");
  ASSERT_TRUE(tf.put("base_link", "odom", {}, 1));
  EXPECT_EQ(tree.find("map", "base_link").error().message,
            "the transforms above `base_link` form a cycle");
}

TEST(Ros2TfTree, WhatLeansMattersToItsUsersOnly) {
  TfTree tree;
  Transforms tf(tree);
  ASSERT_TRUE(tf.put("map", "base_link", {1, 0, 0}, 1));
  tf.leaning = true;
  ASSERT_TRUE(tf.put("base_link", "camera", {}, 1));
  EXPECT_TRUE(tree.find("map", "base_link"));
  EXPECT_EQ(tree.find("map", "camera").error().message,
            "camera is tilted by 90 degrees; robots in RAVE stay level");
}

TEST(Ros2TfTree, MadeUpFramesDoNotFillTheMemory) {
  TfTree tree;
  Transforms tf(tree);
  for (std::size_t i = 0; i < TfTree::kMostFrames; ++i) {
    ASSERT_TRUE(tf.put("map", "f" + std::to_string(i), {}, 1));
  }
  EXPECT_EQ(tf.put("map", "one more", {}, 1).error().message, "more than 4096 frames");
}

}  // namespace
}  // namespace rave::ros2_driver
