// SPDX-License-Identifier: Apache-2.0
#include "rave/gui_server/accounts.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "accounts_fixture.hpp"
#include "metrics.hpp"
#include "people/audit_log.hpp"
#include "people/secrets.hpp"
#include "rave/base/file.hpp"

namespace rave::gui_server {
namespace {

namespace fs = std::filesystem;

TEST_F(AccountsTest, SignInWithTheRightPasswordAlone) {
  const auto accounts = opened();
  ASSERT_TRUE(accounts->add({"ada", Role::kCommander, {false, {"green"}}}, "correct horse"));
  const auto session = accounts->sign_in("ada", "correct horse");
  ASSERT_TRUE(session) << session.error().text();
  const auto person = accounts->who(*session);
  ASSERT_TRUE(person);
  EXPECT_EQ(*person, (Person{"ada", Role::kCommander, {false, {"green"}}, true}));
  for (const auto& [name, password] :
       {std::pair("ada", "wrong horse"), std::pair("eve", "correct horse"), std::pair("ada", "")}) {
    EXPECT_EQ(error_of(accounts->sign_in(name, password)), "the name or the password is wrong");
  }
  EXPECT_FALSE(accounts->who(""));
  EXPECT_FALSE(accounts->who("0000"));
}

TEST_F(AccountsTest, KeepNoSecretInTheirFile) {
  const auto accounts = opened();
  ASSERT_TRUE(accounts->add({"ada", Role::kSuperUser, {}}, "correct horse"));
  const auto session = accounts->sign_in("ada", "correct horse");
  const auto invitation = accounts->invite(Role::kObserver, {}, 1, 7, "ada");
  ASSERT_TRUE(session && invitation);
  EXPECT_NE(text().find("$argon2id$"), std::string::npos);
  for (const std::string& secret : {std::string("correct horse"), *session, *invitation}) {
    EXPECT_EQ(text().find(secret), std::string::npos);
  }
  struct stat info {};
  ASSERT_EQ(::stat((folder_ / "gui").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 07777U, 0700U);
}

TEST_F(AccountsTest, OutliveTheirServer) {
  std::string session;
  std::string invitation;
  {
    const auto accounts = opened();
    ASSERT_TRUE(accounts->add({"ada", Role::kSuperUser, {}}, "correct horse"));
    session = *accounts->sign_in("ada", "correct horse");
    invitation = *accounts->invite(Role::kObserver, {false, {"blue", "green"}}, 2, 7, "ada");
  }
  const auto accounts = opened();
  EXPECT_TRUE(accounts->who(session));
  const auto guest = accounts->join(invitation, "ben", "");
  ASSERT_TRUE(guest) << guest.error().text();
  EXPECT_EQ(accounts->who(*guest)->teams.text(), "blue,green");
}

TEST_F(AccountsTest, AnInvitationIsGoodForSoManyPeopleAndSoLong) {
  const auto accounts = opened();
  const auto two = accounts->invite(Role::kObserver, {}, 2, 7, "ada");
  ASSERT_TRUE(accounts->join(*two, "ben", ""));
  EXPECT_EQ(error_of(accounts->join(*two, "BEN", "")), "the name `ben` is taken");
  ASSERT_TRUE(accounts->join(*two, "cleo", "ten letters!"));
  const std::string gone = "this invitation is used up, has expired, or is not from this server";
  EXPECT_EQ(error_of(accounts->join(*two, "dora", "")), gone);
  EXPECT_EQ(error_of(accounts->join("feed", "dora", "")), gone);
  const auto old = accounts->invite(Role::kObserver, {}, 1, 7, "ada");
  now_s_ += 8 * 86'400;
  EXPECT_EQ(error_of(accounts->join(*old, "dora", "")), gone);
  EXPECT_EQ(error_of(accounts->invite(Role::kObserver, {}, 0, 7, "ada")),
            "an invitation is valid for 1 to 1000 people");
  EXPECT_EQ(error_of(accounts->invite(Role::kObserver, {}, 1, 366, "ada")),
            "an invitation is valid for 1 to 365 days");
}

TEST_F(AccountsTest, GuestsGoWithTheirSession) {
  const auto accounts = opened();
  const auto link = accounts->invite(Role::kObserver, {}, 5, 30, "ada");
  const auto guest = accounts->join(*link, "ben", "");
  ASSERT_TRUE(guest);
  EXPECT_EQ(error_of(accounts->sign_in("ben", "")), "the name or the password is wrong");
  now_s_ += Accounts::kSessionLife_s + 1;
  EXPECT_FALSE(accounts->who(*guest));
  EXPECT_TRUE(accounts->state().accounts.empty());
  EXPECT_TRUE(accounts->join(*link, "ben", ""));
}

TEST_F(AccountsTest, WhoIsRemovedOrSignsOutIsOut) {
  const auto accounts = opened();
  ASSERT_TRUE(accounts->add({"ada", Role::kSuperUser, {}}, "correct horse"));
  const std::string one = *accounts->sign_in("ada", "correct horse");
  const std::string two = *accounts->sign_in("ada", "correct horse");
  ASSERT_TRUE(accounts->sign_out(one));
  EXPECT_FALSE(accounts->who(one));
  EXPECT_TRUE(accounts->who(two));
  EXPECT_EQ(error_of(accounts->remove("adda")), "there is no account `adda`; did you mean `ada`?");
  // Another process removes; the first one learns of it.
  ASSERT_TRUE(opened()->remove("ada"));
  ASSERT_TRUE(accounts->refresh());
  EXPECT_FALSE(accounts->who(two));
}

TEST_F(AccountsTest, AnotherRoleIsInForceAtOnceAndOfOpenSessions) {
  const auto accounts = opened();
  ASSERT_TRUE(accounts->add({"ada", Role::kSuperUser, {}}, "correct horse"));
  ASSERT_TRUE(accounts->add({"ben", Role::kSuperUser, {}}, "correct horse"));
  const std::string session = *accounts->sign_in("ben", "correct horse");
  ASSERT_TRUE(accounts->change_person({"ben", Role::kObserver, {false, {"green"}}}));
  EXPECT_EQ(*accounts->who(session), (Person{"ben", Role::kObserver, {false, {"green"}}, true}));
  EXPECT_EQ(error_of(accounts->change_person({"Ben", Role::kObserver, {}})),
            "there is no account `Ben`; did you mean `ben`?");
  // Who could mend it is never taken away; ben may go.
  EXPECT_EQ(error_of(accounts->change_person({"ada", Role::kCommander, {}})),
            "`ada` is the last super-user who can sign in");
  EXPECT_EQ(error_of(accounts->set_disabled("ada", true)),
            "`ada` is the last super-user who can sign in");
  EXPECT_EQ(accounts->state().accounts[0].person.role, Role::kSuperUser);
  EXPECT_TRUE(accounts->set_disabled("ben", true));
}

TEST_F(AccountsTest, ATeamThatIsGivenHasOneCommander) {
  const auto accounts = opened();
  ASSERT_TRUE(accounts->add({"ada", Role::kCommander, {false, {"green", "red"}}}, "correct horse"));
  ASSERT_TRUE(accounts->add({"ben", Role::kCommander, {false, {}}}, "correct horse"));
  ASSERT_TRUE(accounts->add({"eve", Role::kObserver, {false, {"green"}}}, "correct horse"));
  ASSERT_TRUE(accounts->invite(Role::kCommander, {false, {"green"}}, 1, 1, "ada", "cleo"));
  ASSERT_TRUE(accounts->give_team("green", "ben"));
  const AccountsFile state = accounts->state();
  EXPECT_EQ(state.accounts[0].person.teams.text(), "red");
  EXPECT_EQ(state.accounts[1].person.teams.text(), "green");
  EXPECT_EQ(state.accounts[2].person.teams.text(), "green") << "an observer only looks on";
  EXPECT_EQ(state.invitations[0].teams.text(), "-");
  ASSERT_TRUE(accounts->give_team("red", "cleo"));
  EXPECT_EQ(accounts->state().invitations[0].teams.text(), "red");
  EXPECT_EQ(error_of(accounts->give_team("red", "dan")),
            "there is no account or invitation of `dan`");
}

TEST_F(AccountsTest, WhoIsDisabledKeepsTheNameAndIsOut) {
  const auto accounts = opened();
  ASSERT_TRUE(accounts->add({"ada", Role::kObserver, {}}, "correct horse"));
  const auto link = accounts->invite(Role::kObserver, {}, 5, 30, "ada");
  const std::string ada = *accounts->sign_in("ada", "correct horse");
  const std::string ben = *accounts->join(*link, "ben", "");
  for (const char* const name : {"ada", "ben"}) ASSERT_TRUE(accounts->set_disabled(name, true));
  EXPECT_FALSE(accounts->who(ada));
  EXPECT_FALSE(accounts->who(ben));
  EXPECT_EQ(error_of(accounts->sign_in("ada", "wrong horse")), "the name or the password is wrong");
  EXPECT_EQ(error_of(accounts->sign_in("ada", "correct horse")),
            "this account is disabled; a super-user can enable it");
  EXPECT_EQ(error_of(accounts->join(*link, "Ben", "")), "the name `ben` is taken");
  ASSERT_TRUE(opened()->set_disabled("ada", false));
  EXPECT_TRUE(accounts->sign_in("ada", "correct horse"));
}

TEST_F(AccountsTest, SessionsEndAndPeopleWereSeen) {
  const auto accounts = opened();
  ASSERT_TRUE(accounts->add({"ada", Role::kObserver, {}}, "correct horse"));
  EXPECT_EQ(accounts->state().accounts[0].seen_s, 0);
  const std::string one = *accounts->sign_in("ada", "correct horse");
  ASSERT_TRUE(accounts->sign_in("ada", "correct horse"));
  EXPECT_EQ(accounts->state().accounts[0].seen_s, now_s_);
  now_s_ += 5;
  const auto revision = accounts->revision();
  ASSERT_TRUE(accounts->note_seen("ada"));
  EXPECT_EQ(accounts->revision(), revision);
  now_s_ += 60;
  ASSERT_TRUE(accounts->note_seen("ada"));
  EXPECT_NE(accounts->revision(), revision);
  EXPECT_EQ(accounts->state().accounts[0].seen_s, now_s_);
  EXPECT_EQ(accounts->end_sessions("ada").value_or(0), 2U);
  EXPECT_FALSE(accounts->who(one));
  EXPECT_EQ(error_of(accounts->end_sessions("eve")), "there is no account `eve`");
}

TEST_F(AccountsTest, AnInvitationIsWithdrawnByItsId) {
  const auto accounts = opened();
  const std::string kept = *accounts->invite(Role::kObserver, {}, 1, 7, "ada");
  const std::string secret = *accounts->invite(Role::kCommander, {}, 1, 7, "ada");
  const std::string id = accounts->state().invitations[1].id();
  EXPECT_EQ(secret.find(id), std::string::npos);
  const auto withdrawn = accounts->withdraw(id);
  ASSERT_TRUE(withdrawn) << withdrawn.error().text();
  EXPECT_EQ(withdrawn->role, Role::kCommander);
  EXPECT_FALSE(accounts->invitation(secret));
  EXPECT_TRUE(accounts->invitation(kept));
  EXPECT_EQ(error_of(accounts->withdraw(id)),
            "this invitation is used up, has expired or was withdrawn");
}

TEST_F(AccountsTest, NamesAndPasswordsAreChecked) {
  const auto accounts = opened();
  const Person ada{"ada", Role::kObserver, {}};
  EXPECT_EQ(error_of(accounts->add(ada, "too short")), "a password has 10 to 256 characters");
  ASSERT_TRUE(accounts->add(ada, "long enough"));
  EXPECT_EQ(error_of(accounts->add({"Ada", Role::kObserver, {}}, "long enough")),
            "the name `ada` is taken");
  for (const char* const bad : {"", "-a", "a b", "a\tb", "a\nb", "<b>", "\xc3\xa4"}) {
    EXPECT_FALSE(check_user_name(bad)) << bad;
  }
  EXPECT_TRUE(check_user_name("ada.l-1@lab_2"));
}

TEST_F(AccountsTest, AFolderThatOthersReadIsRefused) {
  fs::create_directory(folder_ / "open");
  fs::permissions(folder_ / "open", fs::perms(0755));
  const auto accounts = Accounts::open(folder_ / "open");
  ASSERT_FALSE(accounts);
  EXPECT_NE(accounts.error().message.find("chmod 700"), std::string::npos);
}

struct BadFile {
  const char* text;
  const char* error;
};
class BadAccounts : public testing::TestWithParam<BadFile> {};

TEST_P(BadAccounts, AreRefusedWithTheirLine) {
  const auto file = parse_accounts(GetParam().text, "accounts");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().text(), GetParam().error);
}

#define HASH "00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff"

INSTANTIATE_TEST_SUITE_P(
    All, BadAccounts,
    testing::Values(
        BadFile{"",
                "accounts:1: expected `rave-accounts 1`; not a file of accounts, or one of a later "
                "version"},
        BadFile{"rave-accounts 1\nhost\tx\n",
                "accounts:2: expected user, invitation or session, found `host`"},
        BadFile{"rave-accounts 1\nuser\tada\tobserver\t*\n",
                "accounts:2: expected 5 columns, separated by tabs, found 4"},
        BadFile{"rave-accounts 1\nuser\tada\troot\t*\t-\n",
                "accounts:2: expected observer, commander or super_user, found `root`"},
        BadFile{"rave-accounts 1\nuser\tada\tobserver\ta,,b\t-\n",
                "accounts:2: expected teams such as green,blue, or * for all, or - for none"},
        BadFile{"rave-accounts 1\nuser\tada\tobserver\t*\tplain\n",
                "accounts:2: expected a hash by Argon2id, or - for none"},
        BadFile{"rave-accounts 1\nuser\tada\tobserver\t*\t-\nuser\tada\tobserver\t*\t-\n",
                "accounts:3: `ada` already has an account"},
        BadFile{"rave-accounts 1\nuser\tada\tobserver\t*\t-\tasleep\t0\n",
                "accounts:2: expected enabled or disabled, found `asleep`"},
        BadFile{"rave-accounts 1\nuser\tada\tobserver\t*\t-\tenabled\t-1\n",
                "accounts:2: expected a number up to 99999999999"},
        BadFile{"rave-accounts 1\nuser\tada\tobserver\t*\t-\tenabled\t1\tmine\n",
                "accounts:2: expected given or chosen, found `mine`"},
        BadFile{
            "rave-accounts 1\ninvitation\t" HASH "\tobserver\t*\t1\t5\tada\ta b\n",
            "accounts:2: a name has 1 to 32 letters, digits, `-`, `_`, `.` and `@`, the first a "
            "letter or digit"},
        BadFile{"rave-accounts 1\nsession\tshort\tada\t1\n",
                "accounts:2: expected a hash of 64 digits"},
        BadFile{"rave-accounts 1\nsession\t" HASH "\tada\t1e9\n",
                "accounts:2: expected a number up to 99999999999"},
        BadFile{"rave-accounts 1\ninvitation\t" HASH "\tobserver\t*\t1001\t5\tada\n",
                "accounts:2: expected a number up to 1000"}));

TEST(AccountsFileTest, IsReadAsItWasWritten) {
  const std::string text =
      "rave-accounts 1\nuser\tada\tsuper_user\t*\t$argon2id$v=19$m=65536,t=2,p=1$c2FsdA$aGFzaA\n"
      "user\tben\tobserver\tblue,green\t-\nuser\tcleo\tobserver\t*\t-\tdisabled\t1800000000\n"
      "user\tdora\tobserver\t*\t$argon2id$v=19$m=65536,t=2,p=1$c2FsdA$aGFzaA\tenabled\t0\tchosen\n"
      "user\teve\tobserver\t*\t-\tenabled\t0\tgiven\n"
      "invitation\t" HASH
      "\tcommander\t-\t3\t1800000000\tada\n"
      "invitation\t" HASH
      "\tcommander\t-\t1\t1800000000\tada\tfred\n"
      "session\t" HASH "\tben\t1800000001\n";
  const auto file = parse_accounts(text, "accounts");
  ASSERT_TRUE(file) << file.error().text();
  EXPECT_EQ(write_accounts(*file), text);
  // The session of somebody whose line was removed by hand.
  const auto orphan = parse_accounts("rave-accounts 1\nsession\t" HASH "\tben\t5\n", "accounts");
  ASSERT_TRUE(orphan);
  EXPECT_TRUE(orphan->sessions.empty());
}

TEST_F(AccountsTest, TheAuditLogIsBoundedAndOneLineEach) {
  AuditLog log(folder_, 2000);
  for (int i = 0; i < 200; ++i) {
    log.note("login", {{"why", "two\nlines \"\xff"}, {"user", ""}, {"from", "::1"}});
  }
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    ++files;
    EXPECT_LT(entry.file_size(), 2300U);
    struct stat info {};
    ASSERT_EQ(::stat(entry.path().c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 07777U, 0600U);
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      EXPECT_TRUE(line.starts_with("{\"time\":\"20")) << line;
      EXPECT_TRUE(line.ends_with("\"from\":\"::1\"}")) << line;
      EXPECT_EQ(line.find("user"), std::string::npos);
    }
  }
  EXPECT_EQ(files, 5U);
  EXPECT_EQ(log.lost(), 0U);
}

TEST_F(AccountsTest, StrangersCannotPushOthersOutOfTheAuditLog) {
  AuditLog log(folder_);
  log.note("stop", {{"user", "ada"}, {"from", "192.168.1.20"}});
  for (int i = 0; i < 500; ++i) log.note("refused", {{"why", "link"}, {"from", "10.0.0.1"}});
  log.note("refused", {{"why", "link"}, {"from", "10.0.0.2"}});
  const std::string text = read_file(folder_ / "audit.jsonl").value_or("");
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 60);
  EXPECT_NE(text.find("ada"), std::string::npos);
  EXPECT_NE(text.find("10.0.0.2"), std::string::npos);
}

