// SPDX-License-Identifier: Apache-2.0
// Drives a fuzz target where libFuzzer is not at hand: every file of a corpus folder, then 2000
// mutations of them that are the same in every run. Usage: fuzz_X FOLDER
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr std::size_t kMutations = 2000;

/// SplitMix64. Source: Steele, Lea, Flood: "Fast splittable pseudorandom number generators", 2014.
class Chance {
 public:
  std::size_t below(std::size_t limit) {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return limit == 0 ? 0 : static_cast<std::size_t>((z ^ (z >> 31)) % limit);
  }

 private:
  std::uint64_t state_ = 1;
};

std::vector<std::string> load(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.is_regular_file()) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> inputs;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return inputs;
}

void run(const std::string& input) {
  // A copy of the exact size on the heap, so that a sanitizer sees reads behind the end.
  const std::vector<std::uint8_t> bytes(input.begin(), input.end());
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
}

/// One to four changes: flip a bit, cut a piece, repeat a piece, or insert one of another input.
std::string mutate(std::string text, const std::vector<std::string>& inputs, Chance& chance) {
  const std::size_t changes = 1 + chance.below(4);
  for (std::size_t i = 0; i < changes; ++i) {
    const std::size_t at = chance.below(text.size() + 1);
    const std::size_t length = 1 + chance.below(32);
    switch (chance.below(4)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << chance.below(8)));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      default: {
        const std::string& other = inputs[chance.below(inputs.size())];
        text.insert(at, other.substr(chance.below(other.size() + 1), length));
      }
    }
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
    return 2;
  }
  const std::vector<std::string> inputs = load(argv[1]);
  if (inputs.empty()) {
    std::fprintf(stderr, "no inputs in %s\n", argv[1]);
    return 1;
  }
  for (const std::string& input : inputs) run(input);
  Chance chance;
  for (std::size_t i = 0; i < kMutations; ++i) {
    run(mutate(inputs[chance.below(inputs.size())], inputs, chance));
  }
  std::printf("%zu inputs, ok\n", inputs.size() + kMutations);
  return 0;
}
