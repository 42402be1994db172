// SPDX-License-Identifier: Apache-2.0
// A shared library with the entry point of a plug-in and without its stamp.
#include "rave/plugin/registry.hpp"

extern "C" __attribute__((visibility("default"))) void rave_register_plugin(rave::RegistrySink*);
extern "C" void rave_register_plugin(rave::RegistrySink*) {}
