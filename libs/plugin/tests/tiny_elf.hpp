// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <elf.h>

#include <cstring>
#include <string>
#include <string_view>

#include "rave/plugin/stamp.hpp"

namespace rave::plugin {

/// The smallest shared library that has a stamp: header, three section headers (none, names,
/// stamp), the names, the stamp. Tests change single fields of it.
struct TinyElf {
  Elf64_Ehdr header{};
  Elf64_Shdr sections[3]{};
  char names[24] = "\0.shstrtab\0.rave_stamp";
  Stamp stamp;

  explicit TinyElf(const Stamp& content) : stamp(content) {
    std::memcpy(header.e_ident, ELFMAG, SELFMAG);
    header.e_ident[EI_CLASS] = ELFCLASS64;
    header.e_ident[EI_DATA] = ELFDATA2LSB;
    header.e_type = ET_DYN;
#if defined(__x86_64__)
    header.e_machine = EM_X86_64;
#elif defined(__aarch64__)
    header.e_machine = EM_AARCH64;
#else
    header.e_machine = EM_RISCV;
#endif
    header.e_shoff = sizeof header;
    header.e_shentsize = sizeof(Elf64_Shdr);
    header.e_shnum = 3;
    header.e_shstrndx = 1;
    const std::size_t after_sections = sizeof header + sizeof sections;
    sections[1].sh_name = 1;
    sections[1].sh_type = SHT_STRTAB;
    sections[1].sh_offset = after_sections;
    sections[1].sh_size = sizeof names;
    sections[2].sh_name = 11;
    sections[2].sh_type = SHT_PROGBITS;
    sections[2].sh_offset = after_sections + sizeof names;
    sections[2].sh_size = sizeof stamp;
  }

  [[nodiscard]] std::string bytes() const {
    std::string out;
    const auto add = [&](const void* data, std::size_t size) {
      out.append(static_cast<const char*>(data), size);
    };
    add(&header, sizeof header);
    add(sections, sizeof sections);
    add(names, sizeof names);
    add(&stamp, sizeof stamp);
    return out;
  }
};

}  // namespace rave::plugin
