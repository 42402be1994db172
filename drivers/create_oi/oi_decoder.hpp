// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rave::oi {

/// A frame of the stream with valid header, length, checksum and packet numbers. Points into the
/// decoder.
struct Frame {
  std::span<const std::uint8_t> body;  ///< Packet number and data of each packet in turn.
  double began_s = 0;                  ///< The time passed with its first byte.
};

/// Extracts frames from the byte stream of a robot: [19][length][number, data...][checksum], where
/// the sum of all bytes, header included, is 0 modulo 256.
///
/// The requested packets are known, so the length is too; a frame is accepted only if its length
/// and packet numbers match. After a missing or surplus byte the search continues at the next 19,
/// so one lost byte costs one frame. The checksum accepts one of 256 corrupted frames; code that
/// integrates values must check their plausibility. Pure; no allocation after construction.
class StreamDecoder {
 public:
  struct Counts {
    std::uint64_t frames = 0;        ///< Frames returned.
    std::uint64_t bad_checksum = 0;  ///< Frames with a wrong checksum.
    /// Frames with a right checksum but other packets than requested.
    std::uint64_t bad_layout = 0;
    std::uint64_t skipped = 0;  ///< Bytes outside of frames.
  };

  /// `packets`: as in stream_command(); packet_size() must know all of them.
  explicit StreamDecoder(std::vector<std::uint8_t> packets);

  /// Adds one byte that arrived at `came_s` in any clock. Returns the frame that it completes,
  /// valid until the next call; null if none.
  [[nodiscard]] const Frame* push(std::uint8_t byte, double came_s);
  /// Discards a partial frame.
  void reset() noexcept;
  [[nodiscard]] const Counts& counts() const noexcept { return counts_; }
  [[nodiscard]] std::span<const std::uint8_t> packets() const noexcept { return packets_; }
  /// Size of a complete frame.
  [[nodiscard]] std::size_t frame_size() const noexcept { return size_; }

 private:
  [[nodiscard]] bool may_begin() const noexcept;
  [[nodiscard]] bool whole_frame();
  [[nodiscard]] bool right_layout() const noexcept;
  void drop(std::size_t count);

  std::vector<std::uint8_t> packets_;
  std::size_t size_ = 0;
  std::vector<std::uint8_t> bytes_;  // at most one frame
  std::vector<double> came_s_;       // time of arrival of each
  bool given_out_ = false;
  Frame frame_;
  Counts counts_;
};

}  // namespace rave::oi
