// SPDX-License-Identifier: Apache-2.0
// What cairo leaves out of an SVG: title and description, and numbers that are the same each time.
#include "svg_text.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include "legend.hpp"
#include "rave/base/markup.hpp"

namespace rave::report {
namespace {

// cairo numbers surfaces over the life of the process. Numbered anew, the same picture is the same
// file.
std::string with_surfaces_renumbered(const std::string& svg) {
  static constexpr std::string_view kWord = "surface";
  std::map<std::string, std::size_t> numbers;
  std::string result;
  std::size_t at = 0;
  while (true) {
    const std::size_t found = svg.find(kWord, at);
    if (found == std::string::npos) break;
    std::size_t end = found + kWord.size();
    const std::size_t digits = end;
    while (end < svg.size() && std::isdigit(static_cast<unsigned char>(svg[end])) != 0) ++end;
    result.append(svg, at, digits - at);
    at = end;
    if (end == digits) continue;
    const auto [entry, is_new] =
        numbers.try_emplace(svg.substr(digits, end - digits), numbers.size());
    result += std::to_string(entry->second);
  }
  return result.append(svg, at);
}

void add_list(std::string& text, std::string_view heading, const std::vector<std::string>& items) {
  if (items.empty()) return;
  text += fmt::format("{}: {}.\n", heading, fmt::join(items, ", "));
}

/// The content of the picture in words.
std::string description_of(const Picture& picture) {
  std::string text = picture.subtitle.empty() ? "" : picture.subtitle + "\n";
  for (const LegendGroup& group : legend_of(picture)) {
    std::vector<std::string> entries;
    for (const LegendEntry& entry : group.entries) entries.push_back(entry.text);
    add_list(text, group.heading, entries);
  }
  std::vector<std::string> labels;
  for (const PictureBody& body : picture.bodies) {
    if (!body.label.empty()) labels.push_back(body.label);
  }
  add_list(text, "Labels", labels);
  for (const PictureTrack& track : picture.tracks) {
    if (!track.pose_lost_t_s) continue;
    text += fmt::format("{}: pose lost at {:.1f} s.\n", track.label, *track.pose_lost_t_s);
  }
  for (const std::string& line : picture.caption) text += line + "\n";
  return text;
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  const auto forbidden = [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\n'; };
  std::string allowed(text);
  std::ranges::replace_if(allowed, forbidden, ' ');
  return escaped_markup(allowed);
}

std::string finished_svg(std::string svg, const Picture& picture) {
  svg = with_surfaces_renumbered(svg);
  const std::size_t root = svg.find("<svg");
  const std::size_t end = root == std::string::npos ? root : svg.find('>', root);
  if (end == std::string::npos) return svg;
  // Title and description are what screen readers and search find of an SVG.
  const std::string words =
      fmt::format("\n<title>{}</title>\n<desc>{}</desc>", xml_escaped(picture.title),
                  xml_escaped(description_of(picture)));
  svg.insert(end + 1, words);
  return svg;
}

}  // namespace rave::report
