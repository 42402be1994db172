// SPDX-License-Identifier: Apache-2.0
// Noise of many samples at once: what the batches, the vectors and the chain must not change.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "processing_support.hpp"
#include "rave/math/random_batch.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math_testing/each_target.hpp"

namespace rave {
namespace {

constexpr std::uint32_t kCapacity = 1000;

RandomStream stream_of(std::uint32_t sample) {
  return {sample % 7 == 3 ? 8U : 7U, sample / 3, 0x80000002U, sample};
}

/// Samples of one kind, each with its own number of records.
struct Samples {
  std::vector<SampleHeader> headers;
  std::vector<std::vector<std::byte>> records;

  [[nodiscard]] bool operator==(const Samples& other) const {
    if (headers.size() != other.headers.size()) return false;
    for (std::size_t i = 0; i < headers.size(); ++i) {
      if (std::memcmp(&headers[i], &other.headers[i], sizeof(SampleHeader)) != 0) return false;
      if (records[i] != other.records[i]) return false;
    }
    return true;
  }
};

/// `count(i)` records in sample i, made of numbers that fit every kind of record.
template <class Count>
Samples samples_of(ReadingKind kind, std::uint32_t samples, const Count& count) {
  Samples made;
  for (std::uint32_t i = 0; i < samples; ++i) {
    made.headers.push_back(header_of(i, count(i)));
    std::vector<std::byte> records(std::size_t{record_size(kind)} * count(i));
    const bool of_floats = kind == ReadingKind::kRanges;
    for (std::size_t k = 0; k + 8 <= records.size() || (of_floats && k + 4 <= records.size());
         k += of_floats ? 4 : 8) {
      const double value = 0.5 + 0.001 * static_cast<double>(k % 4096);
      const auto single = static_cast<float>(value);
      std::memcpy(&records[k], of_floats ? static_cast<const void*>(&single) : &value,
                  of_floats ? 4 : 8);
    }
    if (of_floats && count(i) > 2) std::memcpy(&records[8], &kNoReturn, 4);
    made.records.push_back(std::move(records));
  }
  return made;
}

void one_by_one(const Processing& chain, Samples& samples) {
  for (std::uint32_t i = 0; i < samples.headers.size(); ++i) {
    chain.apply_noise(samples.headers[i], samples.records[i].data(), stream_of(i));
  }
}

void at_once(const Processing& chain, Samples& samples) {
  std::vector<NoiseItem> items;
  for (std::uint32_t i = 0; i < samples.headers.size(); ++i) {
    items.push_back({&samples.headers[i], samples.records[i].data(), stream_of(i)});
  }
  chain.apply_noise(items);
}

/// All terms that a kind knows, or only some of them.
std::vector<NoiseSpec> noises(ReadingKind kind) {
  using enum ReadingKind;
  const bool angle =
      kind == kPose || kind == kOdometry || kind == kSightings || kind == kNeighbours;
  const bool length = angle || kind == kRanges;
  const bool velocity = kind == kOdometry || kind == kNeighbours || kind == kVelocity;
  std::vector<NoiseSpec> specs;
  for (int which = 1; which < 8; ++which) {
    NoiseSpec spec;
    if ((which & 1) != 0) {
      spec.length_sigma_m = length ? 0.1 : 0;
      spec.angle_sigma_rad = angle ? 0.2 : 0;
      spec.velocity_sigma_mps = velocity ? 0.3 : 0;
    }
    if ((which & 2) != 0) {
      spec.length_quantum_m = length ? 0.01 : 0;
      spec.angle_quantum_rad = angle ? 0.02 : 0;
      spec.velocity_quantum_mps = velocity ? 0.03 : 0;
    }
    if ((which & 4) != 0) spec.dropout_probability = 0.25;
    specs.push_back(spec);
  }
  return specs;
}

constexpr ReadingKind kKinds[] = {ReadingKind::kRanges,     ReadingKind::kSightings,
                                  ReadingKind::kPose,       ReadingKind::kOdometry,
                                  ReadingKind::kNeighbours, ReadingKind::kContact,
                                  ReadingKind::kVelocity,   ReadingKind::kValues};

/// Lengths that end within blocks, vectors and batches, on their ends and far beyond.
std::uint32_t mixed_count(std::uint32_t i) {
  constexpr std::uint32_t kCounts[] = {0, 1, 2, 3, 4, 5, 16, 17, 180, 511, 512, 513, 700, 1000};
  return kCounts[i * 5 % std::size(kCounts)];
}

TEST(NoiseBatch, OfManySamplesIsTheNoiseOfEach) {
  for (const ReadingKind kind : kKinds) {
    for (const NoiseSpec& noise : noises(kind)) {
      const Processing chain = made({.noise = noise}, kind, kCapacity);
      Samples single = samples_of(kind, 60, mixed_count);
      Samples together = single;
      const Samples raw = single;
      one_by_one(chain, single);
      at_once(chain, together);
      EXPECT_TRUE(single == together) << to_string(kind);
      EXPECT_EQ(noise.any(), !(single == raw)) << to_string(kind);
    }
  }
}

TEST(NoiseBatch, HasEqualBitsWithAllInstructions) {
  for (const ReadingKind kind : kKinds) {
    const NoiseSpec noise = noises(kind).back();
    const Processing chain = made({.noise = noise}, kind, kCapacity);
    Samples first;
    const int targets = for_each_target([&](const char* name) {
      Samples samples = samples_of(kind, 60, mixed_count);
      at_once(chain, samples);
      if (first.headers.empty()) first = samples;
      EXPECT_TRUE(samples == first) << to_string(kind) << ", " << name;
    });
    ASSERT_GE(targets, 2) << "a processor with one set of instructions shows nothing";
  }
}

TEST(NoiseBatch, TakesTheNumbersThatTheHeaderNames) {
  std::vector<float> normals(kCapacity);
  std::vector<std::uint32_t> words(kCapacity);
  fill_normal(stream_of(0), normals);
  fill_bits(stream_of(0).at_block(0x80000000U), words);

  std::vector<float> rays(kCapacity, 2.0F);
  SampleHeader header = header_of(0, kCapacity);
  made({.noise = {.length_sigma_m = 0.25}}, ReadingKind::kRanges, kCapacity)
      .apply_noise(header, rays.data(), stream_of(0));
  for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_EQ(rays[i], 2.0F + 0.25F * normals[i]) << i;

  std::fill(rays.begin(), rays.end(), 2.0F);
  made({.noise = {.dropout_probability = 0.125}}, ReadingKind::kRanges, kCapacity)
      .apply_noise(header, rays.data(), stream_of(0));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(rays[i], words[i] < (1U << 29) ? kNoReturn : 2.0F) << i;
  }

