// SPDX-License-Identifier: Apache-2.0
// What a record says of the parts that it was merged from.
#include <algorithm>

#include "rave/record/merge.hpp"
#include "rave/record/run_info.hpp"

namespace rave::record {

std::string host_of(const McapReader& reader) {
  const StringMap whose = reader.metadata_named(kHostMetadata);
  const auto name = whose.find("name");
  return name == whose.end() ? std::string() : name->second;
}

bool is_merged(const McapReader& reader) {
  return std::ranges::any_of(reader.metadata(), [](const MetadataInfo& metadata) {
    return metadata.name == kPartsMetadata;
  });
}

StringMap merged_files(const McapReader& reader) {
  constexpr std::string_view kFile = "file ";
  StringMap files;
  for (const auto& [key, value] : reader.metadata_named(kPartsMetadata)) {
    if (key.starts_with(kFile)) files[key.substr(kFile.size())] = value;
  }
  return files;
}

std::vector<std::string> missing_parts(const McapReader& reader) {
  std::vector<std::string> missing;
  for (const auto& [key, value] : reader.metadata_named(kPartsMetadata)) {
    if (key.starts_with("note ")) missing.push_back(value);
  }
  return missing;
}

}  // namespace rave::record
