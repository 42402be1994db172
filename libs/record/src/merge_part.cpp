// SPDX-License-Identifier: Apache-2.0
#include "merge_part.hpp"

#include <string_view>
#include <utility>
#include <vector>

#include "rave/record/merge.hpp"
#include "rave/record/run_record.hpp"

namespace rave::record {

void MergePart::advance() {
  auto next = cursor.next();
  if (!next) torn = next.error().message;
  more = next && *next;
}

Result<std::unique_ptr<MergePart>> open_part(const std::filesystem::path& path) {
  RAVE_TRY_ASSIGN(auto reader, McapReader::open(path));
  auto info = read_run_info(reader);
  if (!info) {
    return tl::unexpected(std::move(info).error().with_context(path.string()));
  }
  auto end = read_run_end(reader);
  MomentCursor cursor(reader, {topic::kPoses, topic::kPercepts, topic::kCommands, topic::kActuators,
                               topic::kRadio, topic::kEvents, topic::kInputs, topic::kHash,
                               topic::kConsole, topic::kChat, topic::kVariances});
  std::string host = host_of(reader);
  auto part = std::make_unique<MergePart>(MergePart{path, std::move(host), std::move(reader),
                                                    *std::move(info), end, std::move(cursor)});
  if (!part->end) part->torn = "its end is missing";
  if (!part->reader.damages().empty()) part->torn = part->reader.damages().front();
  return part;
}

}  // namespace rave::record
