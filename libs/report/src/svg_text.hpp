// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/report/picture.hpp"

namespace rave::report {

/// The text with what XML reserves escaped, and what XML forbids replaced by a space.
[[nodiscard]] std::string xml_escaped(std::string_view text);

/// What cairo wrote, made a good citizen: its surfaces renumbered from 0 (cairo counts them per
/// process, which would make equal pictures differ), and `title` and `desc` with the picture's
/// words put in for readers and searches, since the text itself is drawn as outlines.
[[nodiscard]] std::string finished_svg(std::string svg, const Picture& picture);

}  // namespace rave::report