  std::vector<NeighbourReading> others(200, NeighbourReading{0, 3, 0, 0, 0, 0});
  header = header_of(0, 200);
  made({.noise = {.length_sigma_m = 0.25, .angle_sigma_rad = 0.125, .velocity_sigma_mps = 0.5}},
       ReadingKind::kNeighbours, 200)
      .apply_noise(header, others.data(), stream_of(0));
  for (std::size_t i = 0; i < others.size(); ++i) {
    ASSERT_EQ(others[i].range_m, static_cast<float>(3 + 0.25 * double{normals[4 * i]})) << i;
    ASSERT_EQ(others[i].bearing_rad, 0.125F * normals[4 * i + 1]) << i;
    ASSERT_EQ(others[i].vx_mps, 0.5F * normals[4 * i + 2]) << i;
    ASSERT_EQ(others[i].vy_mps, 0.5F * normals[4 * i + 3]) << i;
  }
}

TEST(NoiseBatch, RobotsAndSamplesHaveNumbersOfTheirOwn) {
  const Processing chain = made({.noise = {.length_sigma_m = 1}}, ReadingKind::kRanges, 16);
  double neighbours = 0;
  double samples = 0;
  std::vector<float> before(16, 50);
  constexpr int kCount = 20'000;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    std::vector<float> rays[3] = {{}, {}, {}};
    for (std::vector<float>& some : rays) some.assign(16, 50);
    SampleHeader headers[3] = {header_of(0, 16), header_of(0, 16), header_of(0, 16)};
    const NoiseItem items[3] = {{&headers[0], rays[0].data(), RandomStream(1, i, 2, 5)},
                                {&headers[1], rays[1].data(), RandomStream(1, i + 1, 2, 5)},
                                {&headers[2], rays[2].data(), RandomStream(1, i, 2, 6)}};
    chain.apply_noise(items);
    for (std::size_t k = 0; k < 16; ++k) {
      neighbours += (rays[0][k] - 50.0) * (rays[1][k] - 50.0);
      samples += (rays[0][k] - 50.0) * (rays[2][k] - 50.0);
    }
    if (i > 0) {
      ASSERT_EQ(rays[0], before) << "robot " << i;
    }
    before = rays[1];
  }
  EXPECT_NEAR(neighbours / std::sqrt(16.0 * kCount), 0, 5);
  EXPECT_NEAR(samples / std::sqrt(16.0 * kCount), 0, 5);
}

