// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace rave::bus::bench {

/// Answers on a UDP socket of loopback what comes, until it gets an empty packet. Says its port on
/// the standard output. For a process of its own.
int serve_udp();

/// Round trips of `bytes` with such a server, in microseconds each; blocking sockets, no threads.
[[nodiscard]] std::vector<double> udp_round_trips_us(int port, std::size_t bytes,
                                                     std::size_t count);

}  // namespace rave::bus::bench
