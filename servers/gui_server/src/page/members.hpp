// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/direct_line/json_members.hpp"

namespace rave::gui_server {

using Members = direct_line::JsonMembers;
using PageJson = direct_line::Json;
using direct_line::kLongestPlainName;

}  // namespace rave::gui_server