TEST(NoiseBatch, RoundsRaysAsTheFormulaDoes) {
  for (const double quantum_m : {1e-12, 1e-9, 0.001, 0.01, 0.1, 1.0 / 3, 7.0, 1e6}) {
    const Processing chain =
        made({.noise = {.length_quantum_m = quantum_m}}, ReadingKind::kRanges, kCapacity);
    std::vector<float> rays;
    for (std::uint32_t i = 0; i < kCapacity; ++i) {
      rays.push_back(static_cast<float>(i % 2 == 0 ? 0.03125 * i : quantum_m * 0.25 * i));
    }
    std::vector<float> rounded = rays;
    SampleHeader header = header_of(0, kCapacity);
    chain.apply_noise(header, rounded.data(), stream_of(0));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double steps = std::floor(double{rays[i]} / quantum_m + 0.5);
      ASSERT_EQ(rounded[i], static_cast<float>(steps * quantum_m)) << rays[i] << ", " << quantum_m;
    }
  }
}

TEST(NoiseBatch, LeavesWhatIsNoDistanceAndClampsWhatIsBelowZero) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const NoiseSpec& noise :
       {NoiseSpec{.length_sigma_m = 0.1}, NoiseSpec{.length_quantum_m = 0.5},
        NoiseSpec{.length_sigma_m = 0.1, .length_quantum_m = 0.5}}) {
    const Processing chain = made({.noise = noise}, ReadingKind::kRanges, 5);
    float rays[5] = {kNoReturn, -kNoReturn, nan, -5, 1e30F};
    SampleHeader header = header_of(0, 5);
    chain.apply_noise(header, rays, stream_of(0));
    EXPECT_EQ(rays[0], kNoReturn);
    EXPECT_EQ(rays[1], -kNoReturn);
    EXPECT_TRUE(std::isnan(rays[2]));
    EXPECT_EQ(rays[3], 0);
    EXPECT_EQ(rays[4], 1e30F);
  }
}

TEST(NoiseBatch, DropOutReachesBothEnds) {
  for (const double probability : {1.0, 1e-300}) {
    const Processing chain =
        made({.noise = {.dropout_probability = probability}}, ReadingKind::kRanges, kCapacity);
    std::vector<float> rays(kCapacity, 1.0F);
    SampleHeader header = header_of(0, kCapacity);
    chain.apply_noise(header, rays.data(), stream_of(0));
    for (const float range : rays) ASSERT_EQ(range, probability == 1 ? kNoReturn : 1.0F);
  }
}

TEST(NoiseBatch, NoiseBeforeTheRingIsNoiseInTheRing) {
  const ProcessingSpec spec{.noise = {.length_sigma_m = 0.1, .dropout_probability = 0.2},
                            .latency_s = 0.02,
                            .filters = {{.window = 3}}};
  const Processing chain = made(spec, ReadingKind::kRanges, 8);
  EXPECT_FALSE(chain.noise_only());
  std::vector<std::byte> inside = fresh_state(chain);
  std::vector<std::byte> before = fresh_state(chain);
  for (std::uint32_t i = 0; i < 100; ++i) {
    float rays[8] = {1, 2, 3, 4, 5, 6, 7, kNoReturn};
    SampleHeader header = header_of(std::int64_t{i} * 10'000'000, 8);
    chain.push(header, rays, stream_of(i), inside.data());
    chain.apply_noise(header, rays, stream_of(i));
    chain.push_noisy(header, rays, before.data());
    ASSERT_EQ(inside, before) << i;
    SampleHeader delivered;
    float out[8];
    const bool came = chain.deliver({header.stamp_ns}, inside.data(), &delivered, out);
    ASSERT_EQ(came, chain.deliver({header.stamp_ns}, before.data(), &delivered, out));
  }
}

TEST(NoiseBatch, NoiseAloneNeedsNoRing) {
  EXPECT_TRUE(made({.noise = {.length_sigma_m = 0.1}}, ReadingKind::kRanges, 8).noise_only());
  EXPECT_FALSE(made({.latency_s = 0.1}, ReadingKind::kRanges, 8).noise_only());
  EXPECT_FALSE(made({.filters = {{.window = 3}}}, ReadingKind::kRanges, 8).noise_only());
}

}  // namespace
}  // namespace rave
