// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "bytes.hpp"
#include "rave/base/descriptor.hpp"
#include "rave/base/result.hpp"

namespace rave::record {

/// The bytes of a recording: an open file or memory. Read with pread instead of a mapping: a file
/// that is truncated meanwhile causes an error instead of a signal.
class ByteSource {
 public:
  [[nodiscard]] static Result<std::unique_ptr<ByteSource>> open(const std::filesystem::path& path);
  ByteSource(std::string name, ByteSpan bytes) noexcept;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  ~ByteSource();

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
  /// Reads `size` bytes from `offset` into `out`. Errors name file and offset; a range beyond the
  /// end is kParse.
  [[nodiscard]] Status read(std::uint64_t offset, std::uint64_t size, Bytes& out) const;

 private:
  ByteSource(std::string name, int fd, std::uint64_t size) noexcept;

  std::string name_;
  Descriptor file_;
  ByteSpan memory_;
  std::uint64_t size_ = 0;
};

}  // namespace rave::record
