// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rave/gui_server/person.hpp"
#include "rave/gui_server/source.hpp"
#include "rave/web/server.hpp"

// What the server says to a page, as JSON; schemas/gui/messages.schema.json describes it.
namespace rave::gui_server {

/// The words for what the time of a run does, in all protocols.
inline constexpr WordTable<PlayState::Kind, 4> kStateWords = {
    {{"running", PlayState::Kind::kRunning},
     {"paused", PlayState::Kind::kPaused},
     {"waiting", PlayState::Kind::kWaiting},
     {"ended", PlayState::Kind::kEnded}}};

/// As whom a page is greeted.
struct Greeting {
  Person user;
  std::optional<Person> seen_by{};  ///< The super-user who sees what `user` gets.
  Author author{};                  ///< As whom the run knows who looks.
  bool foxglove = false;            ///< `/foxglove` gives addresses for Foxglove clients.
  bool conducts = false;            ///< The user may start and end runs here.
};

/// What became of a request of a page.
struct PageAnswer {
  std::string to;  ///< The `type`, `do` or `kind` of the request.
  bool good = false;
  std::string text;
  std::optional<std::uint32_t> request{};  ///< The number that the page gave it.
  /// Of several robots: those that refused, and why.
  std::vector<std::pair<std::uint32_t, std::string>> refused{};
};

[[nodiscard]] inline web::Payload payload(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

[[nodiscard]] std::string hello_text(const Source& source, const Greeting& greeting);
/// Events from `first` on; with 0 the page forgets those that it had.
[[nodiscard]] std::string events_text(std::span<const LogEvent> events, std::size_t first);
[[nodiscard]] std::string time_text(const PlayState& state, const RunAbout& about);
/// Who drives what; `me` marks those that this page drives.
[[nodiscard]] std::string leases_text(std::span<const DriveState> states, const Author& me,
                                      bool all);
/// Which maps the page can look at.
[[nodiscard]] std::string maps_text(std::span<const MapName> names);
/// What a page sent may stand in the text; what is no UTF-8 is replaced.
/// What became of a probe that a page requested.
struct ProbeAnswer {
  std::uint32_t slot = 0;  ///< Of the page.
  std::string error;       ///< For people; empty: it was made.
  ProbeMade made;
};
[[nodiscard]] std::string probes_text(std::uint32_t request, std::span<const ProbeAnswer> answers);
[[nodiscard]] std::string answer_text(const PageAnswer& answer);

}  // namespace rave::gui_server
