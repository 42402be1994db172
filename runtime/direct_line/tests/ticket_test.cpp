// SPDX-License-Identifier: Apache-2.0
#include "rave/direct_line/ticket.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "page_key.hpp"
#include "rave/direct_line/key_files.hpp"
#include "rave/direct_line_testing/page_of_test.hpp"
#include "signed_text.hpp"

namespace rave::direct_line {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kNow_s = 1'790'000'000;

Ticket sample_ticket() {
  Ticket ticket;
  ticket.run = "0123";
  ticket.host = "left";
  ticket.user = "anna";
  ticket.role = "commander";
  ticket.origin = "https://lab.example:8080";
  ticket.orders.names = {"r1", "r2"};
  ticket.stops.all = true;
  ticket.page_key = testing::PageKey().point();
  ticket.epoch = 7;
  ticket.expires_s = kNow_s + kTicketLife_s;
  ticket.nonce = "abc";
  return ticket;
}

std::string why_not(std::string_view text, const SigningKey& key, std::int64_t now_s = kNow_s) {
  const auto ticket = verify_ticket(text, key.open, now_s);
  return ticket ? "" : ticket.error().message;
}

TEST(Ticket, ComesBackAsItWas) {
  const SigningKey key = new_signing_key();
  const Ticket ticket = sample_ticket();
  const auto back = verify_ticket(sign_ticket(ticket, key), key.open, kNow_s);
  ASSERT_TRUE(back) << back.error().text();
  EXPECT_EQ(*back, ticket);
  EXPECT_TRUE(back->stops.has("anybody"));
  EXPECT_TRUE(back->orders.has("r2"));
  EXPECT_FALSE(back->orders.has("r3"));
  EXPECT_TRUE(back->releases.empty());
}

TEST(Ticket, OfAnotherKeyOrChangedIsRefused) {
  const SigningKey key = new_signing_key();
  const std::string text = sign_ticket(sample_ticket(), key);
  EXPECT_EQ(why_not(text, new_signing_key()),
            "the ticket is not signed by the GUI Server of this run");
  // Every character counts.
  for (std::size_t at = 0; at < text.size(); at += 7) {
    std::string changed = text;
    changed[at] = changed[at] == 'A' ? 'B' : 'A';
    EXPECT_NE(why_not(changed, key), "") << at;
  }
  for (const char* const nonsense : {"", ".", "e30.", "no ticket", "e30.e30", "?.?"}) {
    EXPECT_EQ(why_not(nonsense, key), "not a valid ticket") << nonsense;
  }
  EXPECT_EQ(why_not(std::string(kLongestTicket, 'A') + ".A", key), "not a valid ticket");
}

TEST(Ticket, ASignedTextOfAnotherKindIsNone) {
  const SigningKey key = new_signing_key();
  const std::string withdrawal = sign_withdrawal({"0123", "anna", 8}, key);
  EXPECT_EQ(why_not(withdrawal, key), "the ticket is not signed by the GUI Server of this run");
  EXPECT_FALSE(verify_withdrawal(sign_ticket(sample_ticket(), key), key.open));
  const auto back = verify_withdrawal(withdrawal, key.open);
  ASSERT_TRUE(back) << back.error().text();
  EXPECT_EQ(*back, (Withdrawal{"0123", "anna", 8}));
}

TEST(Ticket, EndsInTime) {
  const SigningKey key = new_signing_key();
  const std::string text = sign_ticket(sample_ticket(), key);
  const std::int64_t end_s = kNow_s + kTicketLife_s;
  EXPECT_EQ(why_not(text, key, end_s + kClockSlack_s), "");
  EXPECT_EQ(why_not(text, key, end_s + kClockSlack_s + 1), "the ticket has expired 31 s ago");
  EXPECT_NE(why_not(text, key, kNow_s - 31).find("the clocks of this host and the GUI Server"),
            std::string::npos);
}

TEST(Ticket, SaysWhatIsMissingThoughItIsSigned) {
  const SigningKey key = new_signing_key();
  EXPECT_EQ(why_not(sign_text("ticket", "[]", key), key), "not a valid ticket");
  EXPECT_EQ(why_not(sign_text("ticket", R"({"v":2})", key), key), "unknown version 2: expected 1");
  EXPECT_EQ(why_not(sign_text("ticket", R"({"v":1})", key), key), "`run` is missing");
  Ticket nobody = sample_ticket();
  nobody.user.clear();
  EXPECT_EQ(why_not(sign_ticket(nobody, key), key), "`user`: expected a name");
  Ticket observer = sample_ticket();
  observer.role = "observer";
  EXPECT_EQ(why_not(sign_ticket(observer, key), key), "`role`: expected commander or super_user");
  Ticket keyless = sample_ticket();
  keyless.page_key = "short";
  EXPECT_EQ(why_not(sign_ticket(keyless, key), key),
            "`key`: expected an uncompressed point of P-256 in base64url");
}

TEST(PageKeys, SignWhatTheySigned) {
  const testing::PageKey key;
  const std::string text = proof_text("challenge", "left:8090", "ticket");
  const std::string signature = key.sign(text);
  EXPECT_TRUE(page_key_signed(key.point(), signature, text));
  EXPECT_FALSE(page_key_signed(key.point(), signature, text + "x"));
  EXPECT_FALSE(page_key_signed(testing::PageKey().point(), signature, text));
  EXPECT_FALSE(page_key_signed(key.point(), signature.substr(1), text));
  EXPECT_FALSE(page_key_signed(key.point(), std::string(64, '\0'), text));
  // Not on the curve.
  EXPECT_FALSE(page_key_signed(std::string(1, '\4') + std::string(64, 'x'), signature, text));
  // Parts cannot be moved into one another.
  EXPECT_NE(proof_text("a", "b", "c"), proof_text("ab", "", "c"));
}

TEST(KeyFiles, AreMadeOnceAndReadByHalves) {
  std::string name = fs::temp_directory_path() / "rave-line-keys-XXXXXX";
  ASSERT_NE(::mkdtemp(name.data()), nullptr);
  const fs::path file = fs::path(name) / "line";
  ASSERT_TRUE(make_key_files(file));
  struct stat about {};
  ASSERT_EQ(::stat(file.c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777U, 0600U);
  const auto key = read_signing_key(file);
  ASSERT_TRUE(key) << key.error().text();
  const auto open = read_public_key(name + "/line.pub");
  ASSERT_TRUE(open) << open.error().text();
  EXPECT_EQ(*open, key->open);
  EXPECT_EQ(why_not(sign_ticket(sample_ticket(), *key), *key), "");
  const auto message = [](const auto& result) { return result ? "" : result.error().message; };
  EXPECT_NE(message(make_key_files(file)).find("already exists"), std::string::npos);
  EXPECT_NE(message(read_public_key(file)).find("is the secret half of the key"),
            std::string::npos);
  EXPECT_NE(message(read_signing_key(name + "/line.pub")).find("is the public half"),
            std::string::npos);
  std::ofstream(name + "/text") << "no key\n";
  EXPECT_NE(message(read_public_key(name + "/text")).find("is not a key of direct lines"),
            std::string::npos);
  fs::permissions(file, fs::perms::group_read, fs::perm_options::add);
  EXPECT_NE(message(read_signing_key(file)).find("other users can read"), std::string::npos);
  fs::remove_all(name);
}

}  // namespace
}  // namespace rave::direct_line
