// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <variant>

#include "mcap_file.hpp"
#include "mcap_format.hpp"
#include "rave/record/mcap_writer.hpp"

namespace rave::record {

struct AttachmentJob {
  AttachmentInfo info;
  Bytes data;
};
struct MetadataJob {
  std::string name;
  StringMap entries;
};
using WriteJob = std::variant<std::unique_ptr<Chunk>, AttachmentJob, MetadataJob>;

/// The compression level for this backlog, the chunk included; empty: no compression.
[[nodiscard]] std::optional<int> level_for(const McapWriterOptions& options,
                                           std::size_t backlog_bytes) noexcept;

/// The queue between the producer, who fills the open chunk, and the writing thread.
///
/// `gate_` guards the open chunk. It is a flag that the producer nearly always finds free: the
/// thread takes it only to fetch a chunk that was open for the flush interval, and never waits for
/// it. `mutex_` guards everything else; the producer locks it once per chunk. Order: gate before
/// mutex.
class WriteQueue {
 public:
  WriteQueue(std::unique_ptr<McapFile> file, const McapWriterOptions& options, LogSink* sink);
  WriteQueue(const WriteQueue&) = delete;
  WriteQueue& operator=(const WriteQueue&) = delete;
  ~WriteQueue();
  /// Starts the writing thread. Producer, once, before anything else. Error kIo: the system creates
  /// no thread.
  [[nodiscard]] Status start();

  /// Calls `fill` to append to the open chunk, and queues the chunk when it is full. Producer.
  template <class Fill>
  void append(Fill&& fill) {
    enter();
    fill(*open_);
    if (open_->records.size() >= options_.chunk_bytes) hand_over_waiting();
    leave();
  }
  /// Queues a job after all queued chunks. Producer.
  void push(WriteJob job);
  /// Queues the open chunk and waits until the queue is empty. Producer.
  void drain();
  /// drain(), then the index; ends the thread. Producer, once.
  [[nodiscard]] Status finish(const std::vector<SchemaInfo>& schemas,
                              const std::vector<ChannelInfo>& channels);

  /// The first failed write.
  [[nodiscard]] Status failure();
  void count_dropped() noexcept { dropped_.fetch_add(1, std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(); }
  [[nodiscard]] std::uint64_t waits() const noexcept { return waits_.load(); }

 private:
  using Clock = std::chrono::steady_clock;

  void enter() noexcept {
    while (gate_.test_and_set(std::memory_order_acquire)) std::this_thread::yield();
  }
  void leave() noexcept { gate_.clear(std::memory_order_release); }
  void hand_over_waiting();
  void hand_over(std::unique_lock<std::mutex>& lock);
  void take_open();
  void work();
  [[nodiscard]] Status perform(WriteJob& job, std::size_t backlog_bytes);
  void note_failure(const Error& error);
  void stop();

  McapWriterOptions options_;
  LogSink* sink_;
  std::unique_ptr<McapFile> file_;  ///< Used by the thread only, until it has ended.
  std::atomic_flag gate_;
  std::unique_ptr<Chunk> open_;
  std::atomic<bool> failed_ = false;
  std::atomic<std::uint64_t> dropped_ = 0;
  std::atomic<std::uint64_t> waits_ = 0;
  std::mutex mutex_;
  std::condition_variable work_;  ///< For the thread: a new job, or stop.
  std::condition_variable done_;  ///< For the producer: a job is done.
  std::deque<WriteJob> jobs_;
  std::vector<std::unique_ptr<Chunk>> spare_;
  std::size_t backlog_bytes_ = 0;
  bool busy_ = false;
  bool stop_ = false;
  Clock::time_point next_flush_;
  Error error_;
  std::thread thread_;
};

}  // namespace rave::record
