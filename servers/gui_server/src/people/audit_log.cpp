// SPDX-License-Identifier: Apache-2.0
#include "people/audit_log.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "rave/base/descriptor.hpp"
#include "rave/base/file.hpp"

namespace rave::gui_server {
namespace {

namespace fs = std::filesystem;
constexpr const char* kFile = "audit.jsonl";
constexpr std::size_t kLongestField = 200;
/// By the last line a file is longer than its limit.
constexpr std::uintmax_t kMostOver = 65'536;

}  // namespace

void AuditLog::note(std::string_view what, Fields fields) {
  if (folder_.empty()) return;
  const auto now =
      std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
  nlohmann::ordered_json line = {{"time", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", now)},
                                 {"what", what}};
  for (const auto& [name, value] : fields) {
    if (!value.empty()) line[std::string(name)] = value.substr(0, kLongestField);
  }
  // What strangers typed may be no UTF-8.
  const std::string text =
      line.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  const std::lock_guard lock(mutex_);
  if (is_too_many(what, fields)) return;
  turn_over();
  const Descriptor file(
      ::open((folder_ / kFile).c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
  const bool written =
      file && ::write(file.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size());
  ++(written ? written_ : lost_);
}

std::uint64_t AuditLog::written() const {
  const std::lock_guard lock(mutex_);
  return written_;
}

AuditPage AuditLog::read(const AuditFilter& filter) const {
  AuditPage page;
  // Without the lock, which the server's thread may need: a file that is turned over meanwhile has
  // its lines once more or not at all.
  for (int n = 0; keeps() && n <= kOlderOnes && !page.more; ++n) {
    const auto file = folder_ / (n == 0 ? std::string(kFile) : fmt::format("audit.{}.jsonl", n));
    if (const auto text = read_file(file, most_bytes_ + kMostOver)) {
      add_audit_lines(*text, filter, page);
    }
  }
  return page;
}

std::uint64_t AuditLog::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

bool AuditLog::is_too_many(std::string_view what, Fields fields) {
  if (what != "refused" && what != "cut_off") return false;
  // Strangers by their network, others by their name, which no network looks like.
  std::string who;
  for (const auto& [name, value] : fields) {
    if (name == "from") who = web::network_of(std::string(value));
    if (name == "user" && who.empty()) who = fmt::format("user {}", value);
  }
  if (who.empty()) return false;
  // Apart from refusals, which come before a page is cut off and would use up its place.
  if (what == "cut_off") who = "cut off " + who;
  return !refusals_.take(who, web::RateLimit::Clock::now());
}

void AuditLog::turn_over() {
  std::error_code error;
  const auto size = fs::file_size(folder_ / kFile, error);
  if (error || size < most_bytes_) return;
  const auto older = [this](int n) { return folder_ / fmt::format("audit.{}.jsonl", n); };
  for (int n = kOlderOnes; n > 1; --n) fs::rename(older(n - 1), older(n), error);
  fs::rename(folder_ / kFile, older(1), error);
}

}  // namespace rave::gui_server
