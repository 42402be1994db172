// SPDX-License-Identifier: Apache-2.0
// Replaces `$(name)` in a robot file before its structs are read, so that no struct knows of
// variables.
#include "rave/config/variables.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "file_checks.hpp"
#include "rave/base/names.hpp"

namespace rave::config {
namespace {

constexpr std::string_view kOpen = "$(";
constexpr std::string_view kEscaped = "$$(";

std::string unknown_variable(std::string_view name, const RawNode& declared) {
  return fmt::format("unknown variable `{}`; the robot file declares {}", name,
                     join_names(declared.keys()));
}

class Substitution {
 public:
  Substitution(const RawNode& variables, Diagnostics& diagnostics)
      : variables_(variables), diagnostics_(diagnostics) {}

  void apply(RawNode& node) {
    for (std::size_t i = 0; i < node.size(); ++i) apply(node.child(i));
    if (!node.is_text() || node.scalar().find(kOpen) == std::string::npos) return;
    const RawNode* whole = nullptr;
    std::string text;
    if (!expand(node, text, whole)) return;
    const SourceLocation where = node.where();
    // `$(v)` alone takes the type of the variable; within a text it is text.
    node = whole ? *whole : RawNode::text(std::move(text));
    if (!file_) file_ = std::make_shared<const std::string>(where.file);
    // Errors are reported where the variable is used, not where it was set.
    node.set_where(file_, where.line, where.column);
  }

 private:
  /// Substitutes the variables of a scalar; sets `whole` if it consists of one variable.
  bool expand(const RawNode& node, std::string& text, const RawNode*& whole) {
    const std::string_view all = node.scalar();
    for (std::size_t i = 0; i < all.size();) {
      const std::string_view rest = all.substr(i);
      if (rest.starts_with(kEscaped)) {
        text += kOpen;
        i += kEscaped.size();
      } else if (rest.starts_with(kOpen)) {
        const std::size_t end = rest.find(')');
        const RawNode* value = look_up(node, rest, end);
        if (!value) return false;
        if (i == 0 && end + 1 == all.size()) whole = value;
        text += value->scalar();
        i += end + 1;
      } else {
        text += all[i++];
      }
    }
    return true;
  }

  const RawNode* look_up(const RawNode& node, std::string_view rest, std::size_t end) {
    if (end == std::string_view::npos) {
      diagnostics_.add(node.where(), "`$(` is not closed by `)`; write `$$(` for these characters");
      return nullptr;
    }
    const std::string_view name = rest.substr(kOpen.size(), end - kOpen.size());
    const RawNode* value = variables_.find(name);
    if (!value) diagnostics_.add(node.where(), unknown_variable(name, variables_));
    return value;
  }

  const RawNode& variables_;
  Diagnostics& diagnostics_;
  std::shared_ptr<const std::string> file_;  // owned by all replaced nodes
};

void check_value(std::string_view name, const RawNode& value, Diagnostics& diagnostics) {
  if (!value.is_scalar()) {
    diagnostics.add(value.where(), fmt::format("the variable `{}`: found {}, expected a number, "
                                               "true, false or text",
                                               name, value.found_text()));
  } else if (value.scalar().find(kOpen) != std::string::npos) {
    diagnostics.add(value.where(), fmt::format("the variable `{}` may not contain `$(`", name));
  }
}

/// The declared variables with the given values, checked.
RawNode values_in_force(RawNode declared, const Variables& given, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < declared.size(); ++i) {
    if (!is_variable_name(declared.key(i))) {
      diagnostics.add(declared.key_where(i),
                      fmt::format("`{}` cannot name a variable: expected letters, digits and `_`, "
                                  "the first no digit",
                                  declared.key(i)));
    }
    check_value(declared.key(i), declared.child(i), diagnostics);
  }
  for (const auto& [name, value] : given) {
    if (declared.find(name)) {
      check_value(name, value, diagnostics);
      declared.set(name, value);
    } else {
      diagnostics.add(value.where(), unknown_variable(name, declared));
    }
  }
  return declared;
}

}  // namespace

void substitute_variables(RawNode& robot, const Variables& given, Diagnostics& diagnostics) {
  if (!robot.is_mapping()) return;
  const RawNode* declared = robot.find("variables");
  // A value that is not a mapping is reported when the struct is read.
  if (declared && !declared->is_mapping() && !declared->is_null()) return;
  const std::size_t errors_before = diagnostics.size();
  const RawNode values = values_in_force(
      declared && declared->is_mapping() ? *declared : RawNode::mapping(), given, diagnostics);
  if (diagnostics.size() != errors_before) return;
  Substitution substitution(values, diagnostics);
  for (std::size_t i = 0; i < robot.size(); ++i) {
    if (robot.key(i) != "variables") substitution.apply(robot.child(i));
  }
  if (declared) robot.set("variables", values);
}

void escape_variables(RawNode& node) {
  for (std::size_t i = 0; i < node.size(); ++i) escape_variables(node.child(i));
  if (!node.is_text() || node.scalar().find(kOpen) == std::string::npos) return;
  std::string text;
  const std::string& all = node.scalar();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (std::string_view(all).substr(i).starts_with(kOpen)) text += '$';
    text += all[i];
  }
  node = RawNode::text(std::move(text));
}

}  // namespace rave::config
