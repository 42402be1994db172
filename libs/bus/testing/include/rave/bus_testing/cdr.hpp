// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>
#include <dds/ddsi/ddsi_cdrstream.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rave::bus::testing {

/// A sample that Cyclone's deserialiser made of bytes, with the memory that it allocated.
template <class Message>
class DecodedAs {
 public:
  explicit DecodedAs(const dds_topic_descriptor_t& type) : type_(type.m_ops) {}
  DecodedAs(const DecodedAs&) = delete;
  DecodedAs& operator=(const DecodedAs&) = delete;
  ~DecodedAs() { dds_stream_free_sample(&sample_, type_); }

  /// The two steps that a reader of Cyclone DDS takes with the bytes of a sample: look whether they
  /// follow the type, turning the byte order on the way, and read them. False if they do not.
  [[nodiscard]] bool decode(std::span<const std::byte> bytes, bool swapped = false) {
    constexpr std::uint32_t kXcdr1 = 1;
    // Aligned as a received sample is; normalising writes into it.
    std::vector<std::uint64_t> memory(bytes.size() / sizeof(std::uint64_t) + 1);
    std::ranges::copy(bytes, reinterpret_cast<std::byte*>(memory.data()));
    const auto size = static_cast<std::uint32_t>(bytes.size());
    std::uint32_t end = 0;
    if (dds_stream_normalize_data(reinterpret_cast<char*>(memory.data()), &end, size, swapped,
                                  kXcdr1, type_) == nullptr) {
      return false;
    }
    // Not to be finished, or Cyclone frees memory that is ours.
    dds_istream_t stream;
    dds_istream_init(&stream, size, memory.data(), kXcdr1);
    dds_stream_read(&stream, reinterpret_cast<char*>(&sample_), type_);
    return true;
  }
  [[nodiscard]] const Message& sample() const { return sample_; }

 private:
  const std::uint32_t* type_;
  Message sample_{};
};

/// The bytes of a sample, little endian; none if a sequence is longer than its bound.
template <class Message>
[[nodiscard]] std::vector<std::byte> encode_as(const dds_topic_descriptor_t& type,
                                               const Message& sample) {
  dds_ostreamLE_t stream;
  dds_ostreamLE_init(&stream, 0, 1);
  if (dds_stream_writeLE(&stream, reinterpret_cast<const char*>(&sample), type.m_ops) == nullptr) {
    // Cyclone has freed the stream.
    return {};
  }
  const auto* const start = reinterpret_cast<const std::byte*>(stream.x.m_buffer);
  std::vector<std::byte> bytes(start, start + stream.x.m_index);
  dds_ostreamLE_fini(&stream);
  return bytes;
}

}  // namespace rave::bus::testing
