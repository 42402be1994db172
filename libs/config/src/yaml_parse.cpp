// SPDX-License-Identifier: Apache-2.0
// YAML into a tree with places, from the events of yaml-cpp. Stricter than YAML: one document, no
// tags, no merge keys, no key twice, limits on depth and size.
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <unordered_set>
#include <utility>

#include "rave/base/control_characters.hpp"
#include "rave/base/utf8.hpp"
#include "rave/config/yaml.hpp"

namespace rave::config {
namespace {

/// yaml-cpp notices a missing colon, bracket or indent only at what follows it.
std::string_view place_hint(std::string_view problem) {
  const bool late = problem == "illegal map value" || problem.ends_with("not found");
  return late ? "; see also the line before: a colon, a bracket or the indent" : "";
}

/// Ends the parser's event loop; caught in parse_yaml().
struct Abort {
  Error error;
};

int height_of(const RawNode& node) {
  int height = 0;
  for (const RawNode& child : node.children()) height = std::max(height, height_of(child));
  return node.is_scalar() || node.is_null() ? 0 : height + 1;
}

/// yaml-cpp converts the escapes `\N` and `\_` (U+0085 and U+00A0) to single bytes, which are
/// invalid UTF-8.
std::string with_whole_escapes(const std::string& text) {
  const std::size_t bad = first_invalid_utf8(text);
  if (bad == text.size()) return text;
  std::string whole = text.substr(0, bad);
  for (std::size_t i = bad; i < text.size();) {
    const std::size_t length = utf8_at(text, i).length;
    if (length == 0) whole += '\xC2';
    whole.append(text, i, std::max<std::size_t>(length, 1));
    i += std::max<std::size_t>(length, 1);
  }
  return whole;
}

/// Builds the tree from the parser's events.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(std::string_view file_name, Diagnostics& diagnostics)
      : file_(std::make_shared<const std::string>(file_name)), diagnostics_(diagnostics) {}

