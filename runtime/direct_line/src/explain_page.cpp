// SPDX-License-Identifier: Apache-2.0
#include "explain_page.hpp"

namespace rave::direct_line {
namespace {

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<') {
      safe += "&lt;";
    } else if (c == '>') {
      safe += "&gt;";
    } else if (c == '&') {
      safe += "&amp;";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace

web::Response explain_page(const std::string& host) {
  web::Response response;
  response.type = "text/html; charset=utf-8";
  response.headers.emplace_back("Cache-Control", "no-store");
  response.body = std::make_shared<const std::string>(
      "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>Host " +
      escaped(host) +
      "</title><style>body{font:16px/1.5 system-ui,sans-serif;max-width:36em;margin:3em "
      "auto;padding:0 1em;color-scheme:light dark}</style><h1>Host " +
      escaped(host) +
      "</h1><p>This browser trusts the certificate of this host, or has been told to proceed "
      "without. Close this tab and go back to the page: it uses the direct line to this host from "
      "now on.</p><p>The warning before this page says that no authority which the browser knows "
      "vouches for the certificate. It does not come again, for this host and all others, where "
      "<code>authority.pem</code> of <code>rave keys web</code> is installed.</p><p>Orders come "
      "here "
      "over a WebSocket, with a ticket of the GUI Server. There is nothing else to "
      "see.</p></html>\n");
  return response;
}

}  // namespace rave::direct_line
