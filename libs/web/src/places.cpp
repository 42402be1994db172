// SPDX-License-Identifier: Apache-2.0
#include "places.hpp"

#include <algorithm>

#include "rave/web/rate_limit.hpp"

namespace rave::web {
namespace {

using Rank = Caller::Rank;

// No two kinds of holders have the same name.
std::string of_session(const Caller& caller) { return "session " + caller.session; }
std::string of_user(const Caller& caller) { return "user " + caller.user; }
std::string of_address(const std::string& address) { return "address " + address; }
std::string of_network(const std::string& address) { return "network " + network_of(address); }

/// What is kept free for others than this one is open to them.
std::size_t reserve_for(Rank rank, std::size_t reserve) {
  if (rank == Rank::kAlways) return reserve;
  return rank == Rank::kMayStop ? reserve / 2 : 0;
}

}  // namespace

void ConnectionPlaces::add(Link& link, const std::string& address) {
  if (entries_.size() >= most_) {
    std::map<std::string_view, std::size_t> held;
    std::string most;
    std::size_t count = 0;
    for (const Entry& entry : entries_) {
      // Who may always come in is never the one who goes.
      if (entry.rank == Rank::kAlways) continue;
      const std::size_t now = ++held[entry.holder];
      if (now <= count) continue;
      count = now;
      most = entry.holder;
    }
    cut_one_of(most.empty() ? entries_.front().holder : most);
  }
  entries_.push_back({&link, of_address(address), Rank::kAnyone});
}

void ConnectionPlaces::remove(const Link& link) {
  entries_.remove_if([&link](const Entry& entry) { return entry.link == &link; });
}

void ConnectionPlaces::name(const Link& link, const Caller& caller) {
  const auto found = std::ranges::find(entries_, &link, &Entry::link);
  if (found == entries_.end() || caller.session.empty()) return;
  found->rank = caller.rank;
  std::string holder = of_session(caller);
  if (found->holder == holder) return;
  if (caller.rank != Rank::kAlways && count_of(holder) >= most_per_session_) cut_one_of(holder);
  found->holder = std::move(holder);
}

void ConnectionPlaces::cut_one_of(const std::string& holder) {
  const auto oldest = std::ranges::find(entries_, holder, &Entry::holder);
  if (oldest == entries_.end()) return;
  Link* const link = oldest->link;
  // Before it is cut, because that may remove it.
  entries_.erase(oldest);
  link->cut();
}

std::size_t ConnectionPlaces::count_of(const std::string& holder) const {
  return static_cast<std::size_t>(std::ranges::count(entries_, holder, &Entry::holder));
}

std::vector<Link*> ConnectionPlaces::all() const {
  std::vector<Link*> links;
  for (const Entry& entry : entries_) links.push_back(entry.link);
  return links;
}

bool SocketPlaces::full(const std::string& count, std::size_t most) const {
  const auto found = counts_.find(count);
  return found != counts_.end() && found->second >= most;
}

std::string_view SocketPlaces::refusal(const Caller& caller, const std::string& address) const {
  const ServerOptions& most = options_;
  const std::size_t reserve = reserve_for(caller.rank, most.reserve);
  // In this order: what one visitor does is stopped by the limits of that visitor.
  if (!caller.session.empty() && caller.rank != Rank::kAlways) {
    if (full(of_session(caller), most.sockets_per_session)) {
      return "too many pages of this session are open";
    }
    if (full(of_user(caller), most.sockets_per_user)) {
      return "too many pages of this user are open";
    }
  }
  if (!is_loopback(address)) {
    if (full(of_address(address), most.sockets_per_address + reserve) ||
        full(of_network(address), most.sockets_per_network + reserve)) {
      return "too many pages are open from this address";
    }
  }
  if (served_ >= most.sockets + reserve) return "too many pages are open";
  return {};
}

SocketPlaces::Place::Place(SocketPlaces& places, const Caller& caller, const std::string& address)
    : places_(places), counted_{of_address(address), of_network(address)} {
  if (!caller.session.empty()) {
    counted_.push_back(of_session(caller));
    counted_.push_back(of_user(caller));
  }
  for (const std::string& count : counted_) ++places_.counts_[count];
  ++places_.served_;
}

SocketPlaces::Place::~Place() {
  give_back();
  if (leaves_) --places_.leaving_;
}

bool SocketPlaces::Place::leave() {
  give_back();
  if (!leaves_ && places_.leaving_ >= kMostLeaving) return false;
  if (!leaves_) ++places_.leaving_;
  leaves_ = true;
  return true;
}

void SocketPlaces::Place::give_back() {
  if (counted_.empty()) return;
  for (const std::string& count : counted_) {
    const auto found = places_.counts_.find(count);
    if (--found->second == 0) places_.counts_.erase(found);
  }
  counted_.clear();
  --places_.served_;
}

}  // namespace rave::web