TEST_F(AccountsTest, TheAuditLogIsReadNewestFirst) {
  AuditLog log(folder_, 2000);
  EXPECT_TRUE(log.read({}).lines.empty());
  for (int i = 0; i < 100; ++i) {
    log.note(i % 2 == 0 ? "login" : "stop", {{"user", i == 90 ? "Ada" : "ben"}, {"from", "::1"}});
  }
  log.note("refused", {{"why", "order"}, {"user", "eve"}, {"detail", "goal: not yours"}});
  EXPECT_EQ(log.written(), 101U);
  std::ofstream(folder_ / "audit.jsonl", std::ios::app) << "no line\n{\"time\":3}\n{\"time\":\"2";
  const AuditPage newest = log.read({{}, {}, 3});
  ASSERT_EQ(newest.lines.size(), 3U);
  EXPECT_TRUE(newest.more);
  EXPECT_EQ(newest.lines[0].what, "refused");
  EXPECT_EQ(newest.lines[0].detail, "goal: not yours");
  EXPECT_EQ(newest.lines[1].what, "stop");
  // Over the borders of files.
  const AuditPage logins = log.read({"login", {}, 1000});
  EXPECT_GT(logins.lines.size(), 30U);
  EXPECT_FALSE(logins.more);
  const AuditPage of_ada = log.read({{}, "aDA", 1000});
  ASSERT_EQ(of_ada.lines.size(), 1U);
  EXPECT_EQ(of_ada.lines[0].from, "::1");
  EXPECT_TRUE(AuditLog("").read({}).lines.empty());
}

