// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"

namespace rave::control {

/// The control socket: a Unix domain socket through which the same user controls a run from other
/// terminals. It has a thread of its own from start() to destruction.
class Server {
 public:
  /// `control` must outlive the server. Errors: the socket cannot be opened.
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
