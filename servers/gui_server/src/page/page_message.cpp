// SPDX-License-Identifier: Apache-2.0
#include "page/page_message.hpp"

#include <algorithm>

#include "page/command_message.hpp"
#include "page/conduct_message.hpp"
#include "page/members.hpp"
#include "rave/base/number.hpp"
#include "rave/direct_line/order_members.hpp"
#include "rave/direct_line/ticket.hpp"

namespace rave::gui_server {
namespace {

// Bounds on what a page may ask for, so that no message keeps the server busy.
constexpr std::size_t kMostSensors = 256;
constexpr std::size_t kMostSlots = 100'000;
constexpr std::size_t kLongestName = 64;
constexpr std::size_t kMostTeams = 1000;

using TransportDo = TransportMessage::Do;
constexpr WordTable<TransportDo, 5> kTransportWords = {{{"play", TransportDo::kPlay},
                                                        {"pause", TransportDo::kPause},
                                                        {"step", TransportDo::kStep},
                                                        {"seek", TransportDo::kSeek},
                                                        {"pace", TransportDo::kPace}}};
/// Whether the robots stop.
constexpr WordTable<bool, 2> kHaltWords = {{{"stop", true}, {"release", false}}};

/// What is named twice would be sent twice, and sources expect each list sorted.
template <class Value>
std::vector<Value> sorted_once(std::vector<Value> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

Result<LookedAt> looked_at(const PageJson& pair, const char* name) {
  if (!pair.is_array() || pair.size() != 2) {
    return fail(ErrorCode::kParse, "`{}`: expected pairs of slot and sensor", name);
  }
  LookedAt looked;
  RAVE_TRY_ASSIGN(looked.slot, Members::index_of(pair[0], name));
  RAVE_TRY_ASSIGN(looked.sensor, Members::index_of(pair[1], name));
  return looked;
}

Result<LookMessage> look_of(Members& members) {
  LookMessage look;
  RAVE_TRY_ASSIGN(look.poses, members.flag("poses"));
  RAVE_TRY_ASSIGN(look.true_poses, members.flag("true_poses"));
  RAVE_TRY_ASSIGN(look.parts, members.flag("parts"));
  RAVE_TRY_ASSIGN(look.max_hz, members.number_in("max_hz", 1, 60));
  RAVE_TRY_ASSIGN(look.readings, members.list("readings", kMostSensors, looked_at));
  if (members.has("courses")) {
    RAVE_TRY_ASSIGN(look.courses, members.list("courses", kMostSensors, looked_at));
  }
  if (members.has("variances")) {
    RAVE_TRY_ASSIGN(look.variances, members.list("variances", kMostSensors, Members::index_of));
  }
  look.readings = sorted_once(std::move(look.readings));
  look.courses = sorted_once(std::move(look.courses));
  look.variances = sorted_once(std::move(look.variances));
  return look;
}

/// A number is the slot of a robot, whose local map is meant; a text names a global map.
Result<MapName> map_named(const PageJson& json, const char* name) {
  MapName map;
  if (json.is_string()) {
    map.name = json.get<std::string>();
    if (!map.name.empty() && map.name.size() <= kLongestName) return map;
    return fail(ErrorCode::kParse, "`{}`: expected names of 1 to {} bytes", name, kLongestName);
  }
  RAVE_TRY_ASSIGN(map.slot, Members::index_of(json, name));
  // The largest number is the slot that stands for a global map inside the server.
  if (map.global()) return fail(ErrorCode::kParse, "`{}`: there is no such slot", name);
  return map;
}

Result<LookMapsMessage> look_maps_of(Members& members) {
  RAVE_TRY_ASSIGN(auto maps, members.list("maps", kMostLookedAtMaps, map_named));
  return LookMapsMessage{sorted_once(std::move(maps))};
}

Result<TransportMessage> transport_of(Members& members) {
  TransportMessage transport;
  RAVE_TRY_ASSIGN(transport.what, members.choice("do", kTransportWords));
  const bool takes_value =
      transport.what != TransportDo::kPlay && transport.what != TransportDo::kPause;
  // A value that is not needed is taken, too: finish() would refuse the message otherwise.
  if (takes_value || members.has("value")) {
    RAVE_TRY_ASSIGN(transport.value, members.number("value"));
  }
  return transport;
}

Result<HaltMessage> halt_of(Members& members) {
  HaltMessage halt;
  RAVE_TRY_ASSIGN(halt.stop, members.choice("do", kHaltWords));
  // Slots that do not exist are not an error here. Whether a robot exists, and whether this user
  // may stop it, only the source knows; an empty list means all robots.
  RAVE_TRY_ASSIGN(halt.slots, members.list("slots", kMostSlots, Members::index_of));
  return halt;
}

/// `role` or `user`; with neither both stay empty.
Status whose(Members& members, std::optional<Role>& role, std::string& user) {
  if (members.has("role")) {
    RAVE_TRY_ASSIGN(role, members.choice("role", kRoles));
  }
  if (members.has("user")) {
    RAVE_TRY_ASSIGN(user, members.word("user"));
    if (user.empty() || user.size() > kLongestName) {
      return fail(ErrorCode::kParse, "`user`: expected a name");
    }
  }
  // With both, it would be unclear whose row of the table of rights changes.
  if (role && !user.empty()) return fail(ErrorCode::kParse, "expected `role` or `user`, not both");
  return {};
}

Result<std::optional<Reach>> reach_in(const PageJson& value) {
  // null takes the change back: the default of the scenario or the role counts again.
  if (value.is_null()) return std::optional<Reach>();
  Reach reach;
  if (value.is_array() && value.size() <= kMostTeams) {
    reach.kind = Reach::Kind::kTeams;
    for (const PageJson& team : value) {
      if (!team.is_string() || team.get_ref<const std::string&>().size() > kLongestName) {
        return fail(ErrorCode::kParse, "`reach`: expected names of teams");
      }
      reach.teams.insert(team.get<std::string>());
    }
    return std::optional<Reach>(std::move(reach));
  }
  const auto kind = value.is_string() ? kReaches.find(value.get_ref<const std::string&>())
                                      : std::optional<Reach::Kind>();
  if (kind) return std::optional<Reach>(Reach{*kind, {}});
  return fail(ErrorCode::kParse, "`reach`: expected none, own, all, an array of teams, or null");
}

Result<SetRightMessage> right_of(Members& members) {
  SetRightMessage set;
  RAVE_TRY(whose(members, set.change.role, set.change.user));
  if (!set.change.role && set.change.user.empty()) {
    return fail(ErrorCode::kParse, "`role` or `user` is missing");
  }
  RAVE_TRY_ASSIGN(const std::string word, members.word("class"));
  const auto what = class_named(word);
  if (!what) return fail(ErrorCode::kParse, "`class`: expected one of the message `rights`");
  set.change.what = *what;
  RAVE_TRY_ASSIGN(const PageJson* const reach, members.any("reach"));
  RAVE_TRY_ASSIGN(set.change.reach, reach_in(*reach));
  return set;
}

Result<SeeAsMessage> eyes_of(Members& members) {
  SeeAsMessage see;
  RAVE_TRY(whose(members, see.role, see.user));
  return see;
}

Result<ChatMessage> chat_of(Members& members) {
  using To = ChatMessage::To;
  ChatMessage chat;
  RAVE_TRY_ASSIGN(chat.request, members.index("request"));
  RAVE_TRY_ASSIGN(chat.text, members.text("text", direct_line::kLongestText, true));
  // A line of blanks would appear in the chat as a name without words.
  if (chat.text.find_first_not_of(" \n") == std::string::npos) {
    return fail(ErrorCode::kParse, "`text`: expected a text that is not empty");
  }
  RAVE_TRY_ASSIGN(chat.to, members.choice("to", kChatTo));
  if (chat.to == To::kRobot) {
    RAVE_TRY_ASSIGN(chat.slot, members.index("slot"));
  } else if (chat.to == To::kRole) {
    // Roles are fixed, so a wrong one is a malformed message. Users and teams come and go; whether
    // they exist is checked later, and a wrong one does not count as malformed.
    RAVE_TRY_ASSIGN(const Role role, members.choice("name", kRoles));
    chat.name = to_string(role);
  } else if (chat.to != To::kAll) {
    RAVE_TRY_ASSIGN(chat.name, members.text("name", kLongestName));
  }
  return chat;
}

Result<PageKeyMessage> page_key_message_of(Members& members) {
  RAVE_TRY_ASSIGN(const std::string text, members.word("key"));
  RAVE_TRY_ASSIGN(std::string key, direct_line::page_key_of(text));
  return PageKeyMessage{std::move(key)};
}

Result<AckMessage> ack_of(Members& members) {
  RAVE_TRY_ASSIGN(const std::uint32_t sequence, members.index("sequence"));
  return AckMessage{sequence};
}

Result<AskCatalogueMessage> ask_catalogue_of(Members& members) {
  RAVE_TRY_ASSIGN(const std::uint32_t request, members.index("request"));
  return AskCatalogueMessage{request};
}

Result<PageMessage> message_of(std::string_view type, Members& members) {
  if (type == "look") return look_of(members);
  if (type == "look_maps") return look_maps_of(members);
  if (type == "look_probes") return look_probes_of(members);
  if (type == "ask_catalogue") return ask_catalogue_of(members);
  if (type == "page") return page_key_message_of(members);
  if (type == "ack") return ack_of(members);
  if (type == "transport") return transport_of(members);
  if (type == "halt") return halt_of(members);
  if (type == "set_right") return right_of(members);
  if (type == "see_as") return eyes_of(members);
  if (type == "say") return chat_of(members);
  // These return nothing for types that are not theirs, so each module knows its own types.
  if (auto command = command_of(type, members)) return *std::move(command);
  if (auto people = people_message_of(type, members)) return *std::move(people);
  if (auto conduct = conduct_message_of(type, members)) return *std::move(conduct);
  return fail(ErrorCode::kParse, "unknown type of message");
}

/// An acknowledgement as pages write it. Nearly all messages are such; other forms of the same JSON
/// are read as all else is.
std::optional<AckMessage> plain_ack(std::string_view text) {
  constexpr std::string_view kBegin = R"({"type":"ack","sequence":)";
  if (!text.starts_with(kBegin) || !text.ends_with('}')) return std::nullopt;
  text.remove_prefix(kBegin.size());
  text.remove_suffix(1);
  const auto sequence = number_of<std::uint32_t>(text);
  // JSON has no number with a zero before it.
  if (!sequence || (text.front() == '0' && text.size() > 1)) return std::nullopt;
  return AckMessage{*sequence};
}

}  // namespace

Result<PageMessage> parse_page_message(std::string_view text) {
  if (const auto ack = plain_ack(text)) return *ack;
  // Without exceptions: a text that is not JSON, or a number that overflows, gives a discarded
  // value, which is not an object.
  const PageJson json = PageJson::parse(text, nullptr, false);
  if (!json.is_object()) return fail(ErrorCode::kParse, "expected a JSON object");
  Members members(json);
  RAVE_TRY_ASSIGN(const std::string type, members.word("type"));
  RAVE_TRY_ASSIGN(PageMessage message, message_of(type, members));
  // A misspelt member would otherwise be ignored, and its default taken.
  RAVE_TRY(members.finish());
  return message;
}

}  // namespace rave::gui_server
