// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>

#include "rave/base/result.hpp"
#include "rave/gui_server/source.hpp"
#include "rave/watch/run_view.hpp"

// When a run on the bus is over, its recordings are where its processes left them.
namespace rave::gui_server {

/// The places as a sentence for people, such as: The recordings of this run are on lab-2 in
/// `/runs/a`, and on lab-3 in `/runs/b`.
[[nodiscard]] std::string places_of(std::span<const watch::KeptAt> kept);

/// A source that plays the recordings of all hosts as one. `machine`: the name of this one; paths
/// of others are not opened, because here they may name something else. Recordings below the folder
/// of the manager are merged there, others in a temporary folder that lasts as long as the source.
/// Error kNotFound, with a sentence for people: one of the hosts is elsewhere, its recording cannot
/// be read, or there is none. Other errors: those of record::merge_records() and open_recording().
[[nodiscard]] Result<std::shared_ptr<Source>> open_kept(std::span<const watch::KeptAt> kept,
                                                        const std::string& machine);

}  // namespace rave::gui_server
