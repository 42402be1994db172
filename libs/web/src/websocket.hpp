// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>

#include "core.hpp"

namespace rave::web {

/// Converts a connection to a WebSocket after its upgrade request, if the caller has room for one;
/// otherwise it is closed with 4430. `subprotocol`: the negotiated one; empty: none.
void serve_websocket(Core& core, Stream stream, Caller caller, Request request,
                     std::string subprotocol,
                     const beast::http::request<beast::http::string_body>& upgrade);

}  // namespace rave::web