  [[nodiscard]] SourceLocation place(const YAML::Mark& mark) const {
    return {*file_, mark.line + 1, mark.column + 1};
  }
  /// The place of the last scalar of the file if it is quoted.
  [[nodiscard]] const std::optional<YAML::Mark>& last_quoted() const noexcept {
    return last_scalar_;
  }
  [[nodiscard]] std::optional<RawNode> take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (root_) {
      throw Abort{{ErrorCode::kParse, "expected one document, found a second one", place(mark)}};
    }
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    count(1, mark);
    value(located(RawNode{}, mark), mark, anchor, 1);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& read) override {
    const std::string text = with_whole_escapes(read);
    count(1, mark);
    check_tag(tag, mark);
    // The parser marks quoted scalars with the tag `!` and plain ones with `?`.
    last_scalar_ = tag == "!" ? std::optional(mark) : std::nullopt;
    value(located(tag == "!" ? RawNode::text(text) : RawNode::plain(text), mark), mark, anchor, 1);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) {
      throw Abort{{ErrorCode::kParse, "an alias refers to a value that contains it", place(mark)}};
    }
    // An alias is a copy. Counting it keeps a small file with nested aliases from growing without
    // limit ("billion laughs").
    count_copies(found->second.size, mark);
    check_depth(static_cast<int>(stack_.size()) + height_of(found->second.node), mark);
    value(found->second.node, mark, 0, 0);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(RawNode::sequence(), mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(RawNode::mapping(), mark, tag, anchor);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Frame {
    RawNode node;
    YAML::Mark mark;
    YAML::anchor_t anchor = 0;
    std::size_t nodes_before = 0;
    bool has_key = false;  // a key waits for its value
    bool drop = false;     // the waiting key is invalid; drop its value
    std::string key;
    YAML::Mark key_mark;
    std::unordered_set<std::string> seen;
  };
  struct Anchored {
    RawNode node;
    std::size_t size = 0;
  };

  RawNode located(RawNode node, const YAML::Mark& mark) const {
    node.set_where(file_, mark.line + 1, mark.column + 1);
    return node;
  }

  void count(std::size_t nodes, const YAML::Mark& mark) {
    nodes_ += nodes;
    if (nodes_ <= kMaxNodes) return;
    throw Abort{{ErrorCode::kParse, fmt::format("more than {} values", kMaxNodes), place(mark)}};
  }

  void count_copies(std::size_t nodes, const YAML::Mark& mark) {
    copies_ += nodes;
    if (copies_ > kMaxCopies) {
      throw Abort{{ErrorCode::kParse,
                   fmt::format("aliases stand for more than {} values", kMaxCopies), place(mark)}};
    }
    count(nodes, mark);
  }

  void check_depth(int depth, const YAML::Mark& mark) const {
    if (depth <= kMaxDepth) return;
    throw Abort{{ErrorCode::kParse,
                 fmt::format("lists and mappings are nested deeper than {}", kMaxDepth),
                 place(mark)}};
  }

  void check_tag(const std::string& tag, const YAML::Mark& mark) {
    if (tag.empty() || tag == "?" || tag == "!") return;
    report(mark, fmt::format("tags are not allowed, found `{}`", tag));
  }

  void report(const YAML::Mark& mark, std::string message) {
    diagnostics_.add(place(mark), std::move(message));
  }

  void open(RawNode node, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    check_tag(tag, mark);
    check_depth(static_cast<int>(stack_.size()) + 1, mark);
    Frame frame;
    frame.node = located(std::move(node), mark);
    frame.mark = mark;
    frame.anchor = anchor;
    frame.nodes_before = nodes_;
    count(1, mark);
    stack_.push_back(std::move(frame));
  }

  void close() {
    Frame frame = std::move(stack_.back());
    stack_.pop_back();
    value(std::move(frame.node), frame.mark, frame.anchor, nodes_ - frame.nodes_before);
  }

  /// Adds a finished node to its parent. `size` is the number of nodes in it.
  void value(RawNode node, const YAML::Mark& mark, YAML::anchor_t anchor, std::size_t size) {
    if (anchor != 0) {
      count_copies(size, mark);  // the copy kept for aliases
      anchors_[anchor] = Anchored{node, size};
    }
    if (stack_.empty()) {
      root_ = std::move(node);
      return;
    }
    Frame& frame = stack_.back();
    if (frame.node.is_sequence()) {
      frame.node.push_back(std::move(node));
    } else if (frame.has_key) {
      entry(frame, std::move(node), mark);
    } else {
      key(frame, node, mark);
    }
  }

  void entry(Frame& frame, RawNode node, const YAML::Mark& mark) {
    frame.has_key = false;
    if (frame.drop) return;
    // An empty value has the place of the next token; use that of its key.
    if (node.is_null() && mark.line != frame.key_mark.line) node = located({}, frame.key_mark);
    frame.node.append(std::move(frame.key), std::move(node));
    frame.node.set_key_where(frame.node.size() - 1, frame.key_mark.line + 1,
                             frame.key_mark.column + 1);
  }

  void key(Frame& frame, const RawNode& node, const YAML::Mark& mark) {
    frame.has_key = true;
    // Until the key turns out to be good. Its value still comes as an event and must be dropped
    // with it.
    frame.drop = true;
    frame.key_mark = mark;
    if (!node.is_scalar()) {
      report(mark, fmt::format("a key must be a word, found {}", node.found_text()));
    } else if (node.scalar() == "<<") {
      report(mark, "merge keys (`<<`) are not allowed: write the entries out");
    } else if (node.scalar().size() > kMaxKeyBytes) {
      report(mark, fmt::format("a key is longer than {} bytes", kMaxKeyBytes));
    } else if (!frame.seen.insert(node.scalar()).second) {
      report(mark, fmt::format("the key `{}` is given twice", node.scalar()));
    } else {
      frame.drop = false;
      frame.key = node.scalar();
    }
  }

  std::shared_ptr<const std::string> file_;  // shared with every node of the tree
  Diagnostics& diagnostics_;
  std::vector<Frame> stack_;
  std::map<YAML::anchor_t, Anchored> anchors_;
  std::size_t nodes_ = 0;
  std::size_t copies_ = 0;
  std::optional<YAML::Mark> last_scalar_;
  std::optional<RawNode> root_;
};

SourceLocation place_of(std::string_view text, std::size_t offset, std::string_view file_name) {
  const std::string_view before = text.substr(0, offset);
  const auto lines = std::count(before.begin(), before.end(), '\n');
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  return {std::string(file_name), static_cast<int>(lines) + 1,
          static_cast<int>(offset - line_start) + 1};
}

/// The place of a tab in the indent of this line, counted from 0.
std::optional<SourceLocation> tab_in_indent(std::string_view text, int line,
                                            std::string_view file_name) {
  std::size_t start = 0;
  for (int i = 0; i < line; ++i) {
    start = text.find('\n', start);
    if (start == std::string_view::npos) return std::nullopt;
    ++start;
  }
  const std::size_t end = text.find_first_not_of(" \t", start);
  const std::size_t tab = text.find('\t', start);
  if (end == std::string_view::npos || tab > end) return std::nullopt;
  return place_of(text, tab, file_name);
}

/// Checks the characters before parsing.
std::optional<Error> check_characters(std::string_view text, std::string_view file_name) {
  if (text.size() > kMaxFileBytes) {
    return Error{ErrorCode::kParse, fmt::format("the file is larger than {} bytes", kMaxFileBytes),
                 SourceLocation{std::string(file_name), 0, 0}};
  }
  const std::size_t bad = first_invalid_utf8(text);
  if (bad < text.size()) {
    return Error{ErrorCode::kParse, "the file is not UTF-8 text", place_of(text, bad, file_name)};
  }
  for (std::size_t i = 0; i < text.size();) {
    const TextCharacter here = character_at(text, i);
    // The control characters permitted here are single bytes.
    const auto c = static_cast<unsigned char>(text[i + here.bytes - 1]);
    if (here.control && c != '\t' && c != '\n' && c != '\r') {
      return Error{ErrorCode::kParse, fmt::format("found a control character (code {})", c),
                   place_of(text, i, file_name)};
    }
    i += here.bytes;
  }
  return std::nullopt;
}

void parse_all(const std::string& text, YAML::EventHandler& handler) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  while (parser.HandleNextDocument(handler)) {
  }
}

