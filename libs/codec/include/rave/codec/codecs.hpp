// SPDX-License-Identifier: Apache-2.0
#pragma once

// All types that a field can have.
#include "rave/codec/container_codecs.hpp"
#include "rave/codec/scalar_codecs.hpp"
#include "rave/codec/struct_codec.hpp"
#include "rave/codec/variant_codec.hpp"
