// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"

namespace rave::control {

/// Lets other terminals of the same user control a run, over a Unix domain socket, in a thread of
/// its own from start() until it is destroyed.
class Server {
 public:
  /// `control` outlives the server. Errors: what keeps the socket from being opened.
  [[nodiscard]] static Result<std::unique_ptr<Server>> start(const std::string& run,
                                                             runtime::RunControl& control);
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  /// Removes the socket and waits for the thread.
  ~Server();

 private:
  struct Impl;
  explicit Server(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::control