/// Counts occurrences of a text in the scalars of a document.
class ScalarSearch : public YAML::EventHandler {
 public:
  explicit ScalarSearch(std::string_view wanted) : wanted_(wanted) {}
  [[nodiscard]] std::size_t found() const noexcept { return found_; }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string& text) override {
    for (std::size_t at = text.find(wanted_); at != std::string::npos;
         at = text.find(wanted_, at + wanted_.size())) {
      ++found_;
    }
  }
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}

 private:
  std::string_view wanted_;
  std::size_t found_ = 0;
};

std::size_t count_in_scalars(std::string_view wanted, const std::string& text) {
  ScalarSearch search(wanted);
  parse_all(text, search);
  return search.found();
}

/// yaml-cpp accepts the end of the file as a closing quote after a line break, so a truncated file
/// would pass. If a comment appended to the text becomes part of a scalar, a quote is open;
/// otherwise it stays a comment.
bool is_quote_open(std::string_view text) {
  constexpr std::string_view kMark = "#end-of-file-2f6c1d";
  const std::size_t with = count_in_scalars(kMark, fmt::format("{}\n{}\n", text, kMark));
  return with > 0 && with > count_in_scalars(kMark, std::string(text));
}

}  // namespace

std::optional<RawNode> parse_yaml(std::string_view text, std::string_view file_name,
                                  Diagnostics& diagnostics) {
  if (auto error = check_characters(text, file_name)) {
    diagnostics.add(*std::move(error));
    return std::nullopt;
  }
  TreeBuilder builder(file_name, diagnostics);
  try {
    parse_all(std::string(text), builder);
    // Only a quoted scalar at the end of the file can be one that was not closed.
    if (const auto& mark = builder.last_quoted(); mark && is_quote_open(text)) {
      throw Abort{{ErrorCode::kParse, "YAML syntax: a quote is not closed", builder.place(*mark)}};
    }
  } catch (const Abort& abort) {
    diagnostics.add(abort.error);
    return std::nullopt;
  } catch (const YAML::Exception& e) {
    if (auto tab = tab_in_indent(text, e.mark.line, file_name)) {
      diagnostics.add(*std::move(tab), "YAML syntax: found a tab in the indent, expected spaces");
    } else {
      diagnostics.add(builder.place(e.mark),
                      fmt::format("YAML syntax: {}{}", e.msg, place_hint(e.msg)));
    }
    return std::nullopt;
  } catch (const std::exception& e) {
    // yaml-cpp lets exceptions of the standard library through for some numeric escapes.
    diagnostics.add({std::string(file_name), 0, 0}, fmt::format("YAML: {}", e.what()));
    return std::nullopt;
  }
  std::optional<RawNode> root = builder.take();
  if (!root || root->is_null()) {
    diagnostics.add({std::string(file_name), 1, 1}, "the file is empty");
    return std::nullopt;
  }
  return root;
}

}  // namespace rave::config
