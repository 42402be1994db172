// SPDX-License-Identifier: Apache-2.0
#include "rave/base/result.hpp"

#include <gtest/gtest.h>

#include <any>
#include <memory>
#include <string>
#include <vector>

namespace rave {
namespace {

struct Shape {
  virtual ~Shape() = default;
};
struct Disc final : Shape {};

/// What cannot be made from nothing.
struct Port {
  explicit Port(int of) : number(of) {}
  int number;
};

Result<std::unique_ptr<Disc>> make_disc() { return std::make_unique<Disc>(); }
Result<std::unique_ptr<Shape>> make_shape() { return make_disc(); }
Result<Port> port_of(int number) {
  if (number < 0) return fail(ErrorCode::kInvalidArgument, "port {} is negative", number);
  return Port(number);
}
Status opened(int number) {
  RAVE_TRY_ASSIGN(const Port port, port_of(number));
  if (port.number > 9) return fail(ErrorCode::kIo, "port {} does not exist", port.number);
  return {};
}

TEST(Result, HasTheValueOrTheError) {
  EXPECT_EQ(port_of(3)->number, 3);
  EXPECT_EQ(port_of(-1).error().message, "port -1 is negative");
  EXPECT_TRUE(make_shape()) << "a pointer to a derived class is one to its base";
  const Result<std::vector<int>> nothing = {};
  EXPECT_TRUE(nothing && nothing->empty());
}

TEST(Result, AnErrorLeavesTheFunction) {
  EXPECT_TRUE(opened(3));
  EXPECT_EQ(opened(-1).error().message, "port -1 is negative");
  EXPECT_EQ(opened(10).error().code, ErrorCode::kIo);
}

// A result can be tested like a bool, and any value fits into a std::any: a copy that took the
// result for its value would hide the error.
template <class T>
void expect_copies_keep_the_error(T value) {
  Result<T> failed = fail(ErrorCode::kIo, "no");
  Result<T> direct(failed);
  EXPECT_FALSE(direct);
  Result<T> assigned = std::move(value);
  EXPECT_TRUE(assigned);
  assigned = failed;
  EXPECT_FALSE(assigned);
  const Result<T> moved(std::move(failed));
  EXPECT_FALSE(moved);
}

TEST(Result, ACopyIsNoValue) {
  expect_copies_keep_the_error(true);
  expect_copies_keep_the_error(std::any(1));
  expect_copies_keep_the_error(std::string("yes"));
  Result<bool> no = false;
  const Result<bool> copy(no);
  no = true;
  ASSERT_TRUE(copy);
  EXPECT_FALSE(*copy);
}

TEST(Result, AStatusIsSetAnew) {
  Status status = opened(-1);
  status = opened(3);
  EXPECT_TRUE(status);
  status = fail(ErrorCode::kState, "closed");
  EXPECT_FALSE(status);
  status = {};
  EXPECT_TRUE(status);
}

TEST(ErrorCode, HasANameForEachCode) {
  for (int i = 0; i <= static_cast<int>(ErrorCode::kState); ++i) {
    EXPECT_NE(to_string(static_cast<ErrorCode>(i)), "unknown") << i;
  }
}

}  // namespace
}  // namespace rave
