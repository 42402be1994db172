// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "rave/base/result.hpp"
#include "rave/web/server.hpp"

namespace rave::gui_server {

/// The metrics in the text format of Prometheus, without names of users.
[[nodiscard]] std::string metrics_text(const web::ServerCounts& counts, std::size_t pages,
                                       std::uint64_t lost_audit_lines);

/// The token with which others than this machine may read it; made if the folder has none. Errors:
/// kIo.
[[nodiscard]] Result<std::string> metrics_token(const std::filesystem::path& folder);

/// Whether a request may read it: it comes from this machine, or brings the token. An empty token
/// permits nothing from elsewhere.
[[nodiscard]] bool may_read_metrics(const web::Request& request, const std::string& token);

}  // namespace rave::gui_server
