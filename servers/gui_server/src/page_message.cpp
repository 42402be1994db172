// SPDX-License-Identifier: Apache-2.0
#include "page_message.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "command_message.hpp"
#include "members.hpp"
#include "rave/base/names.hpp"
#include "ticket_request.hpp"

namespace rave::gui_server {
namespace {

// Bounds on what a page may ask for, so that no message keeps the server busy.
constexpr std::size_t kMostSensors = 256;
constexpr std::size_t kMostSlots = 100'000;
constexpr std::size_t kLongestName = 64;

Result<std::vector<LookedAt>> sensors_of(Members& members, const char* name) {
  RAVE_TRY_ASSIGN(const PageJson* const pairs, members.array(name, kMostSensors));
  std::vector<LookedAt> sensors;
  for (const PageJson& pair : *pairs) {
    if (!pair.is_array() || pair.size() != 2) {
      return fail(ErrorCode::kParse, "`{}`: expected pairs of slot and sensor", name);
    }
    LookedAt looked;
    RAVE_TRY_ASSIGN(looked.slot, Members::index_of(pair[0], name));
    RAVE_TRY_ASSIGN(looked.sensor, Members::index_of(pair[1], name));
    sensors.push_back(looked);
  }
  // A sensor that is named twice would be sent twice, and sources expect each list sorted.
  std::sort(sensors.begin(), sensors.end());
  sensors.erase(std::unique(sensors.begin(), sensors.end()), sensors.end());
  return sensors;
}

Result<PageMessage> look_of(Members& members) {
  LookMessage look;
  RAVE_TRY_ASSIGN(look.poses, members.flag("poses"));
  RAVE_TRY_ASSIGN(look.true_poses, members.flag("true_poses"));
  RAVE_TRY_ASSIGN(look.parts, members.flag("parts"));
  RAVE_TRY_ASSIGN(look.max_hz, members.number("max_hz"));
  if (look.max_hz < 1 || look.max_hz > 60) {
    return fail(ErrorCode::kParse, "`max_hz`: expected 1 to 60");
  }
  RAVE_TRY_ASSIGN(look.readings, sensors_of(members, "readings"));
  if (members.has("courses")) {
    RAVE_TRY_ASSIGN(look.courses, sensors_of(members, "courses"));
  }
  if (members.has("variances")) {
    RAVE_TRY_ASSIGN(const PageJson* const slots, members.array("variances", kMostSensors));
    for (const PageJson& slot : *slots) {
      RAVE_TRY_ASSIGN(const std::uint32_t robot, Members::index_of(slot, "variances"));
      look.variances.push_back(robot);
    }
    std::sort(look.variances.begin(), look.variances.end());
    look.variances.erase(std::unique(look.variances.begin(), look.variances.end()),
                         look.variances.end());
  }
  return PageMessage(std::move(look));
}

Result<PageMessage> look_maps_of(Members& members) {
  LookMapsMessage look;
  RAVE_TRY_ASSIGN(const PageJson* const maps, members.array("maps", kMostLookedAtMaps));
  for (const PageJson& map : *maps) {
    MapName name;
    // A number is the slot of a robot, whose local map is meant; a text names a global map.
    if (map.is_string()) {
      name.name = map.get<std::string>();
      if (name.name.empty() || name.name.size() > kLongestName) {
        return fail(ErrorCode::kParse, "`maps`: expected names of 1 to {} bytes", kLongestName);
      }
    } else {
      RAVE_TRY_ASSIGN(name.slot, Members::index_of(map, "maps"));
      // The largest number is the slot that stands for a global map inside the server.
      if (name.global()) return fail(ErrorCode::kParse, "`maps`: there is no such slot");
    }
    look.maps.push_back(std::move(name));
  }
  std::sort(look.maps.begin(), look.maps.end());
  look.maps.erase(std::unique(look.maps.begin(), look.maps.end()), look.maps.end());
  return PageMessage(std::move(look));
}

Result<PageMessage> transport_of(Members& members) {
  using Do = TransportMessage::Do;
  static constexpr std::array<std::pair<std::string_view, Do>, 5> kWords = {{{"play", Do::kPlay},
                                                                             {"pause", Do::kPause},
                                                                             {"step", Do::kStep},
                                                                             {"seek", Do::kSeek},
                                                                             {"pace", Do::kPace}}};
  RAVE_TRY_ASSIGN(const std::string word, members.word("do"));
  const auto found = std::find_if(kWords.begin(), kWords.end(),
                                  [&word](const auto& entry) { return entry.first == word; });
  if (found == kWords.end()) {
    return fail(ErrorCode::kParse, "`do`: expected play, pause, step, seek or pace");
  }
  TransportMessage transport;
  transport.what = found->second;
  const bool takes_value = transport.what != Do::kPlay && transport.what != Do::kPause;
  // A value that is not needed is taken, too: finish() would refuse the message otherwise.
  if (takes_value || members.has("value")) {
    RAVE_TRY_ASSIGN(transport.value, members.number("value"));
  }
  return PageMessage(transport);
}

Result<PageMessage> halt_of(Members& members) {
  HaltMessage halt;
  RAVE_TRY_ASSIGN(const std::string word, members.word("do"));
  if (word != "stop" && word != "release") {
    return fail(ErrorCode::kParse, "`do`: expected stop or release");
  }
  halt.stop = word == "stop";
  // Slots that do not exist are not an error here. Whether a robot exists, and whether this user
  // may stop it, only the source knows; an empty list means all robots.
  RAVE_TRY_ASSIGN(const PageJson* const slots, members.array("slots", kMostSlots));
  for (const PageJson& slot : *slots) {
    RAVE_TRY_ASSIGN(const std::uint32_t index, Members::index_of(slot, "slots"));
    halt.slots.push_back(index);
  }
  return PageMessage(std::move(halt));
}

constexpr std::size_t kMostTeams = 1000;

/// `role` or `user`; with neither both stay empty.
Status whose(Members& members, std::optional<Role>& role, std::string& user) {
  if (members.has("role")) {
    RAVE_TRY_ASSIGN(const std::string word, members.word("role"));
    role = kRoles.find(word);
    if (!role) return fail(ErrorCode::kParse, "`role`: expected observer, commander or super_user");
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

Result<PageMessage> right_of(Members& members) {
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
  return PageMessage(std::move(set));
}

Result<PageMessage> eyes_of(Members& members) {
  SeeAsMessage see;
  RAVE_TRY(whose(members, see.role, see.user));
  return PageMessage(std::move(see));
}

Result<PageMessage> chat_of(Members& members) {
  using To = ChatMessage::To;
  ChatMessage chat;
  RAVE_TRY_ASSIGN(chat.request, members.index("request"));
  RAVE_TRY_ASSIGN(chat.text, members.text("text", kLongestText, true));
  // A line of blanks would appear in the chat as a name without words.
  if (chat.text.find_first_not_of(" \n") == std::string::npos) {
    return fail(ErrorCode::kParse, "`text`: expected a text that is not empty");
  }
  RAVE_TRY_ASSIGN(const std::string to, members.word("to"));
  if (to == "all") {
    chat.to = To::kAll;
    return PageMessage(std::move(chat));
  }
  if (to == "robot") {
    chat.to = To::kRobot;
    RAVE_TRY_ASSIGN(chat.slot, members.index("slot"));
    return PageMessage(std::move(chat));
  }
  if (to != "role" && to != "user" && to != "team") {
    return fail(ErrorCode::kParse, "`to`: expected all, role, user, team or robot");
  }
  chat.to = to == "role" ? To::kRole : (to == "user" ? To::kUser : To::kTeam);
  RAVE_TRY_ASSIGN(chat.name, members.text("name", kLongestName));
  // Roles are fixed, so a wrong one is a malformed message. Users and teams come and go; whether
  // they exist is checked later, and a wrong one does not count as malformed.
  if (chat.to == To::kRole && !kRoles.find(chat.name)) {
    return fail(ErrorCode::kParse, "`name`: expected observer, commander or super_user");
  }
  return PageMessage(std::move(chat));
}

Result<PageMessage> page_key_message_of(Members& members) {
  RAVE_TRY_ASSIGN(const std::string text, members.word("key"));
  RAVE_TRY_ASSIGN(std::string key, page_key_of(text));
  return PageMessage(PageKeyMessage{std::move(key)});
}

}  // namespace

Result<PageMessage> parse_page_message(std::string_view text) {
  // Without exceptions: a text that is not JSON, or a number that overflows, gives a discarded
  // value, which is not an object.
  const PageJson json = PageJson::parse(text, nullptr, false);
  if (!json.is_object()) return fail(ErrorCode::kParse, "expected a JSON object");
  Members members(json);
  RAVE_TRY_ASSIGN(const std::string type, members.word("type"));
  Result<PageMessage> message = fail(ErrorCode::kParse, "unknown type of message");
  if (type == "look") {
    message = look_of(members);
  } else if (type == "look_maps") {
    message = look_maps_of(members);
  } else if (type == "look_probes") {
    auto look = look_probes_of(members);
    if (!look) return tl::unexpected(look.error());
    message = PageMessage(*std::move(look));
  } else if (type == "ask_catalogue") {
    auto request = members.index("request");
    if (!request) return tl::unexpected(request.error());
    message = PageMessage(AskCatalogueMessage{*request});
  } else if (type == "page") {
    message = page_key_message_of(members);
  } else if (type == "ack") {
    auto sequence = members.index("sequence");
    if (!sequence) return tl::unexpected(sequence.error());
    message = PageMessage(AckMessage{*sequence});
  } else if (type == "transport") {
    message = transport_of(members);
  } else if (type == "halt") {
    message = halt_of(members);
  } else if (type == "set_right") {
    message = right_of(members);
  } else if (type == "see_as") {
    message = eyes_of(members);
  } else if (type == "say") {
    message = chat_of(members);
    // The last two return nothing for types that are not theirs, so each module knows its own
    // types.
  } else if (auto command = command_of(type, members)) {
    if (!*command) return tl::unexpected(command->error());
    message = PageMessage(**std::move(command));
  } else if (auto people = people_message_of(type, members)) {
    if (!*people) return tl::unexpected(people->error());
    message = PageMessage(**std::move(people));
  }
  if (!message) return message;
  // A misspelt member would otherwise be ignored, and its default taken.
  RAVE_TRY(members.finish());
  return message;
}

}  // namespace rave::gui_server
