// SPDX-License-Identifier: Apache-2.0
// Orders, chat and components of a client that may not have them.
#include <unistd.h>

#include <map>
#include <set>
#include <string>

#include "hostile_fixture.hpp"
#include "rave/direct_line/ticket.hpp"

namespace rave::gui_server::testing {
namespace {

TEST_F(Hostile, OrdersOfAnObserverAreRefusedAndLogged) {
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  for (const char* const request :
       {R"({"type":"order","request":1,"kind":"drive","slots":[0],"v":1,"w":0})",
        R"({"type":"order","request":2,"kind":"goal","slots":[0,1],"points":[[0,0]]})",
        R"({"type":"order","request":3,"kind":"cancel","slots":[0]})",
        R"({"type":"order","request":4,"kind":"text","slots":[0],"text":"run"})",
        R"({"type":"order","request":5,"kind":"place","slots":[0],"points":[[0,0]]})",
        R"({"type":"lease","request":6,"do":"force","slots":[0]})",
        R"({"type":"set","request":7,"slots":[0],"key":"program.v","value":9})",
        R"({"type":"edit","request":8,"do":"remove","name":"secret-pond"})",
        R"({"type":"edit","request":9,"do":"add","name":"a","pose":[0,0,0],"disc":1})",
        R"({"type":"twin","request":12,"do":"hand_over","slots":[0],"to":"real"})",
        R"({"type":"twin","request":13,"do":"reset_shadow","slots":[0]})",
        R"({"type":"order","request":10,"kind":"cancel","slots":[3]})",
        R"({"type":"order","request":11,"kind":"cancel","slots":[4294967295]})"}) {
    eve.send(request);
    const std::string answer = eve.text_with("\"type\":\"answer\"");
    EXPECT_NE(answer.find("\"good\":false"), std::string::npos) << request;
    EXPECT_NE(answer.find("Your rights do not include this."), std::string::npos) << answer;
  }
  EXPECT_TRUE(run_->commands().empty());
  EXPECT_TRUE(audited(R"("what":"refused","why":"order","user":"eve")")) << audit();
  // Who drives is shown with the robot; whoever is not seen, and what they are called, is not.
  EXPECT_EQ(eve.heard().find("spy"), std::string::npos);
}

TEST_F(Hostile, ACommanderCommandsTheirOwnTeamAlone) {
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  // Slots are those of the run here, since commanders see all; 1 and 3 are of the other team.
  ben.send(
      R"({"type":"order","request":1,"kind":"goal","slots":[0,1,3],"points":[[1,2],[3,4],[5,6]]})");
  const std::string answer = ben.text_with("\"to\":\"goal\"");
  EXPECT_NE(answer.find(R"("refused":[{"slot":1,)"), std::string::npos) << answer;
  auto asked = run_->commands();
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked[0].first.slots, (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(asked[0].first.action, request::Action(request::Goal{{1, 2}, {}}));
  EXPECT_EQ(asked[0].second.name, "ben");
  EXPECT_FALSE(asked[0].second.overrides);
  EXPECT_NE(asked[0].second.page, 0U);
  for (const char* const request :
       {R"({"type":"order","request":2,"kind":"place","slots":[0],"points":[[0,0]]})",
        R"({"type":"edit","request":3,"do":"add","name":"a","pose":[0,0,0],"disc":1})",
        R"({"type":"lease","request":4,"do":"take","slots":[1]})"}) {
    ben.send(request);
    EXPECT_NE(ben.text_with("\"type\":\"answer\"").find("Your rights"), std::string::npos);
  }
  EXPECT_EQ(run_->commands().size(), 1U);
  EXPECT_TRUE(audited("goal, 3 robots: Your rights do not include this."));
  RawSocket boss = super_user();
  boss.send(R"({"type":"edit","request":1,"do":"add","name":"a","pose":[0,0,0],"disc":1})");
  EXPECT_NE(boss.text_with("\"to\":\"edit\"").find("\"good\":true"), std::string::npos);
  EXPECT_TRUE(run_->commands().back().second.overrides);
}

TEST_F(Hostile, HowHandOversAndShadowsStandIsToldToWhoMayKnowIt) {
  const std::string gap = "0.3125";
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  EXPECT_NE(eve.text_with("\"leases\"").find(gap), std::string::npos) << "readings of her team";
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  const std::string leases = ben.text_with("\"leases\"");
  EXPECT_NE(leases.find(FakeRun::kTwinText), std::string::npos) << leases;
  EXPECT_NE(leases.find(gap), std::string::npos) << leases;
  for (const RawSocket* const client : {&eve, &ben}) {
    EXPECT_EQ(client->heard().find("4711.5"), std::string::npos) << "the shadow of another team";
  }
  EXPECT_EQ(eve.heard().find(FakeRun::kTwinText), std::string::npos);
  RawSocket boss = super_user();
  EXPECT_NE(boss.text_with("\"leases\"").find("4711.5"), std::string::npos);
}

TEST_F(Hostile, MalformedOrdersNeverReachARun) {
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  std::string path = R"({"type":"order","request":1,"kind":"path","slots":[0],"points":[)";
  for (int i = 0; i < 10'000; ++i) path += i == 0 ? "[0,1]" : ",[0,1]";
  for (const std::string& request :
       {std::string(R"({"type":"order","request":1,"kind":"drive","slots":[0],"v":NaN,"w":0})"),
        std::string(R"({"type":"order","request":1,"kind":"drive","slots":[0],"v":1e999,"w":0})"),
        std::string(
            R"({"type":"order","request":1,"kind":"goal","slots":[0],"points":[[null,0]]})"),
        std::string(R"({"type":"order","request":-1,"kind":"cancel","slots":[0]})"),
        std::string(
            R"({"type":"order","request":1,"kind":"drive","slots":[0],"v":1,"w":0,"by":"ada"})"),
        std::string(R"({"type":"page","key":"BAAA"})"),
        std::string(R"({"type":"page","key":7})")}) {
    ben.send(request);
    EXPECT_NE(ben.text_with("\"to\":\"message\"").find("\"good\":false"), std::string::npos)
        << request.substr(0, 80);
  }
  ben.send(path + "]}");
  EXPECT_NE(ben.text_with("\"to\":\"message\"").find("a path has 10000 points; expected 2 to 1000"),
            std::string::npos);
  EXPECT_TRUE(run_->commands().empty());
  EXPECT_TRUE(
      audited(R"("what":"refused","why":"message","user":"ben","detail":"expected a JSON object")"))
      << audit();
  EXPECT_TRUE(audited("a path has 10000 points")) << audit();
  EXPECT_EQ(audit().find("cut_off"), std::string::npos) << audit();
}

TEST_F(Hostile, WhoSendsNonsenseIsCutOffByNameInTheLog) {
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  for (int i = 0; i < 30; ++i) eve.send(R"({"type":"hack"})");
  EXPECT_EQ(eve.close_code(), 4400);
  EXPECT_TRUE(audited(R"("what":"cut_off","why":"malformed messages","user":"eve")")) << audit();
}

TEST_F(Hostile, TwoPagesOfOnePersonAreTwoForTheRun) {
  const std::string ben = guest(Role::kCommander, "ben");
  RawSocket first = socket(ben);
  RawSocket second = socket(ben);
  const auto order = [](RawSocket& page) {
    page.send(R"({"type":"order","request":1,"kind":"cancel","slots":[0]})");
    EXPECT_NE(page.text_with("\"to\":\"cancel\"").find("\"good\":true"), std::string::npos);
  };
  order(first);
  order(second);
  order(first);
  // The key of its tickets is another name of the page; of two with one key one has copied it.
  std::string point(65, '\0');
  point[0] = 4;
  const std::string key(86, 'A');
  second.send(R"({"type":"page","key":"B)" + key + R"("})");
  order(second);
  const auto asked = run_->commands();
  ASSERT_EQ(asked.size(), 5U);
  EXPECT_NE(asked[0].second.page, 0U);
  EXPECT_NE(asked[0].second.page, asked[1].second.page);
  EXPECT_EQ(asked[0].second.page, asked[2].second.page);
  // What it had by its old name it leaves, to have it by the new one.
  EXPECT_TRUE(asked[3].first.is<request::Give>());
  EXPECT_EQ(asked[3].second.page, asked[1].second.page);
  EXPECT_EQ(asked[4].second.page, direct_line::page_number(point));
  EXPECT_NE(asked[4].second.page, asked[1].second.page);
}

TEST_F(Hostile, WhatAPageLeavesIsAnyPagesOfTheSamePerson) {
  {
    RawSocket ben = socket(guest(Role::kCommander, "ben"));
    ben.send(R"({"type":"order","request":1,"kind":"cancel","slots":[0]})");
    EXPECT_NE(ben.text_with("\"to\":\"cancel\""), "");
    run_->lease_page = run_->commands()[0].second.page;
  }
  const auto asked = commands(2);
  ASSERT_EQ(asked.size(), 2U);
  EXPECT_EQ(asked[1].first.action, request::Action(request::Give{"ben"}));
  EXPECT_EQ(asked[1].first.slots, (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(asked[1].second.page, asked[0].second.page);
}

TEST_F(Hostile, ALeaseIsGivenOnlyToAPersonWhoIsHereAndMayCommand) {
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  const auto give = [&ben](const char* to) {
    ben.send(
        fmt::format(R"({{"type":"lease","request":1,"do":"give","slots":[0],"to":"{}"}})", to));
    return ben.text_with("\"to\":\"give\"");
  };
  EXPECT_NE(
      give("zoe").find("`zoe` is not here; no other person who may command this robot is here"),
      std::string::npos);
  RawSocket ada = socket(guest(Role::kCommander, "ada"));
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  EXPECT_NE(ada.text_with("\"hello\""), "");
  EXPECT_NE(eve.text_with("\"hello\""), "");
  EXPECT_NE(give("zoe").find("`zoe` is not here; this robot can be given to ada"),
            std::string::npos);
  EXPECT_NE(give("eve").find("`eve` may not command this robot; this robot can be given to ada"),
            std::string::npos);
  EXPECT_TRUE(run_->commands().empty());
  EXPECT_TRUE(audited("give, 1 robots: `zoe` is not here")) << audit();
  EXPECT_NE(give("ada").find("\"good\":true"), std::string::npos);
}

TEST_F(Hostile, APageThatGoesRightAfterItsFirstOrderLeavesItAsWell) {
  {
    RawSocket ben = socket(guest(Role::kCommander, "ben"));
    ben.send(R"({"type":"order","request":1,"kind":"goal","slots":[0],"points":[[0,0]]})");
    EXPECT_NE(ben.text_with("\"to\":\"goal\""), "");
    // The run tells of the lease of another page meanwhile.
  }
  const auto asked = commands(2);
  ASSERT_EQ(asked.size(), 2U);
  EXPECT_TRUE(asked[1].first.is<request::Give>());
  EXPECT_EQ(asked[1].first.slots, (std::vector<std::uint32_t>{0}));
}

TEST_F(Hostile, AFloodOfOrdersIsRefusedAndThenCutOff) {
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  for (int i = 0; i < 2000; ++i) {
    ben.send(R"({"type":"order","request":1,"kind":"goal","slots":[0,2],"points":[[0,0]]})");
  }
  EXPECT_EQ(ben.close_code(), 4429);
  EXPECT_TRUE(audited(R"("what":"cut_off","why":"too many messages","user":"ben")")) << audit();
}

TEST_F(Hostile, APageThatGoesLeavesNoRobotDriving) {
  {
    RawSocket ben = socket(guest(Role::kCommander, "ben"));
    ben.send(R"({"type":"order","request":1,"kind":"drive","slots":[0],"v":0.5,"w":0})");
    EXPECT_NE(ben.text_with("\"to\":\"drive\"").find("\"good\":true"), std::string::npos);
  }
  const auto asked = commands(2);
  ASSERT_GE(asked.size(), 2U);
  EXPECT_TRUE(asked[1].first.stands());
}

TEST_F(Hostile, WhatIsSaidReachesWhoMayHearItAlone) {
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  RawSocket ada = socket(guest(Role::kCommander, "ada"));
  ben.send(R"({"type":"say","request":1,"to":"all","text":"good morning"})");
  EXPECT_NE(eve.text_with("good morning").find(R"("name":"ben","role":"commander")"),
            std::string::npos);
  ben.send(R"({"type":"say","request":2,"to":"user","name":"ada","text":"for ada alone"})");
  ben.send(R"({"type":"say","request":3,"to":"role","name":"commander","text":"for commanders"})");
  ben.send(R"({"type":"say","request":4,"to":"robot","slot":0,"text":"to walker-1"})");
  EXPECT_NE(ada.text_with("for commanders"), "");
  EXPECT_NE(ada.heard().find("for ada alone"), std::string::npos);
  EXPECT_NE(eve.text_with("to walker-1"), "");
  EXPECT_EQ(eve.heard().find("for "), std::string::npos);
  // The robot was told, in the name of who said it.
  const auto asked = run_->commands();
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked[0].first.action, request::Action(request::Text{"to walker-1"}));
  EXPECT_EQ(asked[0].second.name, "ben");
  // Who does not command it speaks to people alone; who is not there is told so.
  eve.send(R"({"type":"say","request":1,"to":"robot","slot":0,"text":"and me"})");
  EXPECT_NE(ben.text_with("and me"), "");
  EXPECT_EQ(run_->commands().size(), 1U);
  eve.send(R"({"type":"say","request":2,"to":"user","name":"nobody","text":"psst"})");
  EXPECT_NE(eve.text_with("\"request\":2").find("is not connected"), std::string::npos);
}

TEST_F(Hostile, WhatIsSaidToATeamIsForItsMembersAndRobotsAlone) {
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  RawSocket boss = super_user();
  // Both guests are of team green.
  boss.send(R"({"type":"say","request":1,"to":"team","name":"blue","text":"spies, go home"})");
  EXPECT_NE(boss.text_with("Sent to 2 robots."), "");
  ben.send(R"({"type":"say","request":2,"to":"team","name":"green","text":"walkers, gather"})");
  EXPECT_NE(ben.text_with("Sent to 2 robots."), "");
  EXPECT_NE(eve.text_with("walkers, gather"), "");
  EXPECT_NE(ben.text_with("walkers, gather"), "");
  for (const RawSocket* const client : {&eve, &ben}) {
    EXPECT_EQ(client->heard().find("spies, go home"), std::string::npos);
  }
  // Robots by what they were told.
  const auto told = [this] {
    std::map<std::string, std::set<std::uint32_t>> robots;
    for (const auto& [command, author] : run_->commands()) {
      // A page that went before leaves its leases.
      const auto* const text = command.as<request::Text>();
      if (text == nullptr) continue;
      robots[text->text].insert(command.slots.begin(), command.slots.end());
    }
    return robots;
  };
  const std::map<std::string, std::set<std::uint32_t>> both = {{"spies, go home", {1, 3}},
                                                               {"walkers, gather", {0, 2}}};
  EXPECT_EQ(told(), both);
  // Who may not talk about a team does not reach it either.
  ben.send(R"({"type":"say","request":3,"to":"team","name":"blue","text":"join us"})");
  EXPECT_NE(ben.text_with("\"request\":3").find("There is no such robot or team."),
            std::string::npos);
  EXPECT_EQ(told(), both);
}

TEST_F(Hostile, AReplayShowsTheChatOfTheRecordToWhoMayReadItAlone) {
  auto replay = std::make_shared<FakeRun>();
  replay->facts.live = false;
  replay->recorded = {{1, 0.5, "ada", "commander", "all", "", "said to all"},
                      {2, 1.5, "ada", "commander", "user", "ben", "for ben alone"},
                      {3, 2.5, "ada", "commander", "role", "commander", "for commanders"},
                      {4, 3.5, "ada", "commander", "robot", "spy-2", "for a spy"},
                      {5, 4.5, "ada", "boss", "all", "", "of an unknown role"}};
  const std::string cookie = guest(Role::kCommander, "ben", true);
  RawSocket ben = socket(cookie);
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  // A name that an invited person chose is not that of who was meant.
  replay->recorded.push_back({6, 5.5, "ada", "commander", "user", "eve", "for eve alone"});
  server_->show(replay);
  const std::string bens = ben.text_with("said to all");
  EXPECT_NE(bens.find(R"("t":1.5,"from":{"name":"ada","role":"commander"})"), std::string::npos)
      << bens;
  EXPECT_NE(bens.find("for ben alone"), std::string::npos);
  EXPECT_NE(bens.find("for commanders"), std::string::npos);
  EXPECT_EQ(bens.find("unknown role"), std::string::npos);
  const std::string eves = eve.text_with("said to all");
  EXPECT_EQ(eves.find("for "), std::string::npos) << eves;
  // Who comes later gets the same.
  RawSocket late = socket(cookie);
  EXPECT_NE(late.text_with("said to all").find("for ben alone"), std::string::npos);
}

TEST_F(Hostile, WhatIsSaidGoesIntoTheRecordOnce) {
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  ben.send(R"({"type":"say","request":1,"to":"robot","slot":0,"text":"well done"})");
  EXPECT_NE(ben.text_with("\"request\":1").find("\"good\":true"), std::string::npos);
  const auto kept = run_->kept();
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].from, "ben");
  EXPECT_EQ(kept[0].role, "commander");
  EXPECT_EQ(kept[0].to, "robot");
  EXPECT_EQ(kept[0].name, "walker-1");
  EXPECT_EQ(kept[0].text, "well done");
  // The replay of the same run begins on the same page.
  auto replay = std::make_shared<FakeRun>();
  replay->facts.live = false;
  replay->recorded = kept;
  server_->show(replay);
  const std::string shown = ben.text_with("\"type\":\"chat\",\"reset\":true");
  EXPECT_NE(shown.find("well done"), std::string::npos) << shown;
  EXPECT_EQ(shown.find("well done"), shown.rfind("well done")) << shown;
}

TEST_F(Hostile, ComponentsAreServedToTheirRolesAlone) {
  const std::string eve = guest(Role::kObserver, "eve");
  const std::string ben = guest(Role::kCommander, "ben");
  std::ofstream(folder_ / "heat map.js") << "export const component = 1;\n";
  auto run = std::make_shared<FakeRun>();
  run->facts.components.push_back({"heat_map", folder_ / "heat map.js", {Role::kCommander}});
  server_->show(run);
  RawSocket commander = socket(ben);
  EXPECT_NE(commander.text_with("\"hello\"").find("components/0/heat_map.js"), std::string::npos);
  RawSocket observer = socket(eve);
  EXPECT_EQ(observer.text_with("\"hello\"").find("heat_map"), std::string::npos);
  const std::string path = "/components/0/heat_map.js";
  const std::string served = ask("GET", path, ben);
  EXPECT_EQ(status_of(served), "200");
  EXPECT_NE(served.find("text/javascript"), std::string::npos);
  EXPECT_NE(served.find("export const component"), std::string::npos);
  EXPECT_EQ(status_of(ask("GET", path, eve)), "404");
  EXPECT_EQ(status_of(ask("GET", path)), "401");
  EXPECT_EQ(status_of(ask("GET", "/components/1/heat_map.js", ben)), "404");
  EXPECT_EQ(status_of(ask("GET", "/components/0/../accounts/accounts", ben)), "400");
}

TEST_F(Hostile, APageThatComesHasThePanelsThatTheFileListsNow) {
  const std::string eve = guest(Role::kObserver, "eve");
  const std::string ben = guest(Role::kCommander, "ben");
  std::ofstream(folder_ / "late.js") << "export const component = 1;\n";
  EXPECT_EQ(socket(ben).text_with("\"hello\"").find("late"), std::string::npos);
  run_->change_components({{"late", folder_ / "late.js", {Role::kCommander}}}, "");
  EXPECT_NE(socket(ben).text_with("\"hello\"").find("components/0/late.js"), std::string::npos);
  EXPECT_EQ(status_of(ask("GET", "/components/0/late.js", ben)), "200");
  EXPECT_EQ(socket(eve).text_with("\"hello\"").find("late"), std::string::npos);
  EXPECT_EQ(status_of(ask("GET", "/components/0/late.js", eve)), "404");
  // A wrong file leaves the panels that are there, and the log says why.
  run_->change_components({}, "gui.yaml:3:5: unknown key");
  EXPECT_NE(socket(ben).text_with("\"hello\"").find("components/0/late.js"), std::string::npos);
  EXPECT_TRUE(audited(R"("what":"components","why":"gui.yaml:3:5: unknown key")")) << audit();
}

}  // namespace
}  // namespace rave::gui_server::testing
