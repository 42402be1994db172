// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "rave/web/server.hpp"

// Who has how many connections. No visitor who has many can keep others out: see each class. The
// thread of the server.
namespace rave::web {

/// An open resource that the server closes when it ends.
class Link {
 public:
  virtual ~Link() = default;
  /// Closes it at once, without a handshake.
  virtual void cut() = 0;
};

/// The HTTP connections. A newcomer always gets a place, since only its request tells whose it is:
/// if all are taken, the oldest connection of who has the most is cut.
class ConnectionPlaces {
 public:
  ConnectionPlaces(std::size_t most, std::size_t most_per_session)
      : most_(most), most_per_session_(most_per_session) {}

  /// `link` must be removed before it is destroyed.
  void add(Link& link, const std::string& address);
  void remove(const Link& link);
  /// A request came over it.
  void name(const Link& link, const Caller& caller);
  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  [[nodiscard]] std::vector<Link*> all() const;

 private:
  struct Entry {
    Link* link = nullptr;
    std::string holder;  ///< A session, or an address.
    Caller::Rank rank = Caller::Rank::kAnyone;
  };
  /// The oldest connection of a holder.
  void cut_one_of(const std::string& holder);
  [[nodiscard]] std::size_t count_of(const std::string& holder) const;

  std::size_t most_;
  std::size_t most_per_session_;
  std::list<Entry> entries_;  ///< Oldest first; without those that are being cut.
};

/// The WebSockets: numbers by session, user, address and network, and a reserve for who is needed
/// in an emergency. Limits by address and network do not hold for this machine, where all share
/// one.
class SocketPlaces {
 public:
  explicit SocketPlaces(const ServerOptions& options) : options_(options) {}

  /// Why there is no room for another one; empty: there is.
  [[nodiscard]] std::string_view refusal(const Caller& caller, const std::string& address) const;

  /// One place; given back when it is destroyed.
  class Place {
   public:
    Place(SocketPlaces& places, const Caller& caller, const std::string& address);
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;
    ~Place();
    /// The socket is being closed, and takes no place any more of those that are served. False: too
    /// many are being closed already.
    [[nodiscard]] bool leave();

   private:
    void give_back();
    SocketPlaces& places_;
    std::vector<std::string> counted_;  ///< The counts in which it is.
    bool leaves_ = false;
  };

 private:
  static constexpr std::size_t kMostLeaving = 64;

  [[nodiscard]] bool full(const std::string& count, std::size_t most) const;

  ServerOptions options_;
  std::map<std::string, std::size_t, std::less<>> counts_;
  std::size_t served_ = 0;
  std::size_t leaving_ = 0;
};

}  // namespace rave::web
