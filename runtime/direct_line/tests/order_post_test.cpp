// SPDX-License-Identifier: Apache-2.0
#include "order_post.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace rave::direct_line {
namespace {

/// A run that does nothing until it is told to serve.
class OrderPostTest : public ::testing::Test {
 public:
  OrderPostTest() { control_.begin({}); }
  ~OrderPostTest() override { control_.end(); }

 protected:
  void drive(int id, double v_mps, bool echo) {
    request::Request request;
    request.action = request::Drive{v_mps, 0};
    request.robot = "anna";
    post_.drive(1, std::move(request), echo, [this, id](bool good, const std::string& text) {
      answers_[id] = {good, text};
    });
  }
  void serve() {
    control_.serve(
        [this](const request::Request& request) -> Result<std::string> {
          driven_mps_.push_back(request.as<request::Drive>()->v_mps);
          return "drives";
        },
        [](runtime::RunStatus&) {});
  }

  runtime::RunControl control_;
  OrderPost post_{control_};
  std::map<int, std::pair<bool, std::string>> answers_;
  std::vector<double> driven_mps_;
};

TEST_F(OrderPostTest, AReplacedDriveIsAnsweredIfThatWasAskedFor) {
  drive(1, 0.1, false);
  drive(2, 0.2, true);
  drive(3, 0.3, false);
  drive(4, 0.4, true);
  EXPECT_EQ(answers_.size(), 1U);
  EXPECT_EQ(answers_[2], std::pair(true, std::string("replaced by a newer drive")));
  serve();
  post_.poll();
  serve();
  post_.poll();
  EXPECT_EQ(driven_mps_, (std::vector{0.1, 0.4}));
  EXPECT_EQ(answers_[4], std::pair(true, std::string("drives")));
  EXPECT_EQ(answers_.size(), 2U) << "nobody asked for the others";
}

TEST_F(OrderPostTest, ADriveThatComesAfterTheAnswerIsGivenOnce) {
  drive(1, 0.1, true);
  drive(2, 0.2, true);
  // The run has done the first, and nobody has looked yet.
  serve();
  drive(3, 0.3, true);
  EXPECT_EQ(answers_[1], std::pair(true, std::string("drives")));
  EXPECT_EQ(answers_[2], std::pair(true, std::string("replaced by a newer drive")));
  serve();
  post_.poll();
  EXPECT_EQ(answers_[3], std::pair(true, std::string("drives")));
  EXPECT_EQ(driven_mps_, (std::vector{0.1, 0.3}));
}

}  // namespace
}  // namespace rave::direct_line
