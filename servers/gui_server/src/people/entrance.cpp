// SPDX-License-Identifier: Apache-2.0
#include "people/entrance.hpp"

#include "people/secrets.hpp"

namespace rave::gui_server {
namespace {

constexpr auto kKeyLife = std::chrono::hours(24);
constexpr auto kSessionLife = std::chrono::hours(24 * 7);

}  // namespace

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

void Entrance::leave(std::string_view secret) {
  const std::lock_guard lock(mutex_);
  sessions_.erase(hash_of(secret));
}

}  // namespace rave::gui_server
