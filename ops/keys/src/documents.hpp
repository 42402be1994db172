// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "certificate.hpp"

// The two documents of DDS Security, before they are signed. Names in them are checked before, so
// nothing needs to be escaped.
namespace rave::keys {

/// For all topics in domains 0 to 230: who is not authenticated is not there, and every packet is
/// encrypted as a whole, discovery and liveliness too.
[[nodiscard]] std::string governance_xml();

/// Lets `subject` read and write the topics of RAVE in the partitions of runs, and those of ROS 2.
[[nodiscard]] std::string permissions_xml(const std::string& name, const std::string& subject,
                                          const Validity& validity);

}  // namespace rave::keys
