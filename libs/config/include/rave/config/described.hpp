// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/codec/codecs.hpp"
#include "rave/codec/diagnostics.hpp"
#include "rave/codec/located.hpp"
#include "rave/codec/nodes.hpp"
#include "rave/codec/raw_node.hpp"
#include "rave/codec/visitors.hpp"

// The descriptions of files use these names of the codec library on almost every line.
namespace rave::config {

using codec::CheckContext;
using codec::Codec;
using codec::Diagnostics;
using codec::EnumName;
using codec::EnumTag;
using codec::FieldOptions;
using codec::Located;
using codec::RawNode;
using codec::ReadContext;

}  // namespace rave::config
