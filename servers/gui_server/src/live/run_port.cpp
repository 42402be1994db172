// SPDX-License-Identifier: Apache-2.0
#include "live/run_port.hpp"

#include <cmath>

namespace rave::gui_server {

void hold(runtime::RunControl& run, const TransportMessage& transport) {
  using Do = TransportMessage::Do;
  switch (transport.what) {
    case Do::kPlay:
      return run.resume();
    case Do::kPause:
      return run.pause();
    case Do::kStep:
      // Paused first: a run that is stepped while it runs would not stop after the steps.
      run.pause();
      return run.step(static_cast<std::uint64_t>(std::llround(transport.value)));
    case Do::kPace:
      return run.set_pace(transport.value);
    case Do::kSeek:
      break;
  }
}

}  // namespace rave::gui_server
