// SPDX-License-Identifier: Apache-2.0
#pragma once

// All types that a field can have.
#include "rave/config/container_codecs.hpp"
#include "rave/config/scalar_codecs.hpp"
#include "rave/config/struct_codec.hpp"
