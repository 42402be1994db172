// SPDX-License-Identifier: Apache-2.0
#include "rave/record/attached_files.hpp"

#include <fmt/format.h>
#include <zstd.h>

#include <optional>
#include <string_view>

namespace rave::record {
namespace {

constexpr std::string_view kFolder = "inputs/";
constexpr std::string_view kEnding = ".zst";
/// The largest file that a scenario may name, an image, has this size.
constexpr std::size_t kMostBytes = std::size_t{512} << 20U;
/// Maps shrink to a few per cent; a higher level costs more time than it saves.
constexpr int kLevel = 3;

/// Digest and name of the file in an attachment of this name.
std::optional<std::pair<std::string, std::string>> parse(std::string_view name) {
  if (!name.starts_with(kFolder) || !name.ends_with(kEnding)) return std::nullopt;
  name.remove_prefix(kFolder.size());
  name.remove_suffix(kEnding.size());
  const std::size_t slash = name.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  return std::pair(std::string(name.substr(0, slash)), std::string(name.substr(slash + 1)));
}

Result<std::string> unpack(const McapReader& reader, const AttachmentInfo& attachment) {
  RAVE_TRY_ASSIGN(const std::string packed, reader.read_attachment(attachment));
  const auto size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  // Also the two numbers that mean an error or an unknown size.
  if (size > kMostBytes) return fail(ErrorCode::kParse, "its size is not plausible");
  std::string content(size, '\0');
  const std::size_t got =
      ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size());
  if (ZSTD_isError(got) != 0 || got != size) {
    return fail(ErrorCode::kParse, "it cannot be decompressed");
  }
  return content;
}

}  // namespace

Status attach_files(const AttachedFiles& files, McapWriter& writer) {
  for (const auto& [digest, file] : files) {
    std::vector<std::byte> packed(ZSTD_compressBound(file.content->size()));
    const std::size_t size = ZSTD_compress(packed.data(), packed.size(), file.content->data(),
                                           file.content->size(), kLevel);
    if (ZSTD_isError(size) != 0) {
      return fail(ErrorCode::kIo, "cannot compress `{}`: {}", file.name, ZSTD_getErrorName(size));
    }
    packed.resize(size);
    RAVE_TRY(writer.add_attachment(fmt::format("{}{}/{}{}", kFolder, digest, file.name, kEnding),
                                   "application/zstd", packed));
  }
  return {};
}

FoundFiles read_attached_files(const McapReader& reader) {
  FoundFiles found;
  for (const AttachmentInfo& attachment : reader.attachments()) {
    auto of = parse(attachment.name);
    if (!of || found.files.contains(of->first)) continue;
    auto content = unpack(reader, attachment);
    if (content) {
      found.files.emplace(std::move(of->first),
                          AttachedFile{std::move(of->second),
                                       std::make_shared<const std::string>(*std::move(content))});
    } else {
      found.damages.push_back(fmt::format("the copy of `{}` in the recording cannot be read: {}",
                                          of->second, content.error().message));
    }
  }
  return found;
}

}  // namespace rave::record
