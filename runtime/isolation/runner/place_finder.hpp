// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

struct backtrace_state;

namespace rave::isolation {

/// Finds the source line at which a thread is inside the plug-in. Usable in a signal handler: it
/// allocates only pages of its own and takes no lock that a program could hold.
class PlaceFinder {
 public:
  /// Treats the loaded segment that contains `address` as the plug-in.
  void learn(const void* address);

  /// `file\nline\nfunction\nframe` (see parse_place) of the innermost frame of the calling thread
  /// that lies in the plug-in; of those inlined or called there the first that is not from a
  /// library's header. Empty if there is none. `interrupted` is the context of a signal. The view
  /// is valid until the next call.
  [[nodiscard]] std::string_view find(const void* interrupted);

 private:
  struct Search;
  static int on_frame(void* data, std::uintptr_t pc);
  static int on_line(void* data, std::uintptr_t pc, const char* file, int line,
                     const char* function);
  static void on_symbol(void* data, std::uintptr_t pc, const char* name, std::uintptr_t value,
                        std::uintptr_t size);
  [[nodiscard]] bool in_plugin(std::uintptr_t pc) const noexcept;
  void ensure_state();
  void note(Search& search, const char* file, int line, const char* function);
  void note_return_address(Search& search, const void* interrupted);

  struct Range {
    std::uintptr_t begin = 0;
    std::uintptr_t end = 0;
  };
  std::array<Range, 16> ranges_{};
  std::size_t range_count_ = 0;
  std::array<char, 256> plugin_name_{};
  std::array<char, 2048> text_{};
  backtrace_state* state_ = nullptr;
};

}  // namespace rave::isolation
