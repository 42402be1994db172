// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/mcap_writer.hpp"

// Files that a run read, inside its recording: compressed attachments named by their digest.
namespace rave::record {

struct AttachedFile {
  std::string name;                            ///< Without folders.
  std::shared_ptr<const std::string> content;  ///< Shared with who read it; never changes.
};

/// SHA-256 in hexadecimal to the file with that content.
using AttachedFiles = std::map<std::string, AttachedFile>;

/// Writes the attachments `inputs/<SHA-256>/<name>.zst`. Errors: those of McapWriter.
Status attach_files(const AttachedFiles& files, McapWriter& writer);

/// What was found of them in a recording.
struct FoundFiles {
  AttachedFiles files;  ///< The digests are not verified here; each attachment has a checksum.
  std::vector<std::string> damages;  ///< One sentence for each that cannot be read.
};
[[nodiscard]] FoundFiles read_attached_files(const McapReader& reader);

}  // namespace rave::record
