// SPDX-License-Identifier: Apache-2.0
// Records of several processes are put together, whatever is in them. Two bytes say where the first
// of two files ends.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "rave/record/merge.hpp"
#include "rave/record/robot_ranges.hpp"

namespace {

namespace fs = std::filesystem;

/// For the files; gone with the process.
struct Folder {
  Folder() { fs::create_directories(path); }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  fs::path path = fs::temp_directory_path() / ("rave-fuzz-merge-" + std::to_string(::getpid()));
};

void write(const fs::path& path, const std::uint8_t* data, std::size_t size) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rave::record;
  if (size < 2) return 0;
  static_cast<void>(parse_robot_ranges(
      {reinterpret_cast<const char*>(data), std::min<std::size_t>(size, 40)}, 9));
  const std::size_t first = std::min<std::size_t>(data[0] + 256U * data[1], size - 2);
  static const Folder kKept;
  const fs::path& folder = kKept.path;
  write(folder / "a.mcap", data + 2, first);
  write(folder / "b.mcap", data + 2 + first, size - 2 - first);
  const auto notes = merge_records({folder / "a.mcap", folder / "b.mcap"}, folder / "whole.mcap");
  if (notes) {
    const auto reader = McapReader::open(folder / "whole.mcap");
    if (!reader || !reader->whole() || missing_parts(*reader) != *notes) __builtin_trap();
  }
  return 0;
}
