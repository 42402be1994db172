// SPDX-License-Identifier: Apache-2.0
// Who gets which name, and by whom.
#include <fmt/format.h>

#include "accounts_fixture.hpp"

namespace rave::gui_server {
namespace {

TEST_F(AccountsTest, ANameIsGivenByWhoAddsTheAccountOrInvitesForIt) {
  const auto accounts = opened();
  ASSERT_TRUE(accounts->add({"ada", Role::kObserver, {}}, "correct horse"));
  const std::string any = *accounts->invite(Role::kObserver, {}, 9, 7, "ada");
  const std::string bens = *accounts->invite(Role::kCommander, {}, 1, 7, "ada", "ben");
  // While an invitation for a name is open, nobody else takes it.
  const auto refused = [](const char* name) {
    return fmt::format("the name `{}` is taken, or too like another; choose a different one", name);
  };
  EXPECT_EQ(error_of(accounts->join(any, "ben", "")), refused("ben"));
  EXPECT_EQ(error_of(accounts->join(any, "Ben.", "")), refused("Ben."));
  EXPECT_EQ(error_of(accounts->join(bens, "cleo", "")), "this invitation is for `ben`");
  const auto ben = accounts->join(bens, "ben", "");
  const auto cleo = accounts->join(any, "cleo", "ten letters!");
  ASSERT_TRUE(ben && cleo);
  EXPECT_TRUE(accounts->who(*ben)->name_given);
  EXPECT_FALSE(accounts->who(*cleo)->name_given);
  // It is in the file, and a change of the role keeps it.
  ASSERT_TRUE(accounts->change_person({"cleo", Role::kCommander, {}, true}));
  for (const Account& account : opened()->state().accounts) {
    EXPECT_EQ(account.person.name_given, account.person.name != "cleo") << account.person.name;
  }
  ASSERT_TRUE(accounts->give_name("cleo"));
  EXPECT_TRUE(opened()->who(*cleo)->name_given);
  EXPECT_EQ(error_of(accounts->invite(Role::kObserver, {}, 1, 7, "ada", "BEN")),
            "the name `ben` is taken");
  EXPECT_EQ(error_of(accounts->invite(Role::kObserver, {}, 2, 7, "ada", "dora")),
            "an invitation for `dora` is for one person");
}

TEST_F(AccountsTest, AChosenNameMustNotLookLikeAnother) {
  const auto accounts = opened();
  ASSERT_TRUE(accounts->add({"Maria.Lin0", Role::kObserver, {}}, "correct horse"));
  const std::string any = *accounts->invite(Role::kObserver, {}, 99, 7, "Maria.Lin0");
  const NameSet kept{"ada", "ward", "olive"};
  for (const char* const bad :
       {"ada", "ADA", "a-d.a", "ada_", "vvard", "0live", "o1ive", "OIive", "maria-lino",
        "rnaria.lin0", "MariaLIn0", "you", "Y0U", "operator", "terminal", "unknown"}) {
    EXPECT_FALSE(accounts->join(any, bad, "", kept)) << bad;
  }
  // Blanks, letters of other alphabets and invisible ones are in no name.
  for (const char* const bad : {"ada ", " ada",
                                "\xd0\xb0"
                                "da",
                                "ad\xc3\xa0", "ada\xe2\x80\x8b",
                                "\xef\xbd\x81"
                                "da"}) {
    EXPECT_FALSE(accounts->join(any, bad, "", kept)) << bad;
  }
  for (const char* const good : {"adam", "dada", "mario"}) {
    EXPECT_TRUE(accounts->join(any, good, "", kept)) << good;
  }
  // Who adds an account may: a super-user knows both.
  EXPECT_TRUE(accounts->add({"ada", Role::kObserver, {}}, "correct horse"));
  EXPECT_FALSE(accounts->add({"you", Role::kObserver, {}}, "correct horse"));
}

}  // namespace
}  // namespace rave::gui_server
