// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/record/run_record.hpp"

namespace rave::runtime {

/// Forwards log messages to the sink of the run and to its recording. Messages before the recording
/// is opened are kept for it. Any thread.
class ConsoleTee final : public LogSink {
 public:
  explicit ConsoleTee(LogSink* next) : next_(next) {}

  void write(LogLevel level, std::string_view source, std::string_view message) override {
    if (next_ != nullptr) next_->write(level, source, message);
    const std::lock_guard lock(mutex_);
    if (recorder_ != nullptr) {
      recorder_->console(level, source, message);
    } else if (waiting_.size() < kMostWaiting) {
      waiting_.push_back({level, std::string(source), std::string(message)});
    }
  }

  /// Sets the recorder for further messages; null detaches it.
  void attach(record::RunRecorder* recorder) {
    const std::lock_guard lock(mutex_);
    recorder_ = recorder;
    if (recorder == nullptr) return;
    for (const Line& line : waiting_) recorder->console(line.level, line.source, line.message);
    waiting_.clear();
  }

 private:
  static constexpr std::size_t kMostWaiting = 1000;
  struct Line {
    LogLevel level = LogLevel::kInfo;
    std::string source;
    std::string message;
  };
  LogSink* next_;
  std::mutex mutex_;
  record::RunRecorder* recorder_ = nullptr;
  std::vector<Line> waiting_;
};

}  // namespace rave::runtime
