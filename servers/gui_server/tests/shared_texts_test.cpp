// SPDX-License-Identifier: Apache-2.0
#include "page/shared_texts.hpp"

#include <gtest/gtest.h>

#include "fake_run.hpp"

namespace rave::gui_server {
namespace {

/// A run whose bodies change when the test says so.
class ChangingRun final : public testing::FakeRun {
 public:
  [[nodiscard]] std::uint64_t bodies_revision() const noexcept override { return revision; }
  std::uint64_t revision = 1;
};

TEST(SharedTexts, PagesOfOneSourceGetTheSameBytes) {
  SharedTexts texts;
  const std::shared_ptr<Source> run = std::make_shared<testing::FakeRun>();
  const auto roster = texts.roster(run);
  const auto scene = texts.scene(run);
  const auto events = texts.events(run);
  EXPECT_EQ(texts.roster(run), roster);
  EXPECT_EQ(texts.scene(run), scene);
  EXPECT_EQ(texts.events(run), events);
  EXPECT_NE(roster->find(R"("type":"roster","robots":)"), std::string::npos);
  EXPECT_NE(roster->find("walker-1"), std::string::npos);
  EXPECT_NE(scene->find(R"("hidden":[],"bodies":[{"id":0,"name":"secret-pond")"),
            std::string::npos);
  EXPECT_NE(events->find("at home"), std::string::npos);
}

TEST(SharedTexts, AnotherSourceHasTextsOfItsOwn) {
  SharedTexts texts;
  std::shared_ptr<Source> first = std::make_shared<testing::FakeRun>();
  const std::shared_ptr<Source> second = std::make_shared<testing::FakeRun>();
  const auto roster = texts.roster(first);
  EXPECT_NE(texts.roster(second), roster);
  // The source is gone, and its text still on the way to somebody.
  first.reset();
  for (int i = 0; i < 100; ++i) {
    const std::shared_ptr<Source> other = std::make_shared<testing::FakeRun>();
    EXPECT_NE(texts.roster(other), roster);
  }
}

TEST(SharedTexts, WhatChangedIsMadeAnew) {
  SharedTexts texts;
  const auto changing = std::make_shared<ChangingRun>();
  const std::shared_ptr<Source> run = changing;
  const auto scene = texts.scene(run);
  const auto roster = texts.roster(run);
  ++changing->revision;
  EXPECT_NE(texts.scene(run), scene);
  EXPECT_EQ(texts.roster(run), roster);
}

TEST(SharedTexts, NothingIsKeptThatIsOnNobodysWay) {
  SharedTexts texts;
  const std::shared_ptr<Source> run = std::make_shared<testing::FakeRun>();
  const std::weak_ptr<const std::string> roster = texts.roster(run);
  EXPECT_TRUE(roster.expired());
}

}  // namespace
}  // namespace rave::gui_server
