// SPDX-License-Identifier: Apache-2.0
// Names: an invited person chooses one, and gets nothing that is meant for somebody of that name.
#include "hostile_fixture.hpp"

namespace rave::gui_server::testing {
namespace {

constexpr const char* kGoal =
    R"({"type":"order","request":1,"kind":"goal","slots":[0],"points":[[0,0]]})";
constexpr const char* kPassword = "correct horse";

class HostileNames : public Hostile {
 protected:
  /// Begins anew with a run whose scenario gives a user everything.
  void mention(const std::string& user) {
    server_.reset();
    for (const InfoClass what :
         {InfoClass::kCommand, InfoClass::kRecording, InfoClass::kTruePose}) {
      run_->facts.rights.set_user(user, what, Reach{Reach::Kind::kAll, {}});
    }
    start();
  }
  /// The answer to who joins with a name, as a form writes it.
  [[nodiscard]] std::string join(const std::string& secret, const std::string& name) {
    return ask("POST", "/join", origin(), "invite=" + secret + "&name=" + name);
  }
  [[nodiscard]] static std::string order(RawSocket& client) {
    client.send(kGoal);
    return client.text_with("\"to\":\"goal\"");
  }
  static void give_right(RawSocket& boss, const char* user, const char* reach) {
    boss.send(fmt::format(R"({{"type":"set_right","user":"{}","class":"command","reach":{}}})",
                          user, reach));
    EXPECT_NE(boss.text_with("\"to\":\"set_right\"").find("\"good\":true"), std::string::npos);
  }
  static constexpr const char* kRefused = "Your rights do not include this.";
};

TEST_F(HostileNames, ThatRightsMentionCanBeChosenByNobody) {
  mention("ada");
  const std::string any = *accounts_->invite(Role::kObserver, {}, 20, 7, "test");
  // Also by capitals, signs, blanks, and letters that look alike.
  for (const char* const name : {"ada", "Ada", "ADA", "ada.", "a_da", "%61da", "ada%20", "+ada",
                                 "ad%C3%A0", "%D0%B0da", "ada%E2%80%8B", "ada%00"}) {
    const std::string answer = join(any, name);
    EXPECT_EQ(status_of(answer), "400") << name;
    EXPECT_EQ(cookie_of(answer), "") << name;
  }
  EXPECT_EQ(status_of(join(any, "adam")), "303");
  ASSERT_TRUE(accounts_->refresh());
  EXPECT_EQ(accounts_->state().accounts.size(), 1U);
}

TEST_F(HostileNames, OfWhoWasThereBeforeGainNothing) {
  // At a moment when no right mentions the name, and with a password to come back.
  EXPECT_NE(guest(Role::kCommander, "ada&password=ten+letters"), "");
  mention("ada");
  const std::string ada = ask("POST", "/login", origin(), "name=ada&password=ten+letters");
  ASSERT_NE(cookie_of(ada), "");
  EXPECT_EQ(status_of(ask("GET", "/recording", cookie_of(ada))), "403");
  RawSocket client = socket(cookie_of(ada));
  EXPECT_EQ(client.text_with("\"hello\"").find("true_pose\":[0,1,2,3]"), std::string::npos);
  client.send(R"({"type":"order","request":1,"kind":"goal","slots":[1],"points":[[0,0]]})");
  EXPECT_NE(client.text_with("\"to\":\"goal\"").find(kRefused), std::string::npos);
  EXPECT_TRUE(run_->commands().empty());
}

TEST_F(HostileNames, OfAnAccountAndOfAnInvitationForOneHaveTheirRights) {
  mention("ada");
  ASSERT_TRUE(accounts_->add({"ada", Role::kObserver, {}}, kPassword));
  RawSocket ada =
      socket(cookie_of(ask("POST", "/login", origin(), "name=ada&password=correct+horse")));
  EXPECT_NE(order(ada).find("\"good\":true"), std::string::npos);
  mention("ben");
  const std::string bens =
      *accounts_->invite(Role::kObserver, {false, {"green"}}, 1, 7, "test", "ben");
  const std::string form = ask("GET", "/join?invite=" + bens);
  EXPECT_NE(form.find("value=\"ben\""), std::string::npos) << form;
  EXPECT_NE(form.find("readonly"), std::string::npos) << form;
  EXPECT_EQ(status_of(join(bens, "cleo")), "400");
  RawSocket ben = socket(cookie_of(join(bens, "ben")));
  EXPECT_NE(order(ben).find("\"good\":true"), std::string::npos);
}

TEST_F(HostileNames, AreGivenWithARightAndKeptAfterwards) {
  RawSocket boss = super_user();
  RawSocket ben = socket(guest(Role::kObserver, "ben"));
  EXPECT_NE(order(ben).find(kRefused), std::string::npos);
  give_right(boss, "ben", "\"all\"");
  EXPECT_NE(ben.text_with(R"("may":)").find("command"), std::string::npos);
  EXPECT_NE(order(ben).find("\"good\":true"), std::string::npos);
  boss.send(R"({"type":"account","request":1,"do":"end_sessions","name":"ben"})");
  EXPECT_EQ(ben.close_code(), 4401);
  const std::string any = *accounts_->invite(Role::kObserver, {}, 3, 7, "test");
  EXPECT_EQ(status_of(join(any, "ben")), "400");
  // A name that nobody has is kept from the moment on in which a right mentions it.
  give_right(boss, "cleo", "\"own\"");
  EXPECT_EQ(status_of(join(any, "Cleo")), "400");
  give_right(boss, "cleo", "null");
  EXPECT_EQ(status_of(join(any, "cleo")), "303");
}

TEST_F(HostileNames, TakenAgainDoNotShowWhatWasSaidToWhoHadThem) {
  RawSocket boss = super_user();
  RawSocket first = socket(guest(Role::kObserver, "eve"));
  EXPECT_NE(first.text_with("\"hello\""), "");
  boss.send(R"({"type":"say","request":1,"to":"user","name":"eve","text":"the code is 4711"})");
  EXPECT_NE(first.text_with("the code is 4711"), "");
  boss.send(R"({"type":"account","request":2,"do":"end_sessions","name":"eve"})");
  EXPECT_EQ(first.close_code(), 4401);
  RawSocket second = socket(guest(Role::kObserver, "eve"));
  EXPECT_NE(second.text_with(R"("type":"chat")"), "");
  boss.send(R"({"type":"say","request":3,"to":"user","name":"eve","text":"good morning"})");
  EXPECT_NE(second.text_with("good morning"), "");
  EXPECT_EQ(second.heard().find("4711"), std::string::npos);
}

}  // namespace
}  // namespace rave::gui_server::testing
