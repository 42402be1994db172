// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "page/people_message.hpp"
#include "page/probe_message.hpp"
#include "rave/base/result.hpp"
#include "rave/base/word_table.hpp"
#include "rave/gui_server/conductor.hpp"
#include "rave/gui_server/rights.hpp"
#include "rave/gui_server/source.hpp"

// What a page says; schemas/gui/messages.schema.json describes it. Nothing of it is trusted.
namespace rave::gui_server {

struct LookMessage {
  bool poses = false;
  bool true_poses = false;
  bool parts = false;
  double max_hz = 30;
  std::vector<LookedAt> readings;  ///< At most 256, without repetitions.
  /// Those of a replay whose readings before the moment are shown, too; as `readings`.
  std::vector<LookedAt> courses;
  /// Robots whose variances are shown; at most 256, sorted, without repetitions.
  std::vector<std::uint32_t> variances;
};

/// Which maps a page shows at present: instead of those of before.
struct LookMapsMessage {
  /// By slot or by the name of a global map; at most kMostLookedAtMaps, without repetitions.
  std::vector<MapName> maps;
};
inline constexpr std::size_t kMostLookedAtMaps = 4;

struct AckMessage {
  std::uint32_t sequence = 0;
};

/// A super-user changes rights.
struct SetRightMessage {
  RightChange change;
};

/// A super-user sees what another user gets.
struct SeeAsMessage {
  std::optional<Role> role{};
  std::string user{};  ///< Both empty: with their own eyes again.
};

/// Which page it is, by the public key that its tickets have: what it does over direct lines and
/// through the server is of one page.
struct PageKeyMessage {
  std::string key;  ///< 65 bytes.
};

/// A person sends a text to people, or to robots and the people who see them.
struct ChatMessage {
  enum class To : std::uint8_t { kAll, kRole, kUser, kTeam, kRobot } to = To::kAll;
  std::string name;        ///< Of the role, the user or the team.
  std::uint32_t slot = 0;  ///< Of the robot.
  std::string text;        ///< 1 to direct_line::kLongestText bytes.
  std::uint32_t request = 0;
};
inline constexpr WordTable<ChatMessage::To, 5> kChatTo = {{{"all", ChatMessage::To::kAll},
                                                           {"role", ChatMessage::To::kRole},
                                                           {"user", ChatMessage::To::kUser},
                                                           {"team", ChatMessage::To::kTeam},
                                                           {"robot", ChatMessage::To::kRobot}}};

using PageMessage =
    std::variant<LookMessage, AckMessage, TransportMessage, HaltMessage, SetRightMessage,
                 SeeAsMessage, CommandMessage, ChatMessage, PeopleMessage, LookMapsMessage,
                 LookProbesMessage, AskCatalogueMessage, PageKeyMessage, ConductMessage>;

/// Errors: kParse with what was expected.
[[nodiscard]] Result<PageMessage> parse_page_message(std::string_view text);

}  // namespace rave::gui_server
