// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/report/picture.hpp"

namespace rave::report {

/// The text with XML characters escaped, and characters that XML forbids replaced by spaces.
[[nodiscard]] std::string xml_escaped(std::string_view text);

/// Post-processes cairo's output: renumbers its surfaces from 0, because cairo counts them per
/// process and equal pictures would differ; and adds `title` and `desc` with the words of the
/// picture, because its text is drawn as outlines.
[[nodiscard]] std::string finished_svg(std::string svg, const Picture& picture);

}  // namespace rave::report
