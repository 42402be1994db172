// SPDX-License-Identifier: Apache-2.0
#include "foxglove/foxglove_guests.hpp"

#include "people/secrets.hpp"

namespace rave::gui_server {
namespace {

constexpr std::uint16_t kGuestSignedOut = 4401;

}  // namespace

FoxgloveGuests::FoxgloveGuests(Door& door, Visitors& visitors)
    : door_(door), visitors_(visitors), server_(new_secret()) {}

void FoxgloveGuests::show_to(Guest& guest, const Person& person) {
  guest.view = visitors_.view_of(person);
  if (guest.view) guest.client->show(visitors_.source_for(guest.view));
}

void FoxgloveGuests::show() {
  for (auto& [id, guest] : guests_) {
    if (const auto person = door_.whose(guest.session)) show_to(guest, *person);
  }
}

void FoxgloveGuests::opened(std::uint64_t id, web::Socket& socket, const std::string& session) {
  const auto person = door_.whose(session);
  if (!person) return socket.close(kGuestSignedOut, "You are signed out");
  Guest guest;
  guest.socket = &socket;
  guest.session = session;
  guest.client = std::make_unique<FoxgloveSession>(socket, server_);
  show_to(guests_.emplace(id, std::move(guest)).first->second, *person);
}

void FoxgloveGuests::received(std::uint64_t id, std::string_view text) {
  guests_.at(id).client->received(text);
}

std::string FoxgloveGuests::user_of(std::uint64_t id) const {
  const auto person = door_.whose(guests_.at(id).session);
  return person ? person->name : "";
}

void FoxgloveGuests::received_binary(std::uint64_t id) { guests_.at(id).client->received_binary(); }

Audience FoxgloveGuests::audience() const {
  Audience audience;
  for (const auto& [id, guest] : guests_) {
    if (guest.client->wants_poses()) audience.max_hz = FoxgloveSession::kMaxHz;
    for (const LookedAt& looked : guest.client->looked_at()) {
      // What is withheld is not even gathered.
      const auto robot = guest.view->robot_of(looked.slot);
      if (robot && guest.view->may(InfoClass::kReadings, *robot)) {
        audience.looked_at.push_back({*robot, looked.sensor});
      }
    }
  }
  return audience;
}

void FoxgloveGuests::tick() {
  const auto now = FoxgloveSession::Clock::now();
  FoxgloveFrames frames;
  for (auto& [id, guest] : guests_) guest.client->tick(now, frames);
}

void FoxgloveGuests::check() {
  for (auto& [id, guest] : guests_) {
    const auto person = door_.whose(guest.session);
    if (!person) {
      guest.socket->close(kGuestSignedOut, "You are signed out");
      continue;
    }
    const auto view = visitors_.view_of(*person);
    if (view && (!guest.view || view->key() != guest.view->key())) show_to(guest, *person);
  }
}

}  // namespace rave::gui_server