TEST_F(AccountsTest, WhoIsSignedInCannotFloodTheAuditLogEither) {
  AuditLog log(folder_);
  for (int i = 0; i < 500; ++i) log.note("refused", {{"why", "order"}, {"user", "eve"}});
  log.note("refused", {{"why", "order"}, {"user", "ben"}});
  EXPECT_LT(log.read({{}, "eve", 1000}).lines.size(), 60U);
  EXPECT_EQ(log.read({{}, "ben", 1000}).lines.size(), 1U);
}

TEST(Metrics, AreForThisMachineOrWhoHasTheToken) {
  web::Request request;
  request.peer = "127.0.0.1";
  EXPECT_TRUE(may_read_metrics(request, ""));
  request.peer = "192.168.1.20";
  EXPECT_FALSE(may_read_metrics(request, ""));
  EXPECT_FALSE(may_read_metrics(request, "token"));
  for (const auto& [header, good] :
       {std::pair("Bearer token", true), std::pair("Bearer tokem", false),
        std::pair("token", false), std::pair("Bearer ", false)}) {
    request.headers["authorization"] = header;
    EXPECT_EQ(may_read_metrics(request, "token"), good) << header;
    EXPECT_FALSE(may_read_metrics(request, ""));
  }
}

TEST(Secrets, AreLongAndNeverTheSame) {
  EXPECT_EQ(new_secret().size(), 48U);
  EXPECT_NE(new_secret(), new_secret());
  EXPECT_EQ(hash_of("a"), hash_of("a"));
  EXPECT_TRUE(is_password_hash(password_hash("x")));
  EXPECT_FALSE(password_fits("x", ""));
}

}  // namespace
}  // namespace rave::gui_server
