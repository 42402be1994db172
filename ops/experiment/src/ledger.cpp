// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment/ledger.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "rave/base/file.hpp"
#include "rave/codec/nodes.hpp"

namespace rave::experiment {

template <class V>
void describe(V& v, RunRow& r) {
  v.required("inputs", r.inputs);
  v.required("seed", r.seed);
  v.field("failure", r.failure);
  v.field("values", r.values);
  v.field("simulated_s", r.simulated_s);
  v.field("hash", r.hash);
  v.field("wall_s", r.wall_s);
}

namespace {

constexpr std::size_t kLargestLedger = std::size_t{1} << 30;

std::string reason() { return std::system_category().message(errno); }

}  // namespace

std::string write_row(const RunRow& row) { return codec::to_json_line(row); }

Result<RunRow> read_row(std::string_view line) { return codec::from_json<RunRow>(line); }

void RunRows::add(RunRow row) {
  auto key = std::pair(row.inputs, row.seed);
  rows_.insert_or_assign(std::move(key), std::move(row));
}

void RunRows::add(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    auto row = end == std::string_view::npos ? Result<RunRow>(fail(ErrorCode::kParse, "cut off"))
                                             : read_row(text.substr(0, end));
    if (row) {
      add(*std::move(row));
    } else {
      ++unreadable_;
    }
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
}

Result<RunRows> RunRows::read(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename();
    if (name.starts_with("ledger") && name.ends_with(".jsonl")) files.push_back(entry->path());
  }
  std::ranges::sort(files);
  RunRows rows;
  for (const auto& file : files) {
    RAVE_TRY_ASSIGN(const std::string text, read_file(file, kLargestLedger));
    rows.add(text);
  }
  return rows;
}

const RunRow* RunRows::find(const std::string& inputs, std::uint64_t seed) const {
  const auto found = rows_.find({inputs, seed});
  return found == rows_.end() ? nullptr : &found->second;
}

Result<Ledger> Ledger::open(const std::filesystem::path& path) {
  Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
  if (!file) return fail(ErrorCode::kIo, "cannot open `{}`: {}", path.string(), reason());
  RAVE_TRY_ASSIGN(const std::string text, read_file(path, kLargestLedger));
  const std::size_t whole = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
  if (whole != text.size() && ::ftruncate(file.get(), static_cast<off_t>(whole)) != 0) {
    return fail(ErrorCode::kIo, "cannot write `{}`: {}", path.string(), reason());
  }
  return Ledger(path, std::move(file));
}

Status Ledger::append(const RunRow& row) {
  const std::string line = write_row(row) + '\n';
  const off_t before = ::lseek(file_.get(), 0, SEEK_END);
  const ssize_t written = ::write(file_.get(), line.data(), line.size());
  if (written == static_cast<ssize_t>(line.size())) return {};
  if (written >= 0) errno = ENOSPC;
  const std::string why = reason();
  // A part of a line would spoil the next one.
  if (before >= 0) static_cast<void>(::ftruncate(file_.get(), before));
  return fail(ErrorCode::kIo, "cannot write `{}`: {}", path_.string(), why);
}

}  // namespace rave::experiment
