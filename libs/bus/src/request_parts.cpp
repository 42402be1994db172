// SPDX-License-Identifier: Apache-2.0
// Answers that are longer than a message, cut into parts and put together again.
#include "rave/bus/request_parts.hpp"

#include <algorithm>
#include <charconv>

#include "rave/bus/topics.hpp"

namespace rave::bus {
namespace {

constexpr std::string_view kFrom = "from ";
constexpr std::string_view kOf = " of ";
constexpr std::string_view kColon = ": ";
/// The rest of the message is enough for the part header.
constexpr std::size_t kPartBytes = rave_wire_kMaxRequestAnswerBytes - 64;
/// Number of continuation bytes of a UTF-8 character.
constexpr std::size_t kMostFollowing = 3;

/// The beginning of `text` that fits into one part; characters are not split.
std::string_view first_part(std::string_view text) {
  std::size_t size = std::min(text.size(), kPartBytes);
  const auto follows = [&] { return (static_cast<unsigned char>(text[size]) & 0xC0U) == 0x80; };
  for (std::size_t i = 0; i < kMostFollowing && size < text.size() && follows(); ++i) --size;
  return text.substr(0, size);
}

bool take_word(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

bool take_number(std::string_view& text, std::size_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

}  // namespace

// A long answer does not fit into one message. The asker requests the rest by its first missing
// byte, so neither side keeps a state for lost parts.
std::optional<std::string> answer_part(std::string_view answer, std::size_t from) {
  if (from == 0 && answer.size() <= rave_wire_kMaxRequestAnswerBytes) return std::string(answer);
  if (from >= answer.size()) return std::nullopt;
  return fmt::format("{}{}{}{}{}{}", kFrom, from, kOf, answer.size(), kColon,
                     first_part(answer.substr(from)));
}

std::string request_for_rest(std::size_t from) { return fmt::format("{}{}", kFrom, from); }

std::size_t rest_requested(std::string_view request) noexcept {
  std::size_t from = 0;
  const bool good = take_word(request, kFrom) && take_number(request, from) && request.empty();
  return good ? from : 0;
}

Status AnswerParts::add(std::string_view message) {
  const auto refused = [](std::string_view why) {
    return fail(ErrorCode::kParse, "not a part of an answer: {}", why);
  };
  std::size_t from = 0;
  std::size_t total = message.size();
  if (take_word(message, kFrom)) {
    const bool headed = take_number(message, from) && take_word(message, kOf) &&
                        take_number(message, total) && take_word(message, kColon);
    if (!headed) return refused("its header is malformed");
  }
  if (total == 0 || total > kMostAnswerBytes) {
    return refused(fmt::format("{} bytes are not within 1 and {}", total, kMostAnswerBytes));
  }
  if (total_ != 0 && total != total_) {
    return refused(fmt::format("it is of {} bytes, and the others of {}", total, total_));
  }
  // A repetition of what is there already, as after a lost request.
  if (from < text_.size()) return {};
  if (from > text_.size()) {
    return refused(fmt::format("it begins at byte {} instead of {}", from, text_.size()));
  }
  const std::size_t left = total - from;
  // Parts have a minimum size, so that a sender of single bytes cannot prolong the answer without
  // end.
  const std::size_t least = std::min(left, kPartBytes - kMostFollowing);
  if (message.size() < least || message.size() > left) {
    return refused(fmt::format("it has {} bytes of {}", message.size(), left));
  }
  total_ = total;
  text_ += message;
  return {};
}

}  // namespace rave::bus
