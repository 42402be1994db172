// SPDX-License-Identifier: Apache-2.0
#include "page/conduct_message.hpp"

#include "rave/base/word_table.hpp"

namespace rave::gui_server {
namespace {

using ConductDo = ConductMessage::Do;
constexpr WordTable<ConductDo, 5> kConductWords = {{{"start", ConductDo::kStart},
                                                    {"end", ConductDo::kEnd},
                                                    {"restart", ConductDo::kRestart},
                                                    {"open", ConductDo::kOpen},
                                                    {"close", ConductDo::kClose}}};
constexpr std::size_t kLongestConducted = 200;

Result<ConductMessage> read(Members& members) {
  ConductMessage message;
  RAVE_TRY_ASSIGN(message.request, members.index("request"));
  RAVE_TRY_ASSIGN(message.what, members.choice("do", kConductWords));
  // The other actions take neither, and finish() refuses a message that has them.
  const bool starts = message.what == ConductDo::kStart;
  if (starts || message.what == ConductDo::kOpen) {
    RAVE_TRY_ASSIGN(message.name, members.text("name", kLongestConducted));
  }
  if ((starts || message.what == ConductDo::kRestart) && members.has("seed")) {
    RAVE_TRY_ASSIGN(message.seed, members.index("seed"));
  }
  return message;
}

}  // namespace

std::string_view word_of(ConductMessage::Do what) noexcept { return kConductWords.of(what); }

std::optional<Result<ConductMessage>> conduct_message_of(std::string_view type, Members& members) {
  if (type == "conduct") return read(members);
  return std::nullopt;
}

}  // namespace rave::gui_server
