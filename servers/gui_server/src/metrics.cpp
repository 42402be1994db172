// SPDX-License-Identifier: Apache-2.0
#include "metrics.hpp"

#include <fmt/format.h>
#include <sodium.h>

#include "people/secrets.hpp"
#include "rave/base/file.hpp"
#include "rave/web/rate_limit.hpp"

namespace rave::gui_server {
namespace {

std::string metric(const char* name, const char* kind, const char* help, std::uint64_t value) {
  return fmt::format("# HELP rave_gui_{0} {1}\n# TYPE rave_gui_{0} {2}\nrave_gui_{0} {3}\n", name,
                     help, kind, value);
}

}  // namespace

std::string metrics_text(const web::ServerCounts& counts, std::size_t pages,
                         std::uint64_t lost_audit_lines) {
  return metric("pages", "gauge", "Connected pages.", pages) +
         metric("sockets", "gauge", "Open WebSockets.", counts.open_sockets) +
         metric("connections", "gauge", "Open HTTP connections.", counts.open_connections) +
         metric("connections_total", "counter", "Accepted connections.", counts.connections) +
         metric("failed_handshakes_total", "counter", "Failed TLS handshakes.",
                counts.failed_handshakes) +
         metric("requests_total", "counter", "HTTP requests.", counts.requests) +
         metric("refused_requests_total", "counter",
                "Refused requests: malformed, of another origin, too large or too many.",
                counts.refused_requests) +
         metric("rate_closed_total", "counter", "WebSockets closed because they sent too much.",
                counts.sockets_closed_for_rate) +
         metric("no_room_total", "counter",
                "WebSockets refused because a session, a user or an address had too many.",
                counts.sockets_without_room) +
         metric("sent_bytes_total", "counter", "Bytes sent over WebSockets.", counts.sent_bytes) +
         metric("lost_audit_lines_total", "counter",
                "Lines that could not be written to the audit log.", lost_audit_lines);
}

Result<std::string> metrics_token(const std::filesystem::path& folder) {
  const auto file = folder / "metrics_token";
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    // The folder is private.
    RAVE_TRY(write_private_file_atomically(file, new_secret() + "\n"));
  }
  RAVE_TRY_ASSIGN(std::string token, read_file(file, 1000));
  return token.substr(0, token.find('\n'));
}

bool may_read_metrics(const web::Request& request, const std::string& token) {
  if (web::is_loopback(request.peer)) return true;
  const std::string expected = "Bearer " + token;
  const std::string_view given = request.header("authorization");
  return !token.empty() && given.size() == expected.size() &&
         sodium_memcmp(given.data(), expected.data(), expected.size()) == 0;
}

}  // namespace rave::gui_server
