// SPDX-License-Identifier: Apache-2.0
#include "rave/codec/json_input.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace rave::codec {
namespace {

using Json = nlohmann::json;

/// Builds the tree while the parser reads; refuses what nlohmann's own tree would accept, such as a
/// key that stands twice.
class Builder : public nlohmann::json_sax<Json> {
 public:
  explicit Builder(const JsonLimits& limits) : limits_(limits) {}

  bool null() override { return add(RawNode()); }
  bool boolean(bool value) override { return add(RawNode::boolean(value)); }
  bool number_integer(number_integer_t value) override { return add(RawNode::integer(value)); }
  bool number_unsigned(number_unsigned_t value) override {
    return add(RawNode::unsigned_integer(value));
  }
  bool number_float(number_float_t value, const string_t& /*text*/) override {
    return add(RawNode::number(value));
  }
  bool string(string_t& value) override {
    // Much that receives texts would end them there.
    if (value.find('\0') != string_t::npos) return refuse("a text with a character 0");
    return add(RawNode::text(std::move(value)));
  }
  bool binary(binary_t& /*value*/) override { return refuse("binary data"); }
  bool start_object(std::size_t /*size*/) override { return open(RawNode::mapping()); }
  bool start_array(std::size_t /*size*/) override { return open(RawNode::sequence()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& value) override {
    if (open_.back().node.find(value) != nullptr) {
      return refuse(fmt::format("the key `{}` stands twice", value));
    }
    open_.back().key = std::move(value);
    return count();
  }
  bool parse_error(std::size_t place, const std::string& /*token*/,
                   const nlohmann::detail::exception& error) override {
    // Out of range: a number that no double holds.
    const bool overflow = error.id == 406;
    return refuse(overflow ? "a number is too large"
                           : fmt::format("no JSON: unexpected at byte {}", place));
  }

  [[nodiscard]] RawNode take() && { return std::move(root_); }
  [[nodiscard]] const std::string& error() const noexcept { return error_; }

 private:
  struct Open {
    RawNode node;
    std::string key;  ///< Of a mapping: that of the next value.
  };

  bool refuse(std::string text) {
    error_ = std::move(text);
    return false;
  }
  bool count() {
    return ++nodes_ <= limits_.nodes || refuse(fmt::format("more than {} values", limits_.nodes));
  }
  bool add(RawNode node) {
    if (open_.empty()) {
      root_ = std::move(node);
    } else if (Open& parent = open_.back(); parent.node.is_mapping()) {
      parent.node.append(std::move(parent.key), std::move(node));
    } else {
      parent.node.push_back(std::move(node));
    }
    return count();
  }
  bool open(RawNode node) {
    if (open_.size() >= limits_.depth) {
      return refuse(fmt::format("nested deeper than {}", limits_.depth));
    }
    open_.push_back({std::move(node), {}});
    return true;
  }
  bool close() {
    RawNode node = std::move(open_.back().node);
    open_.pop_back();
    return add(std::move(node));
  }

  const JsonLimits& limits_;
  std::size_t nodes_ = 0;
  std::vector<Open> open_;
  RawNode root_;
  std::string error_;
};

}  // namespace

Result<RawNode> parse_json(std::string_view text, const JsonLimits& limits) {
  Builder builder(limits);
  if (!Json::sax_parse(text, &builder)) {
    return fail(ErrorCode::kParse, "{}",
                builder.error().empty() ? "expected JSON" : builder.error());
  }
  return std::move(builder).take();
}

}  // namespace rave::codec
