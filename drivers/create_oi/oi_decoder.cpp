// SPDX-License-Identifier: Apache-2.0
#include "create_oi/oi_decoder.hpp"

#include <numeric>
#include <utility>

#include "create_oi/oi_code.hpp"

namespace rave::oi {

namespace {

std::size_t size_with(std::span<const std::uint8_t> packets) {
  // Header, length and checksum. The packets are known, so the size of a frame is known as well.
  std::size_t size = 3;
  for (const std::uint8_t id : packets) size += 1 + packet_size(id);
  return size;
}

}  // namespace

StreamDecoder::StreamDecoder(std::vector<std::uint8_t> packets)
    : packets_(std::move(packets)), size_(size_with(packets_)) {
  bytes_.reserve(size_);
  came_s_.reserve(size_);
}

void StreamDecoder::reset() noexcept {
  bytes_.clear();
  came_s_.clear();
  given_out_ = false;
}

void StreamDecoder::drop(std::size_t count) {
  const auto gone = static_cast<std::ptrdiff_t>(count);
  bytes_.erase(bytes_.begin(), bytes_.begin() + gone);
  came_s_.erase(came_s_.begin(), came_s_.begin() + gone);
}

bool StreamDecoder::may_begin() const noexcept {
  // The length byte makes a 19 inside of data less likely to be taken for a beginning.
  return bytes_[0] == kStreamHeader && (bytes_.size() < 2 || bytes_[1] == size_ - 3);
}

bool StreamDecoder::right_layout() const noexcept {
  std::size_t at = 2;
  for (const std::uint8_t id : packets_) {
    if (bytes_[at] != id) return false;
    at += 1 + packet_size(id);
  }
  return true;
}

bool StreamDecoder::whole_frame() {
  // All bytes of a frame with its header and checksum sum up to 0 modulo 256.
  if (std::accumulate(bytes_.begin(), bytes_.end(), 0U) % 256 != 0) {
    ++counts_.bad_checksum;
    return false;
  }
  if (!right_layout()) {
    ++counts_.bad_layout;
    return false;
  }
  return true;
}

const Frame* StreamDecoder::push(std::uint8_t byte, double came_s) {
  if (given_out_) reset();
  bytes_.push_back(byte);
  came_s_.push_back(came_s);
  while (!bytes_.empty()) {
    if (may_begin()) {
      if (bytes_.size() < size_) return nullptr;
      if (whole_frame()) {
        ++counts_.frames;
        given_out_ = true;
        frame_ = {std::span(bytes_).subspan(2, size_ - 3), came_s_.front()};
        return &frame_;
      }
    }
    ++counts_.skipped;
    // One byte, not the whole frame: a frame may begin among the bytes of a wrong one. So a lost
    // byte costs a single frame.
    drop(1);
  }
  return nullptr;
}

}  // namespace rave::oi
