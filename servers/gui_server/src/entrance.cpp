// SPDX-License-Identifier: Apache-2.0
#include "entrance.hpp"

#include <sodium.h>

#include <array>

#include "rave/base/check.hpp"

namespace rave::gui_server {
namespace {

constexpr std::size_t kSecretBytes = 24;
constexpr auto kKeyLife = std::chrono::hours(24);
constexpr auto kSessionLife = std::chrono::hours(24 * 7);

std::string new_secret() {
  std::array<unsigned char, kSecretBytes> bytes{};
  randombytes_buf(bytes.data(), bytes.size());
  std::array<char, 2 * kSecretBytes + 1> text{};
  sodium_bin2hex(text.data(), text.size(), bytes.data(), bytes.size());
  return text.data();
}

/// Secrets of 192 bits need no slow hash; looking a hash up tells nothing of the secret by its
/// time.
std::string hash_of(std::string_view secret) {
  std::string hash(crypto_generichash_BYTES, '\0');
  crypto_generichash(reinterpret_cast<unsigned char*>(hash.data()), hash.size(),
                     reinterpret_cast<const unsigned char*>(secret.data()), secret.size(), nullptr,
                     0);
  return hash;
}

}  // namespace

Entrance::Entrance() { RAVE_CHECK(sodium_init() >= 0); }

std::string Entrance::new_key() {
  std::string key = new_secret();
  const std::lock_guard lock(mutex_);
  keys_[hash_of(key)] = Clock::now() + kKeyLife;
  return key;
}

std::optional<std::string> Entrance::enter(std::string_view key) {
  const std::lock_guard lock(mutex_);
  const auto found = keys_.find(hash_of(key));
  if (found == keys_.end()) return std::nullopt;
  const bool in_time = Clock::now() < found->second;
  keys_.erase(found);
  if (!in_time) return std::nullopt;
  std::string secret = new_secret();
  sessions_[hash_of(secret)] = Clock::now() + kSessionLife;
  return secret;
}

bool Entrance::knows(std::string_view secret) const {
  const std::lock_guard lock(mutex_);
  const auto found = sessions_.find(hash_of(secret));
  return found != sessions_.end() && Clock::now() < found->second;
}

}  // namespace rave::gui_server
