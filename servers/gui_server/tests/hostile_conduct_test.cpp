// SPDX-License-Identifier: Apache-2.0
// Who starts and ends runs, and what others learn of it.
#include "hostile_fixture.hpp"
#include "rave/gui_server/conductor.hpp"

namespace rave::gui_server::testing {
namespace {

constexpr const char* kStart = R"({"type":"conduct","request":1,"do":"start","name":"secret"})";

/// Notes what it is asked.
class FakeConductor final : public Conductor {
 public:
  [[nodiscard]] std::uint64_t revision() const override { return 1; }
  [[nodiscard]] std::string text(bool whole) override {
    return whole ? R"({"type":"conduct","may":true,"run":null,"scenarios":["secret"]})"
                 : R"({"type":"conduct","may":false,"run":null})";
  }
  [[nodiscard]] Result<std::string> take(const ConductMessage& message) override {
    ++asked_;
    return message.name + " starts.";
  }
  [[nodiscard]] int asked() const { return asked_.load(); }

 private:
  std::atomic<int> asked_{0};
};

TEST_F(Hostile, RunsAreStartedByThoseWhoMay) {
  const auto conductor = std::make_shared<FakeConductor>();
  server_->conduct_by(conductor);
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  for (RawSocket* const client : {&eve, &ben}) {
    EXPECT_NE(client->text_with(R"("type":"conduct")"), "");
    client->send(kStart);
    const std::string answer = client->text_with(R"("to":"start")");
    EXPECT_NE(answer.find("Your rights do not include this."), std::string::npos) << answer;
    EXPECT_EQ(client->heard().find(R"("scenarios")"), std::string::npos);
  }
  EXPECT_EQ(conductor->asked(), 0);
  RawSocket boss = super_user();
  EXPECT_NE(boss.text_with(R"("scenarios":["secret"])"), "");
  boss.send(kStart);
  EXPECT_NE(boss.text_with(R"("to":"start")").find(R"("good":true)"), std::string::npos);
  EXPECT_EQ(conductor->asked(), 1);
  // The right can be given, and holds at once on an open page.
  set_right(boss, "commander", "conduct", "\"all\"");
  EXPECT_NE(ben.text_with(R"("scenarios":["secret"])"), "");
  ben.send(kStart);
  EXPECT_NE(ben.text_with(R"("good":true)").find("secret starts."), std::string::npos);
  EXPECT_NE(audit().find("secret"), std::string::npos);
}

TEST_F(Hostile, AServerThatStartsNoRunsSaysSo) {
  RawSocket boss = super_user();
  boss.send(kStart);
  const std::string answer = boss.text_with(R"("to":"start")");
  EXPECT_NE(answer.find("can neither start nor end runs"), std::string::npos) << answer;
}

}  // namespace
}  // namespace rave::gui_server::testing
