// SPDX-License-Identifier: Apache-2.0
// The thread that compresses and writes. The producer fills one open chunk; full ones wait here.
// The gate protects the open chunk, the mutex all else, so that a message costs no mutex.
#include "write_queue.hpp"

#include <algorithm>
#include <exception>

#include "rave/base/thread.hpp"

namespace rave::record {
namespace {

/// Compresses at about the speed of memory.
constexpr int kLightLevel = -5;

/// A chunk does not keep the memory of one huge message.
constexpr std::size_t kKeepFactor = 4;

std::size_t waiting_bytes(const WriteJob& job) {
  if (const auto* chunk = std::get_if<std::unique_ptr<Chunk>>(&job)) {
    return (*chunk)->records.size();
  }
  if (const auto* attachment = std::get_if<AttachmentJob>(&job)) return attachment->data.size();
  return 0;
}

}  // namespace

// The run must not wait for its recording. So a writer that falls behind compresses less and less;
// only a full backlog makes the producer wait.
std::optional<int> level_for(const McapWriterOptions& options, std::size_t backlog_bytes) noexcept {
  if (backlog_bytes > options.backlog_bytes / 2) return std::nullopt;
  if (backlog_bytes > options.backlog_bytes / 10) return std::min(options.zstd_level, kLightLevel);
  return options.zstd_level;
}

WriteQueue::WriteQueue(std::unique_ptr<McapFile> file, const McapWriterOptions& options,
                       LogSink* sink)
    : options_(options), sink_(sink), file_(std::move(file)), open_(std::make_unique<Chunk>()) {
  next_flush_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                   std::chrono::duration<double>(options_.flush_interval_s));
}

Status WriteQueue::start() {
  return start_thread(thread_, "the recording", [this] { work(); });
}

WriteQueue::~WriteQueue() { stop(); }

void WriteQueue::hand_over_waiting() {
  std::unique_lock lock(mutex_);
  // A chunk that is larger than the whole backlog passes when the queue is empty; otherwise it
  // would wait for ever.
  const auto room = [this] {
    return backlog_bytes_ == 0 ||
           backlog_bytes_ + open_->records.size() <= options_.backlog_bytes || failed_;
  };
  if (!room()) {
    waits_.fetch_add(1, std::memory_order_relaxed);
    done_.wait(lock, room);
  }
  hand_over(lock);
}

void WriteQueue::hand_over(std::unique_lock<std::mutex>&) {
  if (open_->records.empty()) return;
  backlog_bytes_ += open_->records.size();
  jobs_.emplace_back(std::move(open_));
  // Chunks go round between both threads, so that a run in steady state allocates nothing.
  if (spare_.empty()) {
    open_ = std::make_unique<Chunk>();
    open_->records.reserve(options_.chunk_bytes + options_.chunk_bytes / 4);
  } else {
    open_ = std::move(spare_.back());
    spare_.pop_back();
  }
  work_.notify_one();
}

// Attachments and metadata are few and wait behind the chunks, so the file keeps the order.
void WriteQueue::push(WriteJob job) {
  const std::lock_guard lock(mutex_);
  backlog_bytes_ += waiting_bytes(job);
  jobs_.push_back(std::move(job));
  work_.notify_one();
}

void WriteQueue::take_open() {
  // the producer has the gate: try again later
  if (gate_.test_and_set(std::memory_order_acquire)) return;
  {
    std::unique_lock lock(mutex_);
    hand_over(lock);
  }
  leave();
}

void WriteQueue::drain() {
  enter();
  hand_over_waiting();
  leave();
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return jobs_.empty() && !busy_; });
}

Status WriteQueue::perform(WriteJob& job, std::size_t backlog_bytes) {
  // After a failure nothing more is written: a gap in the file would look like a gap in the run.
  if (failed_) {
    if (const auto* chunk = std::get_if<std::unique_ptr<Chunk>>(&job)) {
      dropped_.fetch_add((*chunk)->entries.size(), std::memory_order_relaxed);
    }
    return {};
  }
  try {
    if (auto* attachment = std::get_if<AttachmentJob>(&job)) {
      return file_->write_attachment(attachment->info, attachment->data);
    }
    if (auto* metadata = std::get_if<MetadataJob>(&job)) {
      return file_->write_metadata(metadata->name, metadata->entries);
    }
    const Chunk& chunk = *std::get<std::unique_ptr<Chunk>>(job);
    Status status = file_->write_chunk(chunk, level_for(options_, backlog_bytes));
    if (!status) dropped_.fetch_add(chunk.entries.size(), std::memory_order_relaxed);
    return status;
  } catch (const std::exception& error) {
    return fail(ErrorCode::kIo, "cannot write the recording: {}", error.what());
  }
}

void WriteQueue::work() {
  const auto interval = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(options_.flush_interval_s));
  std::unique_lock lock(mutex_);
  while (true) {
    work_.wait_until(lock, next_flush_, [this] { return !jobs_.empty() || stop_; });
    if (jobs_.empty() && stop_) return;
    // Nothing has come for a while: what is in the open chunk goes to the file, so that a process
    // that is killed loses at most an interval.
    if (jobs_.empty()) {
      next_flush_ = Clock::now() + interval;
      lock.unlock();
      take_open();
      lock.lock();
      continue;
    }
    WriteJob job = std::move(jobs_.front());
    jobs_.pop_front();
    busy_ = true;
    const std::size_t backlog_bytes = backlog_bytes_;
    lock.unlock();
    // Before perform(): what it counts is still there.
    const std::size_t bytes = waiting_bytes(job);
    const Status status = perform(job, backlog_bytes);
    if (!status) note_failure(status.error());
    lock.lock();
    busy_ = false;
    backlog_bytes_ -= bytes;
    if (auto* chunk = std::get_if<std::unique_ptr<Chunk>>(&job);
        chunk != nullptr && (*chunk)->records.capacity() <= kKeepFactor * options_.chunk_bytes) {
      (*chunk)->clear();
      if (spare_.size() < 4) spare_.push_back(std::move(*chunk));
    }
    done_.notify_all();
  }
}

void WriteQueue::note_failure(const Error& error) {
  {
    const std::lock_guard lock(mutex_);
    error_ = error;
  }
  failed_ = true;
  if (sink_ != nullptr) {
    sink_->error("record", "{}; the run continues, its recording ends here", error.text());
  }
}

Status WriteQueue::failure() {
  if (!failed_.load(std::memory_order_acquire)) return {};
  const std::lock_guard lock(mutex_);
  return tl::unexpected<Error>(error_);
}

void WriteQueue::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  work_.notify_one();
  if (thread_.joinable()) thread_.join();
}

Status WriteQueue::finish(const std::vector<SchemaInfo>& schemas,
                          const std::vector<ChannelInfo>& channels) {
  // First all that is waiting, then the thread, then the summary: it lists what was written.
  drain();
  stop();
  Status status = file_->finish(schemas, channels);
  if (!status && !failed_) note_failure(status.error());
  RAVE_TRY(failure());
  return status;
}

}  // namespace rave::record
