// SPDX-License-Identifier: Apache-2.0
// The tree as YAML or JSON. What is written is read back as the same tree, also by readers of YAML
// 1.1.
#include "rave/codec/text_output.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <optional>

#include "rave/base/utf8.hpp"
#include "rave/codec/numbers.hpp"

namespace rave::codec {
namespace {

constexpr std::size_t kLineWidth = 100;
constexpr std::size_t kRowWidth = 200;  ///< Of items of a list, of which there may be many.

/// Characters that other tools may strip, refuse or treat as a line break.
bool needs_escape(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029 ||
         code == 0xFEFF || code == 0xFFFE || code == 0xFFFF;
}

/// The text in double quotes. Escapes are `\u`, because JSON has no `\x`.
std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (std::size_t i = 0; i < text.size();) {
    Utf8Character c = utf8_at(text, i);
    if (c.length == 0) c = {0xFFFD, 1};
    if (c.code == '"' || c.code == '\\') {
      out += '\\';
      out += static_cast<char>(c.code);
    } else if (c.code == '\n') {
      out += "\\n";
    } else if (c.code == '\t') {
      out += "\\t";
    } else if (needs_escape(c.code)) {
      fmt::format_to(std::back_inserter(out), "\\u{:04x}", c.code);
    } else if (c.code == 0xFFFD && c.length == 1) {
      out += "\xEF\xBF\xBD";
    } else {
      out += text.substr(i, c.length);
    }
    i += c.length;
  }
  return out + '"';
}

/// Whether every YAML reader takes the unquoted text as this text.
bool is_plain_word(std::string_view text) {
  if (text.empty()) return false;
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  if (!letter(text[0]) && text[0] != '_') return false;
  std::string lower;
  for (const char c : text) {
    const bool allowed =
        letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.' || c == '/';
    if (!allowed) return false;
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  // YAML 1.1 reads some of these as booleans; the others look like other types.
  for (const std::string_view word :
       {"true", "false", "yes", "no", "on", "off", "y", "n", "null", "nan", "inf"}) {
    if (lower == word) return false;
  }
  return true;
}

std::string scalar_text(const RawNode& node) {
  if (node.is_null()) return "null";
  // A plain scalar is written as it was read, with all its digits.
  if (!node.is_text()) return node.scalar();
  return is_plain_word(node.scalar()) ? node.scalar() : in_quotes(node.scalar());
}

/// The node as text if it fits on the line of its key: scalars, empty collections, short lists of
/// these.
std::string inline_text(const RawNode& node) {
  if (node.is_null() || node.is_scalar()) return scalar_text(node);
  if (node.size() == 0) return node.is_mapping() ? "{}" : "[]";
  if (node.is_mapping()) return {};
  std::string out = "[";
  for (const RawNode& item : node.children()) {
    const std::string text = item.is_mapping() ? std::string{} : inline_text(item);
    // Longer lists get a line per item.
    if (text.empty() || out.size() + text.size() > 72) return {};
    if (out.size() > 1) out += ", ";
    out += text;
  }
  return out + "]";
}

/// A mapping as `{a: 1, b: [2, 3]}` if it has no comments, no mappings in it, and fits on a line.
std::string row_text(const RawNode& node) {
  std::string out = "{";
  for (std::size_t i = 0; i < node.size(); ++i) {
    const RawNode& value = node.child(i);
    const std::string text = value.is_mapping() ? std::string{} : inline_text(value);
    if (text.empty() || !node.comment(i).empty() || out.size() > kRowWidth) return {};
    if (i > 0) out += ", ";
    out += (is_plain_word(node.key(i)) ? node.key(i) : in_quotes(node.key(i))) + ": " + text;
  }
  return out.size() > kRowWidth ? std::string{} : out + "}";
}

std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return text;
}

class YamlText {
 public:
  [[nodiscard]] std::string take() && { return std::move(out_); }

