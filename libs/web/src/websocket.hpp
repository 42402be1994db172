// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>

#include "core.hpp"

namespace rave::web {

/// Converts a connection to a WebSocket after its upgrade request. `slot` must have no other owner.
/// `subprotocol`: the negotiated one; empty: none.
void serve_websocket(Core& core, Stream stream, std::shared_ptr<ConnectionSlot> slot,
                     Request request, std::string subprotocol,
                     const beast::http::request<beast::http::string_body>& upgrade);

}  // namespace rave::web
