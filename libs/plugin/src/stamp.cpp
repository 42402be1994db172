// SPDX-License-Identifier: Apache-2.0
// Reads the stamp of a plug-in from its ELF file without loading it: code built for another
// interface must not run at all.
#include "rave/plugin/stamp.hpp"

#include <elf.h>

#include <bit>
#include <cstring>
#include <optional>
#include <type_traits>

#include "rave/base/file.hpp"

namespace rave::plugin {
namespace {

static_assert(std::endian::native == std::endian::little, "the stamp is read as little-endian");

#if defined(__x86_64__)
constexpr Elf64_Half kHostMachine = EM_X86_64;
#elif defined(__aarch64__)
constexpr Elf64_Half kHostMachine = EM_AARCH64;
#elif defined(__riscv)
constexpr Elf64_Half kHostMachine = EM_RISCV;
#else
#error "say here which ELF machine number this processor has"
#endif

constexpr std::string_view kSection = ".rave_stamp";

/// The range [offset, offset + size) of `bytes`; empty if it exceeds them.
std::optional<std::string_view> part(std::string_view bytes, std::uint64_t offset,
                                     std::uint64_t size) {
  if (offset > bytes.size() || size > bytes.size() - offset) return std::nullopt;
  return bytes.substr(offset, size);
}

/// A plain struct at an offset without alignment.
template <class T>
std::optional<T> value_at(std::string_view bytes, std::uint64_t offset) {
  static_assert(std::is_trivially_copyable_v<T>);
  const auto raw = part(bytes, offset, sizeof(T));
  if (!raw) return std::nullopt;
  T value;
  std::memcpy(&value, raw->data(), sizeof(T));
  return value;
}

tl::unexpected<Error> damaged(std::string_view bytes, std::string_view what) {
  return fail(ErrorCode::kParse, "damaged or cut off: {} beyond the end of the file ({} bytes)",
              what, bytes.size());
}

tl::unexpected<Error> no_stamp() {
  return fail(ErrorCode::kIncompatible,
              "a shared library without the stamp of a RAVE plug-in (section `{}`); a plug-in's "
              "source has one RAVE_PLUGIN(...)",
              kSection);
}

// The file may be anything, so each number in it is checked against the size before it is used.
Result<Elf64_Ehdr> read_header(std::string_view bytes) {
  if (!bytes.starts_with(std::string_view(ELFMAG, SELFMAG))) {
    return fail(ErrorCode::kParse, "not a shared library (no ELF file)");
  }
  const auto header = value_at<Elf64_Ehdr>(bytes, 0);
  if (!header) return damaged(bytes, "the ELF header reaches");
  if (header->e_ident[EI_CLASS] != ELFCLASS64 || header->e_ident[EI_DATA] != ELFDATA2LSB) {
    return fail(ErrorCode::kParse, "not a 64-bit little-endian ELF file");
  }
  if (header->e_type != ET_DYN) {
    return fail(ErrorCode::kParse, "not a shared library (ELF type {}, a shared library has {})",
                header->e_type, ET_DYN);
  }
  if (header->e_machine != kHostMachine) {
    return fail(ErrorCode::kIncompatible,
                "built for another processor (ELF machine {}, this one is {}): rebuild it here",
                header->e_machine, kHostMachine);
  }
  if (header->e_shoff != 0 && header->e_shnum != 0 && header->e_shentsize != sizeof(Elf64_Shdr)) {
    return fail(ErrorCode::kParse, "damaged: its section headers have {} bytes, not {}",
                header->e_shentsize, sizeof(Elf64_Shdr));
  }
  return *header;
}

/// Whether the name at `offset` of the table of names is that of the stamp's section. The end of
/// the table also ends a name, so a missing zero cannot cause reads beyond it.
bool is_stamp_name(std::string_view names, std::uint64_t offset) {
  if (offset >= names.size()) return false;
  const std::string_view rest = names.substr(offset);
  return rest.substr(0, rest.find('\0')) == kSection;
}

/// The header of the stamp's section; empty if there is none.
Result<std::optional<Elf64_Shdr>> find_section(std::string_view bytes, const Elf64_Ehdr& header) {
  if (header.e_shoff == 0 || header.e_shnum == 0) return std::optional<Elf64_Shdr>{};
  // At most 65535 headers of 64 bytes: the product cannot overflow.
  const auto table = part(bytes, header.e_shoff, header.e_shnum * sizeof(Elf64_Shdr));
  if (!table) return damaged(bytes, "its table of sections reaches");
  const auto section = [&](std::uint64_t index) {
    return value_at<Elf64_Shdr>(*table, index * sizeof(Elf64_Shdr));
  };
  const auto names_header = section(header.e_shstrndx);
  if (!names_header) return damaged(bytes, "its section names lie");
  const auto names = part(bytes, names_header->sh_offset, names_header->sh_size);
  if (!names) return damaged(bytes, "its section names reach");
  for (std::uint64_t i = 0; i < header.e_shnum; ++i) {
    const auto candidate = section(i);
    // A file with split debug symbols has the section's header without its bytes: SHT_NOBITS.
    if (candidate && candidate->sh_type == SHT_PROGBITS &&
        is_stamp_name(*names, candidate->sh_name)) {
      return candidate;
    }
  }
  return std::optional<Elf64_Shdr>{};
}

std::string_view sanitizer_name(std::uint32_t sanitizer) {
  switch (sanitizer) {
    case 0:
      return "without a sanitizer";
    case 1:
      return "with the address sanitizer";
    case 2:
      return "with the thread sanitizer";
    default:
      return "with an unknown sanitizer";
  }
}

std::string sanitizer_difference(std::uint32_t plugin, std::uint32_t host) {
  if (host == 0) {
    return fmt::format("built {}, unlike the host: rebuild it without", sanitizer_name(plugin));
  }
  return fmt::format("built {}, the host {}: rebuild it as its host is", sanitizer_name(plugin),
                     sanitizer_name(host));
}

std::string virtual_difference(std::uint64_t plugin, std::uint64_t host) {
  if (host == 0) {
    return "it needs the virtual world, which this program does not have: load it into a host";
  }
  return fmt::format(
      "built for another interface of virtual drivers ({:016x}, the host has {:016x}): rebuild it "
      "against this installation",
      plugin, host);
}

}  // namespace

Result<Stamp> parse_stamp(std::string_view bytes) {
  RAVE_TRY_ASSIGN(const Elf64_Ehdr header, read_header(bytes));
  RAVE_TRY_ASSIGN(const std::optional<Elf64_Shdr> section, find_section(bytes, header));
  if (!section) return no_stamp();
  // The size first: an older or newer stamp has its fields elsewhere.
  if (section->sh_size != sizeof(Stamp)) {
    return fail(ErrorCode::kIncompatible,
                "its stamp has {} bytes, this version's has {}: rebuild it against this "
                "installation",
                section->sh_size, sizeof(Stamp));
  }
  const auto stamp = value_at<Stamp>(bytes, section->sh_offset);
  if (!stamp) return damaged(bytes, "its stamp reaches");
  if (stamp->magic != Stamp::kMagic) {
    return fail(ErrorCode::kIncompatible,
                "its stamp is unknown to this version: rebuild it against this installation");
  }
  return *stamp;
}

Result<Stamp> read_stamp(const std::filesystem::path& path) {
  RAVE_TRY_ASSIGN(const std::string bytes, read_file(path));
  return parse_stamp(bytes);
}

std::vector<std::string> parse_provides(const Stamp& stamp) {
  constexpr std::string_view kBlanks = " \t\r\n";
  std::string_view text(stamp.provides, sizeof stamp.provides);
  text = text.substr(0, text.find('\0'));
  std::vector<std::string> names;
  while (true) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return names;
    text.remove_prefix(begin);
    const std::string_view name = text.substr(0, text.find_first_of(kBlanks));
    names.emplace_back(name);
    text.remove_prefix(name.size());
  }
}

