// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "foxglove/foxglove_session.hpp"
#include "people/door.hpp"
#include "visitors/visitors.hpp"

namespace rave::gui_server {

/// All Foxglove clients that are connected, each with what its user gets of the run. The thread of
/// the server.
class FoxgloveGuests {
 public:
  /// Both outlive it.
  FoxgloveGuests(Door& door, Visitors& visitors);

  /// The visitors see another run now.
  void show();
  /// A client came with a token for this session.
  void opened(std::uint64_t id, web::Socket& socket, const std::string& session);
  [[nodiscard]] bool has(std::uint64_t id) const { return guests_.contains(id); }
  void received(std::uint64_t id, std::string_view text);
  void received_binary(std::uint64_t id);
  /// The name of the user whose client this is; empty: signed out.
  [[nodiscard]] std::string user_of(std::uint64_t id) const;
  void closed(std::uint64_t id) { guests_.erase(id); }
  /// What they look at, for the source.
  [[nodiscard]] Audience audience() const;
  /// After the source had its tick.
  void tick();
  /// Once a second: who is signed out is out, who has other rights gets what these allow.
  void check();
  [[nodiscard]] std::size_t count() const noexcept { return guests_.size(); }

 private:
  struct Guest {
    web::Socket* socket = nullptr;
    std::string session;  ///< The secret; to ask whether it still holds.
    std::shared_ptr<const View> view;
    std::unique_ptr<FoxgloveSession> client;
  };
  void show_to(Guest& guest, const Person& person);

  Door& door_;
  Visitors& visitors_;
  std::string server_;  ///< By which a client tells this server from one that was started later.
  std::map<std::uint64_t, Guest> guests_;
};

}  // namespace rave::gui_server
