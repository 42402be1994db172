// SPDX-License-Identifier: Apache-2.0
#include "rave/control/chat_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "rave/base/number.hpp"
#include "rave/robot/order.hpp"

namespace rave::runtime {
namespace {

constexpr std::array<std::string_view, 3> kRoles = {"observer", "commander", "super_user"};
constexpr std::array<std::string_view, 5> kAddressees = {"all", "role", "user", "team", "robot"};

template <std::size_t kWords>
bool is_one_of(std::string_view word, const std::array<std::string_view, kWords>& words) {
  return std::ranges::find(words, word) != words.end();
}

/// Removes the word up to the next space, and that space, from `text` and returns the word.
std::string_view take_word(std::string_view& text) {
  const std::size_t end = std::min(text.find(' '), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return word;
}

tl::unexpected<Error> no_line(std::string_view what) {
  return fail(ErrorCode::kInvalidArgument, "not a chat message: {}", what);
}

}  // namespace

RunRequest chat_request(const ChatLine& line) {
  RunRequest request;
  request.kind = RunRequest::Kind::kChat;
  request.key = fmt::format("{} {} {}", line.number, line.role, line.to);
  if (!line.name.empty()) request.key += " " + line.name;
  request.value = line.text;
  request.by = line.from;
  return request;
}

Result<ChatLine> chat_line(const RunRequest& request) {
  ChatLine line;
  std::string_view key = request.key;
  line.number = number_of<std::uint64_t>(take_word(key)).value_or(0);
  if (line.number == 0) return no_line("expected a number of at least 1");
  line.role = take_word(key);
  if (!is_one_of(line.role, kRoles)) {
    return no_line("expected the role observer, commander or super_user");
  }
  line.to = take_word(key);
  if (!is_one_of(line.to, kAddressees)) {
    return no_line("expected the kind of receiver: all, role, user, team or robot");
  }
  line.name = key;
  if (line.name.empty() != (line.to == "all") || line.name.size() > kMostChatName) {
    return no_line("expected the name of the receiver, except for all");
  }
  line.from = request.by;
  if (line.from.empty() || line.from.size() > kMostOrderAuthor)
    return no_line("expected the name of the author");
  line.text = request.value;
  if (line.text.empty() || line.text.size() > kMostOrderText) {
    return no_line(fmt::format("expected 1 to {} bytes of text", kMostOrderText));
  }
  return line;
}

}  // namespace rave::runtime
