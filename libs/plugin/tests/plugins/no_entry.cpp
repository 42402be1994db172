// SPDX-License-Identifier: Apache-2.0
// A shared library with the stamp of a plug-in and without its entry point.
#include "rave/plugin/stamp.hpp"
#include "rave/robot/interface_hash.hpp"

extern "C" {
extern const rave::plugin::Stamp rave_plugin_stamp;
__attribute__((section(".rave_stamp"), used, aligned(8)))
const rave::plugin::Stamp rave_plugin_stamp =
    rave::plugin::make_stamp(rave::robot_interface_hash(), 0, "no_entry");
}
