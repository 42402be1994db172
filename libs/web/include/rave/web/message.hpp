// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rave::web {

/// An HTTP request for a handler. Names of headers are in lower case.
struct Request {
  std::string method;  ///< `GET`, `HEAD` or `POST`.
  std::string path;    ///< Decoded, absolute, without query, without `.` and `..`.
  std::map<std::string, std::string> query;
  std::map<std::string, std::string> headers;
  std::string body;
  std::string peer;  ///< Address of the client.

  /// The value of a header; empty if it is missing.
  [[nodiscard]] std::string_view header(std::string_view name) const;
  /// The value of a cookie; empty if it is missing.
  [[nodiscard]] std::string cookie(std::string_view name) const;
};

/// The response of a handler.
struct Response {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::shared_ptr<const std::string> body;  ///< Null: empty.
  std::vector<std::pair<std::string, std::string>> headers;
  /// A file to send instead of `body`. It is read and sent in pieces, so it may be larger than the
  /// memory. Bytes appended meanwhile are not sent; if it cannot be read to its end, the connection
  /// is closed. Empty: send `body`.
  std::filesystem::path file{};
};

/// The Content-Security-Policy of all responses: it permits the server itself only, and connections
/// to `others` (`wss://left.example:8090`).
[[nodiscard]] std::string content_policy(std::span<const std::string> others = {});

/// A response with a line of text.
[[nodiscard]] Response text_response(int status, std::string text);

/// Decodes `%41` and, in queries, `+`. False if it is not valid or has a control character.
[[nodiscard]] bool decode_percent(std::string_view text, bool plus_is_space, std::string& out);

/// Splits a request target (`/a/b?c=d`) into a path without `..` and its query. False: it is
/// malformed, or leads out of the root.
[[nodiscard]] bool parse_target(std::string_view target, std::string& path,
                                std::map<std::string, std::string>& query);

/// Parses the body of a form (`application/x-www-form-urlencoded`). Of equal names the first
/// counts. False: it is malformed, has control characters, is longer than 8 KiB or has more than 32
/// fields.
[[nodiscard]] bool parse_form(std::string_view body, std::map<std::string, std::string>& fields);

}  // namespace rave::web
