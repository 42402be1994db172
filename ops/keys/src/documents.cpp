// SPDX-License-Identifier: Apache-2.0
#include "documents.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

namespace rave::keys {
namespace {

constexpr std::string_view kHead = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
/// Cyclone DDS refuses a range that ends above 230.
constexpr std::string_view kDomains =
    "<domains><id_range><min>0</min><max>230</max></id_range></domains>";

std::string element(std::string_view name, std::string_view content) {
  return fmt::format("<{0}>{1}</{0}>\n", name, content);
}

/// Without a time zone it means UTC, and all vendors can read it.
std::string xml_moment(std::int64_t moment_s) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(moment_s));
}

/// The same topics for reading and writing. Each has a rule of its own, because some vendors accept
/// one element of a kind only.
std::string allow(const std::string& topics, std::string_view partition) {
  const std::string what =
      element("topics", topics) + element("partitions", element("partition", partition));
  return element("allow_rule",
                 std::string(kDomains) + element("publish", what) + element("subscribe", what));
}

}  // namespace

std::string governance_xml() {
  // Packets are encrypted as a whole, so their parts need no second encryption.
  const std::string topic =
      element("topic_expression", "*") + element("enable_discovery_protection", "true") +
      element("enable_liveliness_protection", "true") +
      element("enable_read_access_control", "true") +
      element("enable_write_access_control", "true") + element("metadata_protection_kind", "NONE") +
      element("data_protection_kind", "NONE");
  const std::string rule = std::string(kDomains) +
                           element("allow_unauthenticated_participants", "false") +
                           element("enable_join_access_control", "true") +
                           element("discovery_protection_kind", "ENCRYPT") +
                           element("liveliness_protection_kind", "ENCRYPT") +
                           element("rtps_protection_kind", "ENCRYPT") +
                           element("topic_access_rules", element("topic_rule", topic));
  return std::string(kHead) +
         element("dds", element("domain_access_rules", element("domain_rule", rule)));
}

std::string permissions_xml(const std::string& name, const std::string& subject,
                            const Validity& validity) {
  const std::string ros = element("topic", "rt/*") + element("topic", "ros_discovery_info");
  const std::string grant =
      element("subject_name", subject) +
      element("validity", element("not_before", xml_moment(validity.from_s)) +
                              element("not_after", xml_moment(validity.until_s))) +
      allow(element("topic", "rave/*"), "rave/*") + allow(ros, "*") + element("default", "DENY");
  return std::string(kHead) +
         element("dds", element("permissions",
                                fmt::format("<grant name=\"{}\">\n{}</grant>\n", name, grant)));
}

}  // namespace rave::keys
