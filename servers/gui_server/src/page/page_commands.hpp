// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "page/page_text.hpp"
#include "rave/web/rate_limit.hpp"

namespace rave::gui_server {

/// What one page asks of robots and obstacles: not more than a run can serve, with one answer for
/// each message, and neither a velocity nor a lease outlives the page. The thread of the server.
class PageCommands {
 public:
  /// Robots that may be commanded at once, and in a second: 20 robots at 30 Hz, or 2000 at once.
  static constexpr double kBurst = 2000;
  static constexpr double kPerSecond = 600;
  /// Velocities that wait for the run; of more only the newest counts.
  static constexpr int kMostWaiting = 4;

  using Say = std::function<void(const PageAnswer&)>;
  /// Told of each answer but that of a velocity that was taken.
  using Told = std::function<void(const CommandMessage&, const PageAnswer&)>;
  /// Whether the person to whom a lease is given can use it. Error: who else could.
  using MayGive = std::function<Status(const CommandMessage&)>;
  PageCommands(Say say, Told told, MayGive may_give = {});

  /// From now on commands go there; what was driven elsewhere stands. Null: nowhere.
  void begin(std::shared_ptr<Source> source, Author author);
  void set_author(Author author);
  [[nodiscard]] const Author& author() const noexcept { return author_; }
  void take(const CommandMessage& command);
  /// The page has gone: what it drives stands, and what it has ordered is left.
  void let_go();
  /// What the page has ordered is any page's of the same person from now on, so one that is loaded
  /// anew need not take anything from itself. The leases that the run publishes do not suffice for
  /// that: it may be older than the last order.
  void leave();

 private:
  struct Open;
  void post(const CommandMessage& command);
  void remember(const CommandMessage& command);
  void finish(const Open& open);
  [[nodiscard]] bool too_many(const CommandMessage& command);

  Say say_;
  Told told_;
  MayGive may_give_;
  std::shared_ptr<Source> source_;
  Author author_;
  web::RateLimit limit_{kPerSecond, kBurst};
  /// Slots that were given a velocity last, and when.
  std::map<std::uint32_t, web::RateLimit::Clock::time_point> driven_;
  std::set<std::uint32_t> ordered_;  ///< Slots whose lease this page may have.
  int waiting_ = 0;
  std::optional<CommandMessage> newest_;  ///< A velocity that was held back.
  std::shared_ptr<const bool> alive_ =
      std::make_shared<bool>(true);  ///< For answers that come late.
};

}  // namespace rave::gui_server
