// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "certificate.hpp"

// The two documents of DDS Security, before they are signed. Names in them are checked before, so
// nothing needs to be escaped.
namespace rave::keys {

/// The governance document for all topics in domains 0 to 230: participants must be authenticated,
/// and every packet is encrypted as a whole, also discovery and liveliness.
[[nodiscard]] std::string governance_xml();

/// The permissions document: `subject` may read and write the topics of RAVE in the partitions of
/// runs, and those of ROS 2.
[[nodiscard]] std::string permissions_xml(const std::string& name, const std::string& subject,
                                          const Validity& validity);

}  // namespace rave::keys
