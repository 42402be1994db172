// SPDX-License-Identifier: Apache-2.0
// Names of topics and types in ROS 2 and on the wire.
#include "rave/ros2/names.hpp"

namespace rave::ros2 {
namespace {

constexpr std::string_view kTopicPrefix = "rt/";
constexpr std::size_t kLongest = 200;

constexpr bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }
constexpr bool is_letter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool is_word(std::string_view text) {
  if (text.empty() || is_digit(text.front())) return false;
  for (const char c : text) {
    if (!is_letter(c) && !is_digit(c)) return false;
  }
  return true;
}

}  // namespace

Result<std::string> whole_name(std::string_view name_space, std::string_view topic) {
  std::string name(topic);
  if (!topic.starts_with('/')) {
    while (name_space.starts_with('/')) name_space.remove_prefix(1);
    while (name_space.ends_with('/')) name_space.remove_suffix(1);
    name =
        name_space.empty() ? fmt::format("/{}", topic) : fmt::format("/{}/{}", name_space, topic);
  }
  if (name.size() > kLongest) {
    return fail(ErrorCode::kInvalidArgument, "the topic `{}...` is longer than {} characters",
                name.substr(0, 40), kLongest);
  }
  std::string_view rest = name;
  while (!rest.empty()) {
    rest.remove_prefix(1);  // the slash
    const std::string_view word = rest.substr(0, rest.find('/'));
    if (!is_word(word)) {
      return fail(
          ErrorCode::kInvalidArgument,
          "`{}` is not a valid topic name: `{}` must be letters, digits and underscores, no "
          "digit first, as in `/cart/scan`",
          name, word);
    }
    rest.remove_prefix(word.size());
  }
  return name;
}

std::string word_of(std::string_view text) {
  std::string word;
  for (const char c : text) word += is_letter(c) || is_digit(c) ? c : '_';
  if (word.empty() || is_digit(word.front())) word.insert(0, 1, '_');
  return word;
}

// ROS 2 puts `rt` before topics, so that they do not meet those of services or of plain DDS.
std::string wire_topic(std::string_view whole_name) { return "rt" + std::string(whole_name); }

std::string topic_of_wire(std::string_view wire) {
  if (!wire.starts_with(kTopicPrefix)) return std::string(wire);
  return std::string(wire.substr(kTopicPrefix.size() - 1));
}

// `pkg::msg::dds_::Name_` on the wire is `pkg/msg/Name` in ROS 2.
std::string type_of_wire(std::string_view wire) {
  constexpr std::string_view kMiddle = "::dds_::";
  const std::size_t middle = wire.find(kMiddle);
  if (middle == std::string_view::npos || !wire.ends_with('_')) return std::string(wire);
  std::string type(wire.substr(0, middle));
  for (auto at = type.find("::"); at != std::string::npos; at = type.find("::")) {
    type.replace(at, 2, "/");
  }
  wire.remove_suffix(1);
  return type + "/" + std::string(wire.substr(middle + kMiddle.size()));
}

}  // namespace rave::ros2
