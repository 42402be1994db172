// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "recording/player.hpp"
#include "utias/plugins/playback.hpp"
#include "utias/plugins/report_json.hpp"

namespace rave::utias {

/// A stream of one recorded robot for recording::Player. `Kind` defines the specifics: types and
/// constants `Record`, `kReading`, `kKind`, `kCapacity`, `kCollect`; `code_meaning(params)`; and
/// `timeline(params, playback)`, which returns a Timeline<Record>.
template <class Kind>
struct Stream : Kind {
  using Record = typename Kind::Record;

  static Result<recording::Played<Record>> load(const HardwareSetup& setup) {
    const Params params = setup.parameters();
    RAVE_TRY_ASSIGN(const Playback playback,
                    load_playback(setup, Kind::kKind, Kind::code_meaning(params)));
    return recording::Played<Record>{Kind::timeline(params, playback), report_json(playback),
                                     playback.live};
  }
  static void declare(HardwareDeclaration& /*declaration*/) noexcept {}
};

template <class Kind>
using Player = recording::Player<Stream<Kind>>;

}  // namespace rave::utias
