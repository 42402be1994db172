// SPDX-License-Identifier: Apache-2.0
#include "page/probe_message.hpp"

#include <algorithm>
#include <cmath>

#include "rave/base/control_characters.hpp"
#include "rave/base/plain_name.hpp"

namespace rave::gui_server {
namespace {

constexpr double kFarthestMount_m = 100;
constexpr std::size_t kMostParameters = 64;
constexpr std::size_t kMostInList = 64;
constexpr std::size_t kLongestProbeText = 256;
constexpr std::string_view kNameSigns = "-_";

bool is_finite(const PageJson& value) {
  return value.is_number() && std::isfinite(value.get<double>());
}

/// A value as a file has it on one line.
Result<std::string> value_text(const std::string& name, const PageJson& value) {
  if (value.is_boolean() || is_finite(value)) return value.dump();
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    if (text.size() <= kLongestProbeText && !has_control_characters(text)) return value.dump();
  }
  const bool list = value.is_array() && value.size() <= kMostInList &&
                    std::all_of(value.begin(), value.end(), is_finite);
  if (list) return value.dump();
  return fail(ErrorCode::kParse,
              "`params.{}`: expected a number, true, false, a short text or a list of numbers",
              name);
}

Status take_params(const PageJson& params, ProbeRequest& request) {
  if (!params.is_object() || params.size() > kMostParameters) {
    return fail(ErrorCode::kParse, "`params`: expected an object");
  }
  for (const auto& [name, value] : params.items()) {
    if (name.size() > kLongestPlainName || !is_plain_name(name, kNameSigns)) {
      return fail(ErrorCode::kParse, "`params`: expected plain names");
    }
    RAVE_TRY_ASSIGN(std::string text, value_text(name, value));
    request.params.emplace_back(name, std::move(text));
  }
  return {};
}

Result<ProbeRequest> probe_of(const PageJson& json, const char* name) {
  if (!json.is_object()) return fail(ErrorCode::kParse, "`{}`: expected objects", name);
  Members members(json);
  ProbeRequest request;
  RAVE_TRY_ASSIGN(request.slot, members.index("slot"));
  RAVE_TRY_ASSIGN(request.name, members.plain_name("name", kNameSigns));
  RAVE_TRY_ASSIGN(request.driver, members.plain_name("driver", kNameSigns));
  RAVE_TRY_ASSIGN(request.X_RS, members.pose("mount", kFarthestMount_m));
  RAVE_TRY_ASSIGN(request.z_m, members.number_in("z", -kFarthestMount_m, kFarthestMount_m));
  RAVE_TRY_ASSIGN(const PageJson* const params, members.any("params"));
  RAVE_TRY(take_params(*params, request));
  RAVE_TRY(members.finish());
  return request;
}

}  // namespace

Result<LookProbesMessage> look_probes_of(Members& members) {
  LookProbesMessage look;
  RAVE_TRY_ASSIGN(look.request, members.index("request"));
  RAVE_TRY_ASSIGN(look.probes, members.list("probes", kMostProbes, probe_of));
  return look;
}

}  // namespace rave::gui_server
