// SPDX-License-Identifier: Apache-2.0
#include "explain_page.hpp"

#include "rave/base/markup.hpp"

namespace rave::direct_line {

web::Response explain_page(const std::string& host) {
  web::Response response;
  response.type = "text/html; charset=utf-8";
  response.headers.emplace_back("Cache-Control", "no-store");
  response.body = std::make_shared<const std::string>(
      "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>Host " +
      escaped_markup(host) +
      "</title><style>body{font:16px/1.5 system-ui,sans-serif;max-width:36em;margin:3em "
      "auto;padding:0 1em;color-scheme:light dark}</style><h1>Host " +
      escaped_markup(host) +
      "</h1><p>This browser accepts the certificate of this host. Close this tab and go back to "
      "the page: it uses the direct line to this host from now on.</p><p>The warning before this "
      "page means that the browser does not know the authority that signed the certificate. "
      "Install <code>authority.pem</code> of <code>rave keys web</code> in the browser; then it "
      "shows no warning for any host with a certificate of this authority.</p><p>Pages send orders "
      "to this host over a WebSocket, with a ticket of the GUI Server. This page shows nothing "
      "else.</p></html>\n");
  return response;
}

}  // namespace rave::direct_line
