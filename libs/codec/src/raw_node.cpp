// SPDX-License-Identifier: Apache-2.0
// A node of a file: text, number or collection, with its place. Plain scalars keep their text and
// are typed when they are asked.
#include "rave/codec/raw_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "rave/base/check.hpp"
#include "rave/base/control_characters.hpp"
#include "rave/codec/numbers.hpp"

namespace rave::codec {
namespace {

/// from_chars() does not accept a leading plus sign.
std::string_view without_plus(std::string_view text) {
  return text.starts_with('+') ? text.substr(1) : text;
}

template <class T>
std::optional<T> parse_number(std::string_view text) {
  const std::string_view digits = without_plus(text);
  T value{};
  // from_chars() ignores the locale, under which strtod() may expect a comma.
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

/// At most 40 bytes on one line; characters are not split.
std::string excerpt(std::string_view text) {
  constexpr std::size_t kMaxBytes = 40;
  std::string part(text.substr(0, kMaxBytes));
  if (text.size() > kMaxBytes) {
    std::size_t cut = kMaxBytes;
    while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0U) == 0x80U) --cut;
    part.resize(cut);
    part += "...";
  }
  // The file may be anything; its bytes are shown on a terminal.
  return without_control_characters(part, " ");
}

}  // namespace

RawNode RawNode::text(std::string value) {
  RawNode node = plain(std::move(value));
  node.kind_ = Kind::kScalar;
  node.quoted_ = true;
  return node;
}

RawNode RawNode::plain(std::string value) {
  RawNode node;
  node.kind_ = plain_type(value) == PlainType::kNull ? Kind::kNull : Kind::kScalar;
  node.scalar_ = std::move(value);
  return node;
}

RawNode RawNode::boolean(bool value) { return plain(value ? "true" : "false"); }
RawNode RawNode::integer(std::int64_t value) { return plain(fmt::format("{}", value)); }
RawNode RawNode::unsigned_integer(std::uint64_t value) { return plain(fmt::format("{}", value)); }
RawNode RawNode::number(double value) { return plain(number_text(value)); }

RawNode RawNode::sequence(std::vector<RawNode> items) {
  RawNode node;
  node.kind_ = Kind::kSequence;
  node.children_ = std::move(items);
  return node;
}

RawNode RawNode::mapping(std::initializer_list<std::pair<std::string_view, RawNode>> entries) {
  RawNode node;
  node.kind_ = Kind::kMapping;
  for (const auto& [key, value] : entries) node.append(std::string(key), value);
  return node;
}

bool RawNode::is_text() const noexcept {
  return is_scalar() && (quoted_ || plain_type(scalar_) == PlainType::kText);
}

bool RawNode::is_whole_number() const noexcept {
  return is_scalar() && !quoted_ && plain_type(scalar_) == PlainType::kWhole;
}

std::optional<bool> RawNode::as_bool() const {
  if (!is_scalar() || quoted_ || plain_type(scalar_) != PlainType::kBool) return std::nullopt;
  return scalar_.front() == 't' || scalar_.front() == 'T';
}

std::optional<std::int64_t> RawNode::as_int() const {
  return is_whole_number() ? parse_number<std::int64_t>(scalar_) : std::nullopt;
}

std::optional<std::uint64_t> RawNode::as_uint() const {
  return is_whole_number() ? parse_number<std::uint64_t>(scalar_) : std::nullopt;
}

std::optional<double> RawNode::as_double() const {
  if (!is_scalar() || quoted_) return std::nullopt;
  switch (plain_type(scalar_)) {
    case PlainType::kWhole:
    case PlainType::kReal:
      return parse_number<double>(scalar_);
    case PlainType::kInfinite:
      return scalar_[0] == '-' ? -std::numeric_limits<double>::infinity()
                               : std::numeric_limits<double>::infinity();
    case PlainType::kNan:
      return std::numeric_limits<double>::quiet_NaN();
    default:
      return std::nullopt;
  }
}

std::optional<std::string> RawNode::as_text() const {
  return is_text() ? std::optional(scalar_) : std::nullopt;
}

SourceLocation RawNode::where() const { return {file_ ? *file_ : std::string{}, line_, column_}; }

SourceLocation RawNode::key_where(std::size_t i) const {
  // An entry that was added later may be from another file.
  if (keys_[i].line == 0 && children_[i].file_) return children_[i].where();
  return {file_ ? *file_ : std::string{}, keys_[i].line, keys_[i].column};
}

std::vector<std::string_view> RawNode::keys() const {
  std::vector<std::string_view> names;
  names.reserve(keys_.size());
  for (const Key& key : keys_) names.push_back(key.name);
  return names;
}

const RawNode* RawNode::find(std::string_view key) const noexcept {
  const auto entry = std::ranges::find(keys_, key, &Key::name);
  return entry == keys_.end() ? nullptr
                              : &children_[static_cast<std::size_t>(entry - keys_.begin())];
}

RawNode* RawNode::find(std::string_view key) noexcept {
  return const_cast<RawNode*>(
      std::as_const(*this).find(key));  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

std::string RawNode::found_text() const {
  switch (kind_) {
    case Kind::kNull:
      return "nothing";
    case Kind::kSequence:
      return "a list";
    case Kind::kMapping:
      return "a mapping";
    case Kind::kScalar:
      break;
  }
  if (is_text()) return fmt::format("the text \"{}\"", excerpt(scalar_));
  return as_bool() ? scalar_ : fmt::format("the number {}", excerpt(scalar_));
}

void RawNode::push_back(RawNode item) {
  RAVE_CHECK(is_sequence());
  children_.push_back(std::move(item));
}

void RawNode::append(std::string key, RawNode value, std::string comment) {
  RAVE_CHECK(is_mapping());
  keys_.push_back(Key{std::move(key), std::move(comment), 0, 0});
  children_.push_back(std::move(value));
}

void RawNode::set(std::string_view key, RawNode value) {
  if (RawNode* const present = find(key)) {
    *present = std::move(value);
  } else {
    append(std::string(key), std::move(value));
  }
}

bool RawNode::erase(std::string_view key) {
  const RawNode* const present = find(key);
  if (present == nullptr) return false;
  const auto i = present - children_.data();
  keys_.erase(keys_.begin() + i);
  children_.erase(children_.begin() + i);
  return true;
}

void RawNode::set_where(std::shared_ptr<const std::string> file, int line, int column) {
  file_ = std::move(file);
  line_ = line;
  column_ = column;
}

void RawNode::set_key_where(std::size_t i, int line, int column) {
  keys_[i].line = line;
  keys_[i].column = column;
}

bool operator==(const RawNode& a, const RawNode& b) {
  if (a.kind_ != b.kind_ || a.children_.size() != b.children_.size()) return false;
  // Quoted and plain text are equal, a number and a text of the same characters are not.
  if (a.is_scalar() && (a.scalar_ != b.scalar_ || a.is_text() != b.is_text())) return false;
  for (std::size_t i = 0; i < a.keys_.size(); ++i) {
    if (a.keys_[i].name != b.keys_[i].name) return false;
  }
  return a.children_ == b.children_;
}

}  // namespace rave::codec