Status check_stamp(const Stamp& plugin, const Stamp& host) {
  std::string differences;
  // All differences at once: one rebuild should settle all of them.
  const auto add = [&](std::string_view text) {
    if (!differences.empty()) differences += "; ";
    differences += text;
  };
  if (plugin.robot_interface != host.robot_interface) {
    add(
        fmt::format("built for another plug-in interface ({:016x}, the host has {:016x}): rebuild "
                    "it against this installation",
                    plugin.robot_interface, host.robot_interface));
  }
  // 0: a plug-in without virtual drivers, which does not care about that interface.
  if (plugin.virtual_interface != 0 && plugin.virtual_interface != host.virtual_interface) {
    add(virtual_difference(plugin.virtual_interface, host.virtual_interface));
  }
  if (plugin.compiler_abi != host.compiler_abi) {
    add(
        fmt::format("built with another compiler ABI ({}, the host has {}): rebuild it with the "
                    "compiler that built the host",
                    plugin.compiler_abi, host.compiler_abi));
  }
  if (plugin.alignment != host.alignment) {
    add(
        fmt::format("built for another alignment ({} bytes, the host has {}): rebuild it with the "
                    "host's processor flags",
                    plugin.alignment, host.alignment));
  }
  if (plugin.sanitizer != host.sanitizer) {
    add(sanitizer_difference(plugin.sanitizer, host.sanitizer));
  }
  if (differences.empty()) return {};
  return fail(ErrorCode::kIncompatible, "{}", differences);
}

}  // namespace rave::plugin
