// SPDX-License-Identifier: Apache-2.0
// The table of rights as one test: each class that concerns robots, for the own team and another,
// by role and by user. What each may is sent or done, and all else is neither, over real sockets.
#include <array>
#include <bitset>
#include <cmath>
#include <cstring>
#include <map>

#include "hostile_fixture.hpp"

namespace rave::gui_server::testing {
namespace {

constexpr std::size_t kTeams = 2;

/// Robots 0 and 2 are of team green, 1 and 3 of team blue. All that is tried here belongs to team
/// green, so blue is the other one.
struct Line {
  InfoClass what;
  std::array<bool, kTeams> observer;
  std::array<bool, kTeams> commander;
  std::array<bool, kTeams> ada;  ///< An observer with rights of her own: to the other team.
  std::array<bool, kTeams> super_user = {true, true};
};

// Written down, and not computed by what is tested. 12 classes, two teams, three people: 72 cells.
constexpr std::array<Line, 12> kTable = {{
    {InfoClass::kPose, {true, true}, {true, true}, {true, true}},
    {InfoClass::kTruePose, {false, false}, {false, false}, {false, true}},
    {InfoClass::kReadings, {true, false}, {true, false}, {false, true}},
    {InfoClass::kHybridParts, {false, false}, {true, false}, {false, true}},
    {InfoClass::kGoals, {true, false}, {true, false}, {false, true}},
    {InfoClass::kMaps, {true, false}, {true, false}, {false, true}},
    {InfoClass::kChat, {true, false}, {true, false}, {false, true}},
    {InfoClass::kLog, {true, true}, {true, true}, {false, true}},
    {InfoClass::kStop, {false, false}, {true, true}, {false, true}},
    {InfoClass::kRelease, {false, false}, {true, false}, {false, true}},
    {InfoClass::kCommand, {false, false}, {true, false}, {false, true}},
    {InfoClass::kProbe, {false, false}, {true, false}, {false, true}},
}};

/// What a person received or did, by class and team.
class Seen {
 public:
  void note(InfoClass what, std::size_t team) { cells_[what].set(team); }
  [[nodiscard]] bool has(InfoClass what, std::size_t team) const {
    const auto found = cells_.find(what);
    return found != cells_.end() && found->second.test(team);
  }