  void root(const RawNode& node) {
    const std::string text = inline_text(node);
    if (!text.empty()) {
      out_ += text + "\n";
    } else if (node.is_mapping()) {
      mapping(node, 0, {});
    } else {
      sequence(node, 0);
    }
  }

 private:
  /// `lead` replaces the indentation of the first entry, for the dash of a list item.
  void mapping(const RawNode& node, std::size_t indent, const std::string& lead) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      const std::string spaces(indent, ' ');
      std::string line = i == 0 && !lead.empty() ? lead : spaces;
      line += is_plain_word(node.key(i)) ? node.key(i) : in_quotes(node.key(i));
      line += ':';
      const std::string text = inline_text(node.child(i));
      if (!text.empty()) line += ' ' + text;
      if (const std::string comment = one_line(node.comment(i)); !comment.empty()) {
        if (line.size() + 4 + comment.size() <= kLineWidth) {
          line += "  # " + comment;
        } else {
          out_.append(spaces).append("# ").append(comment).append("\n");
        }
      }
      out_ += line + "\n";
      if (text.empty()) block(node.child(i), indent + 2);
    }
  }

  void sequence(const RawNode& node, std::size_t indent) {
    const std::string dash = std::string(indent, ' ') + "- ";
    for (const RawNode& item : node.children()) {
      const bool row = item.is_mapping() && item.size() > 0;
      const std::string text = row ? row_text(item) : inline_text(item);
      if (!text.empty()) {
        out_ += dash + text + "\n";
      } else if (item.is_mapping()) {
        mapping(item, indent + 2, dash);
      } else {
        out_ += std::string(indent, ' ') + "-\n";
        sequence(item, indent + 2);
      }
    }
  }

  void block(const RawNode& node, std::size_t indent) {
    if (node.is_mapping()) {
      mapping(node, indent, {});
    } else {
      sequence(node, indent);
    }
  }

  std::string out_;
};

std::string json_scalar(const RawNode& node) {
  if (node.is_null()) return "null";
  if (node.is_text()) return in_quotes(node.scalar());
  if (const auto flag = node.as_bool()) return *flag ? "true" : "false";
  // A zero with a sign is no integer: its sign would be lost.
  const auto whole_number = node.as_int();
  if (whole_number == 0 && node.scalar().starts_with('-')) return "-0.0";
  if (whole_number) return fmt::format("{}", *whole_number);
  if (const auto whole = node.as_uint()) return fmt::format("{}", *whole);
  const auto number = node.as_double();
  // JSON has neither infinity nor NaN.
  return number && std::isfinite(*number) ? number_text(*number) : "null";
}

/// Without an indent, all in one line.
void json(const RawNode& node, std::optional<std::size_t> indent, std::string& out) {
  if (node.is_null() || node.is_scalar()) {
    out += json_scalar(node);
    return;
  }
  const bool named = node.is_mapping();
  if (node.size() == 0) {
    out += named ? "{}" : "[]";
    return;
  }
  const auto new_line = [&](std::size_t more) {
    if (indent) out.append("\n").append(*indent + more, ' ');
  };
  out += named ? '{' : '[';
  for (std::size_t i = 0; i < node.size(); ++i) {
    if (i > 0) out += indent ? "," : ", ";
    new_line(2);
    if (named) out += in_quotes(node.key(i)) + ": ";
    json(node.child(i), indent ? std::optional(*indent + 2) : std::nullopt, out);
  }
  new_line(0);
  out += named ? '}' : ']';
}

}  // namespace

std::string to_yaml(const RawNode& node) {
  YamlText text;
  text.root(node);
  return std::move(text).take();
}

std::string to_json(const RawNode& node) {
  std::string out;
  json(node, 0, out);
  return out + "\n";
}

std::string to_json_line(const RawNode& node) {
  std::string out;
  json(node, std::nullopt, out);
  return out;
}

}  // namespace rave::codec
