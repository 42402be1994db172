// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/robot/program.hpp"

namespace rave::isolation {

/// A loaded plug-in and one program of it; the plug-in stays loaded as long as this lives.
class ProgramFile {
 public:
  /// Errors: kNotFound, kParse, kIncompatible, kPlugin.
  [[nodiscard]] static Result<std::unique_ptr<ProgramFile>> load(const std::filesystem::path& file,
                                                                 std::string_view program);
  ~ProgramFile();
  ProgramFile(const ProgramFile&) = delete;
  ProgramFile& operator=(const ProgramFile&) = delete;

  [[nodiscard]] const ProgramOps& ops() const noexcept { return *ops_; }

 private:
  struct Impl;
  explicit ProgramFile(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
  const ProgramOps* ops_ = nullptr;
};

}  // namespace rave::isolation
