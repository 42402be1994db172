// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/bell.hpp"
#include "rave/base/latest.hpp"
#include "rave/base/wall_clock.hpp"
#include "rave/gui_server/source.hpp"

// What passes between the thread of a run and that of the GUI Server, without a lock.
namespace rave::gui_server {

/// For PosesAt::taken_us; any thread.
[[nodiscard]] inline std::uint32_t taken_now_us() {
  return static_cast<std::uint32_t>(wall_ns() / 1000) | 1U;
}

/// A moment of a run. Its memory is used again and again.
struct LivePicture {
  PosesAt poses;
  std::vector<ReadingAt> readings;  ///< The first `reading_count` count.
  std::size_t reading_count = 0;
  /// How the run stands, where this is not known here. Not set: it goes, unless it is held.
  std::optional<PlayState> standing;
  std::uint64_t hosts_revision = 0;
  std::string hosts;  ///< As Source::hosts_json().
};

/// Something that happened, as the engine says it.
struct LiveEvent {
  double t_s = 0;
  int slot = -1;
  std::string kind;
  std::string text;
};

/// What happened in one step, none of which may be left out.
struct LiveNews {
  std::vector<LiveEvent> events;
  /// Bodies that came or moved, as JSON, and the numbers of those that went.
  std::vector<std::pair<std::uint32_t, std::string>> set;
  std::vector<std::uint32_t> gone;
  std::vector<maps::MapTile> tiles;
  LiveNews* next = nullptr;
};

/// News in order, from one thread to another. Neither waits.
class NewsQueue {
 public:
  NewsQueue() = default;
  NewsQueue(const NewsQueue&) = delete;
  NewsQueue& operator=(const NewsQueue&) = delete;
  ~NewsQueue() {
    for (auto& one : take()) one.reset();
  }
  void push(std::unique_ptr<LiveNews> news) noexcept {
    LiveNews* const node = news.release();
    node->next = newest_.load(std::memory_order_relaxed);
    while (!newest_.compare_exchange_weak(node->next, node, std::memory_order_release,
                                          std::memory_order_relaxed)) {
    }
  }
  /// All that was pushed since the last call, the oldest first.
  [[nodiscard]] std::vector<std::unique_ptr<LiveNews>> take() {
    std::vector<std::unique_ptr<LiveNews>> news;
    for (LiveNews* node = newest_.exchange(nullptr, std::memory_order_acquire); node != nullptr;) {
      news.emplace_back(node);
      node = node->next;
    }
    std::reverse(news.begin(), news.end());
    return news;
  }

 private:
  std::atomic<LiveNews*> newest_{nullptr};
};

struct LiveBox {
  /// Makes the picture that was drawn the newest.
  void publish() noexcept {
    pictures.publish();
    bell.ring();
  }

  Latest<LivePicture> pictures;
  Bell bell;               ///< There is a newer picture.
  Latest<Audience> wants;  ///< From the server to the run.
  NewsQueue news;
  std::atomic<double> max_hz{0};  ///< Pictures per second that pages want; 0: none.
};

}  // namespace rave::gui_server
