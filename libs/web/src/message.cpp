// SPDX-License-Identifier: Apache-2.0
// Parts of HTTP that are read by hand: targets, queries, forms, cookies.
#include "rave/web/message.hpp"

#include <algorithm>

namespace rave::web {
namespace {

int hex_digit(char c) noexcept {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

bool is_control(char c) noexcept {
  return static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) == 0x7f;
}

bool parse_query(std::string_view text, std::map<std::string, std::string>& query) {
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(text.size(), part.size() + 1));
    if (part.empty()) continue;
    const std::size_t equals = part.find('=');
    std::string name;
    std::string value;
    if (!decode_percent(part.substr(0, equals), true, name)) return false;
    if (equals != std::string_view::npos && !decode_percent(part.substr(equals + 1), true, value)) {
      return false;
    }
    // The first value counts, so that appended parameters change nothing.
    query.emplace(std::move(name), std::move(value));
  }
  return true;
}

}  // namespace

std::string_view Request::header(std::string_view name) const {
  const auto found = headers.find(std::string(name));
  return found == headers.end() ? std::string_view() : found->second;
}

std::string Request::cookie(std::string_view name) const {
  std::string_view all = header("cookie");
  while (!all.empty()) {
    std::string_view part = all.substr(0, all.find(';'));
    all.remove_prefix(std::min(all.size(), part.size() + 1));
    while (!part.empty() && part.front() == ' ') part.remove_prefix(1);
    if (part.size() > name.size() && part.starts_with(name) && part[name.size()] == '=') {
      return std::string(part.substr(name.size() + 1));
    }
  }
  return {};
}

// `connect-src 'self'` prevents the page from contacting other servers; its images may be data
// URLs. The docking library sets styles on elements, which requires 'unsafe-inline' for styles.
std::string content_policy(std::span<const std::string> others) {
  std::string connect = "'self'";
  for (const std::string& other : others) connect += " " + other;
  return "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' "
         "data: blob:; font-src 'self'; connect-src " +
         connect +
         "; manifest-src 'self'; worker-src 'self'; base-uri 'none'; form-action 'self'; "
         "frame-ancestors 'none'";
}

Response text_response(int status, std::string text) {
  Response response;
  response.status = status;
  response.body = std::make_shared<const std::string>(std::move(text));
  return response;
}

bool decode_percent(std::string_view text, bool plus_is_space, std::string& out) {
  out.clear();
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      if (i + 2 >= text.size()) return false;
      const int high = hex_digit(text[i + 1]);
      const int low = hex_digit(text[i + 2]);
      if (high < 0 || low < 0) return false;
      c = static_cast<char>(high * 16 + low);
      i += 2;
    } else if (c == '+' && plus_is_space) {
      c = ' ';
    }
    // No control character gets into paths, log lines or headers.
    if (is_control(c)) return false;
    out.push_back(c);
  }
  return true;
}

bool parse_target(std::string_view target, std::string& path,
                  std::map<std::string, std::string>& query) {
  query.clear();
  if (target.empty() || target.front() != '/') return false;
  const std::size_t mark = target.find('?');
  if (!decode_percent(target.substr(0, mark), false, path)) return false;
  if (path.find('\\') != std::string::npos) return false;
  std::string_view rest(path);
  // Checked after decoding, since `%2e%2e` is `..` as well.
  while (!rest.empty()) {
    rest.remove_prefix(1);
    const std::string_view part = rest.substr(0, rest.find('/'));
    if (part == "." || part == "..") return false;
    rest.remove_prefix(part.size());
  }
  return mark == std::string_view::npos || parse_query(target.substr(mark + 1), query);
}

bool parse_form(std::string_view body, std::map<std::string, std::string>& fields) {
  constexpr std::size_t kMostBytes = 8192;
  constexpr std::ptrdiff_t kMostFields = 32;
  fields.clear();
  if (body.size() > kMostBytes) return false;
  // Before anything is parsed: a map of a million fields would cost seconds.
  if (std::count(body.begin(), body.end(), '&') >= kMostFields) return false;
  return parse_query(body, fields);
}

}  // namespace rave::web
