// SPDX-License-Identifier: Apache-2.0
#include "interrupt.hpp"

#include <csignal>

namespace rave::cli {
namespace {

/// A signal handler can reach nothing else.
runtime::RunControl run_control;

extern "C" void request_stop(int /*signal*/) { run_control.stop(); }

}  // namespace

runtime::RunControl& ended_by_signals() {
  struct sigaction action {};
  action.sa_handler = request_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  return run_control;
}

}  // namespace rave::cli