 private:
  std::map<InfoClass, std::bitset<kTeams>> cells_;
};

template <class Value>
Value value_at(const std::string& bytes, std::size_t at) {
  Value value{};
  if (at + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

class HostileRights : public Hostile {
 protected:
  void SetUp() override {
    for (const Line& line : kTable) {
      if (line.what == InfoClass::kPose) continue;
      run_->facts.rights.set_user("ada", line.what, Reach{Reach::Kind::kTeams, {"blue"}});
    }
    Hostile::SetUp();
    // The usual right: each row of the table needs to know that the robot is there.
    RawSocket boss = super_user();
    set_right(boss, "observer", "pose", "\"all\"");
  }

  using Column = std::array<bool, kTeams> Line::*;

  /// Asks for everything. Waits for what is to come, and then for some pictures more.
  [[nodiscard]] Seen all_of(RawSocket& client, Column expected) {
    Seen seen;
    client.send(
        R"({"type":"look","poses":true,"true_poses":true,"parts":true,"max_hz":60,"readings":[[0,0],[1,0]],"variances":[]})");
    client.send(R"({"type":"look_maps","maps":[0,1]})");
    for (const char* const text : {"to-green", "to-blue"}) {
      boss_->send(fmt::format(R"({{"type":"say","request":1,"to":"team","name":"{}","text":"{}"}})",
                              text + 3, text));
      EXPECT_NE(boss_->text_with(R"("to":"say")").find(R"("good":true)"), std::string::npos);
    }
    for (std::size_t team = 0; team < kTeams; ++team) try_orders(client, team, seen);
    // Of pictures that came before the answers.
    client.send(R"({"type":"ack","sequence":1000000})");
    for (int more = 8; more > 0;) {
      // Fails after ten seconds without anything.
      const auto frame = client.next();
      if (!frame) break;
      const bool picture = frame->opcode == 2 && take_binary(client, frame->payload, seen);
      if (!picture) continue;
      read_texts(client.heard(), seen);
      if (has_all(seen, expected)) --more;
      if (++pictures_ > 2000) break;
    }
    return seen;
  }
  static bool has_all(const Seen& seen, Column expected) {
    for (const Line& line : kTable) {
      for (std::size_t team = 0; team < kTeams; ++team) {
        if ((line.*expected)[team] && !seen.has(line.what, team)) return false;
      }
    }
    return true;
  }

  std::unique_ptr<RawSocket> boss_;

 private:
  int pictures_ = 0;  ///< Of all; so that a test that waits in vain fails.
  static void note_answer(RawSocket& client, const char* to, InfoClass what, std::size_t team,
                          Seen& seen) {
    const std::string answer = client.text_with(fmt::format(R"("to":"{}")", to));
    if (answer.find(R"("good":true)") != std::string::npos) seen.note(what, team);
  }
  /// What a person may do is what reaches the run.
  void try_orders(RawSocket& client, std::size_t team, Seen& seen) {
    client.send(fmt::format(R"({{"type":"halt","do":"stop","slots":[{}]}})", team));
    note_answer(client, "stop", InfoClass::kStop, team, seen);
    client.send(fmt::format(R"({{"type":"halt","do":"release","slots":[{}]}})", team));
    note_answer(client, "release", InfoClass::kRelease, team, seen);
    const std::size_t before = run_->commands().size();
    client.send(
        fmt::format(R"({{"type":"order","request":3,"kind":"cancel","slots":[{}]}})", team));
    EXPECT_NE(client.text_with(R"("to":"cancel")"), "");
    if (run_->commands().size() > before) seen.note(InfoClass::kCommand, team);
    const std::size_t probes = run_->requests().size();
    client.send(fmt::format(
        R"({{"type":"look_probes","request":4,"probes":[{{"slot":{},"name":"p","driver":"virtual_laser","mount":[0,0,0],"z":0,"params":{{}}}}]}})",
        team));
    EXPECT_NE(client.text_with(R"("type":"probes")"), "");
    if (run_->requests().size() > probes) seen.note(InfoClass::kProbe, team);
  }
  /// Whether it is a frame of poses; acknowledges those as a page does.
  static bool take_binary(RawSocket& client, const std::string& bytes, Seen& seen) {
    if (bytes.size() < 16) return false;
    if (bytes[0] == 2) {
      // A reading: `part` is 1 for the half of a hybrid sensor.
      const std::size_t team = value_at<std::uint32_t>(bytes, 4) % 2;
      const bool half = bytes.find(bytes_of(FakeRun::kHalfRange_m)) != std::string::npos;
      seen.note(half ? InfoClass::kHybridParts : InfoClass::kReadings, team);
      return false;
    }
    if (bytes[0] != 1) return false;
    client.send(
        fmt::format(R"({{"type":"ack","sequence":{}}})", value_at<std::uint32_t>(bytes, 4)));
    for (std::size_t team = 0; team < kTeams; ++team) {
      const double x_m = team == 0 ? FakeRun::kOpenTruth_m : FakeRun::kSecretTruth_m;
      const auto x = static_cast<std::int32_t>(std::lround(x_m / double{1e-4F}));
      if (bytes.find(bytes_of(x)) != std::string::npos) seen.note(InfoClass::kTruePose, team);
    }
    return true;
  }
  static void read_texts(const std::string& heard, Seen& seen) {
    const std::array<std::array<std::string, 6>, kTeams> marks = {{
        {"\"walker-1\"", "goal 1.00, 2.00", "walker-1: at home", "to-green",
         text_of(FakeRun::kOpenCells), ""},
        {"\"spy-2\"", "goal 47.11, 2.00", "spy-2: stopped", "to-blue",
         text_of(FakeRun::kSecretCells), ""},
    }};
    constexpr std::array<InfoClass, 5> kOf = {InfoClass::kPose, InfoClass::kGoals, InfoClass::kLog,
                                              InfoClass::kChat, InfoClass::kMaps};
    for (std::size_t team = 0; team < kTeams; ++team) {
      for (std::size_t i = 0; i < kOf.size(); ++i) {
        if (heard.find(marks[team][i]) != std::string::npos) seen.note(kOf[i], team);
      }
    }
  }
  static std::string text_of(const std::vector<std::uint8_t>& cells) {
    return {cells.begin(), cells.end()};
  }
  template <class Value>
  static std::string bytes_of(Value value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
  }
};

TEST_F(HostileRights, AreThoseOfTheTableInAll72Cells) {
  boss_ = std::make_unique<RawSocket>(super_user());
  ASSERT_TRUE(accounts_->add({"ada", Role::kObserver, {false, {"green"}}}, "correct horse"));
  const std::string ada =
      cookie_of(ask("POST", "/login", origin(), "name=ada&password=correct+horse"));
  struct Somebody {
    const char* name;
    std::string cookie;
    Column column;
  };
  const std::array<Somebody, 3> people = {{
      {"an observer", guest(Role::kObserver, "eve"), &Line::observer},
      {"a commander", guest(Role::kCommander, "ben"), &Line::commander},
      {"ada", ada, &Line::ada},
  }};
  int cells = 0;
  for (const auto& [name, cookie, column] : people) {
    RawSocket client = socket(cookie);
    const Seen seen = all_of(client, column);
    for (const Line& line : kTable) {
      for (std::size_t team = 0; team < kTeams; ++team, ++cells) {
        EXPECT_EQ(seen.has(line.what, team), (line.*column)[team])
            << name << ", " << to_string(line.what) << " of "
            << (team == 0 ? "the own team" : "another team");
      }
    }
  }
  EXPECT_EQ(cells, 72);
  // Nothing of the table is missed because nobody looks: a super-user has all of it.
  RawSocket boss = super_user();
  EXPECT_TRUE(has_all(all_of(boss, &Line::super_user), &Line::super_user));
}

}  // namespace
}  // namespace rave::gui_server::testing
