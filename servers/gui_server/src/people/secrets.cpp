// SPDX-License-Identifier: Apache-2.0
#include "people/secrets.hpp"

#include <sodium.h>

#include <algorithm>
#include <array>

#include "rave/base/check.hpp"

namespace rave::gui_server {
namespace {

constexpr std::size_t kSecretBytes = 24;

std::string hexadecimal(const unsigned char* bytes, std::size_t size) {
  std::string text(2 * size + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), bytes, size);
  text.pop_back();
  return text;
}

}  // namespace

std::string new_secret() {
  RAVE_CHECK(sodium_init() >= 0);
  std::array<unsigned char, kSecretBytes> bytes{};
  randombytes_buf(bytes.data(), bytes.size());
  return hexadecimal(bytes.data(), bytes.size());
}

std::string hash_of(std::string_view secret) {
  RAVE_CHECK(sodium_init() >= 0);
  std::array<unsigned char, crypto_generichash_BYTES> hash{};
  crypto_generichash(hash.data(), hash.size(),
                     reinterpret_cast<const unsigned char*>(secret.data()), secret.size(), nullptr,
                     0);
  return hexadecimal(hash.data(), hash.size());
}

std::string password_hash(std::string_view password) {
  RAVE_CHECK(sodium_init() >= 0);
  std::array<char, crypto_pwhash_STRBYTES> text{};
  if (crypto_pwhash_str_alg(text.data(), password.data(), password.size(),
                            crypto_pwhash_OPSLIMIT_INTERACTIVE, crypto_pwhash_MEMLIMIT_INTERACTIVE,
                            crypto_pwhash_ALG_ARGON2ID13) != 0) {
    return {};
  }
  return text.data();
}

bool password_fits(std::string_view password, const std::string& hash) {
  if (hash.empty()) {
    // The time of the answer must not reveal whether an account exists.
    static_cast<void>(password_hash(password));
    return false;
  }
  RAVE_CHECK(sodium_init() >= 0);
  return crypto_pwhash_str_verify(hash.c_str(), password.data(), password.size()) == 0;
}

bool is_password_hash(std::string_view text) {
  return text.starts_with("$argon2id$v=19$m=") && text.size() < crypto_pwhash_STRBYTES &&
         std::ranges::all_of(text, [](char c) { return c > ' ' && c <= '~'; });
}

}  // namespace rave::gui_server
