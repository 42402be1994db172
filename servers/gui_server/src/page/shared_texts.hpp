// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "rave/gui_server/source.hpp"
#include "rave/web/server.hpp"

namespace rave::gui_server {

/// The large messages that open a page: scene, roster and log. All pages with the same source, so
/// with the same rights, get the same bytes: each message exists once, as long as it is on its way
/// to a page. The thread of the server.
class SharedTexts {
 public:
  [[nodiscard]] web::Payload scene(const std::shared_ptr<Source>& source);
  [[nodiscard]] web::Payload roster(const std::shared_ptr<Source>& source);
  /// All events so far.
  [[nodiscard]] web::Payload events(const std::shared_ptr<Source>& source);

 private:
  struct Text {
    std::weak_ptr<const std::string> payload;
    std::uint64_t revision = 0;
  };
  struct Texts {
    Text scene, roster, events;
  };
  /// By owner, not by address: another source could come to lie where one with other rights was.
  using BySource = std::map<std::weak_ptr<Source>, Texts, std::owner_less<>>;

  [[nodiscard]] Texts& of(const std::shared_ptr<Source>& source);

  BySource texts_;
};

}  // namespace rave::gui_server
