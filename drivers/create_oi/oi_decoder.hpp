// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rave::oi {

/// A frame of the stream whose header, length, checksum and packet numbers are right. Points into
/// the decoder.
struct Frame {
  std::span<const std::uint8_t> body;  ///< Packet number and data of each packet in turn.
  double began_s = 0;                  ///< What was given with its first byte.
};

/// Cuts the bytes of a robot into frames of its stream: [19][length][number, data...][checksum],
/// where all bytes together, the header included, sum up to 0 modulo 256.
///
/// As the packets that were asked for are known, so is the length, and a frame is believed only if
/// its length and its packet numbers are those. After a byte too many or too few the search goes on
/// from the next 19, so that one lost byte costs one frame. The checksum lets one in 256 garbled
/// frames pass; whoever integrates values must check that they are possible.
/// Pure; takes no memory once it is made.
class StreamDecoder {
 public:
  struct Counts {
    std::uint64_t frames = 0;        ///< Given out.
    std::uint64_t bad_checksum = 0;  ///< Began like a frame and had a wrong sum.
    std::uint64_t bad_layout = 0;    ///< Had a right sum and other packets than were asked for.
    std::uint64_t skipped = 0;       ///< Bytes that belong to no frame.
  };

  /// `packets`: as in stream_command(), of which packet_size() knows all.
  explicit StreamDecoder(std::vector<std::uint8_t> packets);

  /// Takes one byte that came at `came_s`, any clock. The frame that it completes, valid until the
  /// next call; null if none.
  [[nodiscard]] const Frame* push(std::uint8_t byte, double came_s);
  /// Forgets what has begun.
  void reset() noexcept;
  [[nodiscard]] const Counts& counts() const noexcept { return counts_; }
  [[nodiscard]] std::span<const std::uint8_t> packets() const noexcept { return packets_; }
  /// Bytes of a whole frame.
  [[nodiscard]] std::size_t frame_size() const noexcept { return size_; }

 private:
  [[nodiscard]] bool may_begin() const noexcept;
  [[nodiscard]] bool whole_frame();
  [[nodiscard]] bool right_layout() const noexcept;
  void drop(std::size_t count);

  std::vector<std::uint8_t> packets_;
  std::size_t size_ = 0;
  std::vector<std::uint8_t> bytes_;  // at most one frame
  std::vector<double> came_s_;       // of each of them
  bool given_out_ = false;
  Frame frame_;
  Counts counts_;
};

}  // namespace rave::oi
