// SPDX-License-Identifier: Apache-2.0
#include "place_finder.hpp"

#include <backtrace.h>
#include <ucontext.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <utility>

#include "one_module.hpp"

namespace rave::isolation {

// The search walks the stack from the innermost frame outwards. It takes the first line that
// belongs to the plug-in and not to a header of a library; if there is none, the first line of the
// plug-in at all. learn() reads the debug information at the start, so that find() need not do
// so inside a signal handler.
struct PlaceFinder::Search {
  PlaceFinder* finder;
  std::uintptr_t pc = 0;              ///< The frame under inspection.
  const char* linker_name = nullptr;  ///< The linker's name of the function that contains `pc`.
  std::size_t size = 0;               ///< The length of the text in `text_` so far.
  bool own = false;  ///< The line is in the author's source, not in a header of a library.
};

namespace {

void ignore_error(void*, const char*, int) {}

bool of_a_library(std::string_view file) {
  return file.starts_with("/usr/") || file.find("/include/rave/") != std::string_view::npos;
}

}  // namespace

void PlaceFinder::learn(const void* address) {
  struct Query {
    PlaceFinder* finder;
    std::uintptr_t address;
  } query{this, reinterpret_cast<std::uintptr_t>(address)};
  visit_all_modules(
      [](dl_phdr_info* info, std::size_t, void* data) {
        const auto& wanted = *static_cast<Query*>(data);
        PlaceFinder& self = *wanted.finder;
        std::size_t count = 0;
        bool found = false;
        std::array<Range, 16> ranges{};
        for (int i = 0; i < info->dlpi_phnum && count < ranges.size(); ++i) {
          const auto& part = info->dlpi_phdr[i];
          if (part.p_type != PT_LOAD || (part.p_flags & PF_X) == 0) continue;
          const Range range{info->dlpi_addr + part.p_vaddr,
                            info->dlpi_addr + part.p_vaddr + part.p_memsz};
          found = found || (range.begin <= wanted.address && wanted.address < range.end);
          ranges[count++] = range;
        }
        if (!found) return 0;
        self.ranges_ = ranges;
        self.range_count_ = count;
        const char* slash = std::strrchr(info->dlpi_name, '/');
        std::snprintf(self.plugin_name_.data(), self.plugin_name_.size(), "%s",
                      slash != nullptr ? slash + 1 : info->dlpi_name);
        return 1;
      },
      &query);
  show_only_module_of(address);
  ensure_state();
  Search search{this};
  // Makes the library read the debug information now, when allocation is safe.
  ::backtrace_pcinfo(state_, query.address, &on_line, &ignore_error, &search);
  ::backtrace_syminfo(state_, query.address, &on_symbol, &ignore_error, &search);
}

std::string_view PlaceFinder::find(const void* interrupted) {
  ensure_state();
  Search search{this};
  ::backtrace_simple(state_, 0, &on_frame, &ignore_error, &search);
  if (search.size == 0) note_return_address(search, interrupted);
  return {text_.data(), search.size};
}

/// A call through a null function pointer leaves no frame that can be unwound, but the address to
/// return to lies on top of the stack.
void PlaceFinder::note_return_address(Search& search, const void* interrupted) {
#if defined(__x86_64__)
  if (interrupted == nullptr) return;
  const auto& registers = static_cast<const ucontext_t*>(interrupted)->uc_mcontext.gregs;
  // The first page is never mapped, so a program counter there comes from a null function pointer,
  // possibly with an offset.
  if (registers[REG_RIP] > 4096) return;
  // What the register holds is an address. NOLINTNEXTLINE(performance-no-int-to-ptr)
  const auto* top = reinterpret_cast<const std::uintptr_t*>(registers[REG_RSP]);
  // The return address is that of the next instruction; one byte before it is still inside the
  // call.
  on_frame(&search, *top - 1);
#else
  static_cast<void>(search);
  static_cast<void>(interrupted);
#endif
}

void PlaceFinder::ensure_state() {
  if (state_ == nullptr) {
    state_ = ::backtrace_create_state(nullptr, 1, &ignore_error, nullptr);
  }
}

bool PlaceFinder::in_plugin(std::uintptr_t pc) const noexcept {
  for (std::size_t i = 0; i < range_count_; ++i) {
    if (ranges_[i].begin <= pc && pc < ranges_[i].end) return true;
  }
  return false;
}

int PlaceFinder::on_frame(void* data, std::uintptr_t pc) {
  Search& search = *static_cast<Search*>(data);
  PlaceFinder& self = *search.finder;
  if (!self.in_plugin(pc)) return 0;
  search.pc = pc;
  search.linker_name = nullptr;
  ::backtrace_syminfo(self.state_, pc, &on_symbol, &ignore_error, &search);
  ::backtrace_pcinfo(self.state_, pc, &on_line, &ignore_error, &search);
  if (search.size == 0) {  // Without debug information: report the file and the linker's name.
    self.note(search, self.plugin_name_.data(), 0, search.linker_name);
  }
  return search.own ? 1 : 0;
}

int PlaceFinder::on_line(void* data, std::uintptr_t, const char* file, int line,
                         const char* function) {
  Search& search = *static_cast<Search*>(data);
  if (file == nullptr || search.pc == 0) return 0;
  const bool own = !of_a_library(file);
  if (own || search.size == 0) {
    // The linker's name contains the class, too. But it names the whole frame, so it is usable only
    // if nothing was inlined there: then it contains the name of the function itself.
    const bool same = search.linker_name != nullptr &&
                      (function == nullptr || std::strstr(search.linker_name, function) != nullptr);
    search.finder->note(search, file, line, same ? search.linker_name : function);
    search.own = own;
  }
  return own ? 1 : 0;
}

void PlaceFinder::on_symbol(void* data, std::uintptr_t, const char* name, std::uintptr_t,
                            std::uintptr_t) {
  static_cast<Search*>(data)->linker_name = name;
}

void PlaceFinder::note(Search& search, const char* file, int line, const char* function) {
  const int size = std::snprintf(text_.data(), text_.size(), "%s\n%d\n%s\n%s", file, line,
                                 function != nullptr ? function : "",
                                 search.linker_name != nullptr ? search.linker_name : "");
  if (size > 0) search.size = std::min(static_cast<std::size_t>(size), text_.size() - 1);
}

}  // namespace rave::isolation
