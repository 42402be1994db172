// SPDX-License-Identifier: Apache-2.0
// Reads the stamp of a plug-in from its ELF file without loading it: code built for another
// interface must not run at all.
#include "rave/plugin/stamp.hpp"

#include <elf.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>

#include "rave/base/descriptor.hpp"
#include "rave/base/regular_file.hpp"

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

/// The bytes of a plug-in: in memory, or in a file of which only the parts that are asked for are
/// read. Plug-ins with debug symbols have tens of megabytes, and every run reads all their stamps.
class Bytes {
 public:
  explicit Bytes(std::string_view text) : text_(text), size_(text.size()) {}
  /// `file` stays open as long as this object is used.
  Bytes(const Descriptor& file, std::uint64_t size) : file_(file.get()), size_(size) {}

  [[nodiscard]] bool contain(std::uint64_t offset, std::uint64_t size) const {
    return offset <= size_ && size <= size_ - offset;
  }
  [[nodiscard]] tl::unexpected<Error> beyond_end(std::string_view what) const {
    return fail(ErrorCode::kParse, "damaged or cut off: {} beyond the end of the file ({} bytes)",
                what, size_);
  }
  /// Fills `out` with what is at `offset`; beyond_end(what) if the file does not contain it.
  [[nodiscard]] Status read(std::uint64_t offset, std::span<std::byte> out,
                            std::string_view what) const;

  /// A plain struct at an offset without alignment.
  template <class T>
  [[nodiscard]] Result<T> value(std::uint64_t offset, std::string_view what) const {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    RAVE_TRY(read(offset, std::as_writable_bytes(std::span(&value, 1)), what));
    return value;
  }

 private:
  std::string_view text_;
  int file_ = -1;
  std::uint64_t size_ = 0;
};

Status Bytes::read(std::uint64_t offset, std::span<std::byte> out, std::string_view what) const {
  if (!contain(offset, out.size())) return beyond_end(what);
  if (file_ < 0) {
    std::memcpy(out.data(), text_.data() + offset, out.size());
    return {};
  }
  while (!out.empty()) {
    const ssize_t count = ::pread(file_, out.data(), out.size(), static_cast<::off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return fail(ErrorCode::kIo, "cannot be read: {}", std::strerror(errno));
    if (count == 0) return beyond_end(what);  // It was shortened since, by a linker for example.
    out = out.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::uint64_t>(count);
  }
  return {};
}

tl::unexpected<Error> no_stamp() {
  return fail(ErrorCode::kIncompatible,
              "a shared library without the stamp of a RAVE plug-in (section `{}`); a plug-in's "
              "source has one RAVE_PLUGIN(...)",
              kSection);
}

// The file may be anything, so each number in it is checked against the size before it is used.
Result<Elf64_Ehdr> read_header(const Bytes& bytes) {
  const auto magic = bytes.value<std::array<char, SELFMAG>>(0, "the ELF header reaches");
  if (!magic && magic.error().code == ErrorCode::kIo) return tl::unexpected(magic.error());
  if (!magic || std::string_view(magic->data(), SELFMAG) != ELFMAG) {
    return fail(ErrorCode::kParse, "not a shared library (no ELF file)");
  }
  RAVE_TRY_ASSIGN(const auto header, bytes.value<Elf64_Ehdr>(0, "the ELF header reaches"));
  if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_ident[EI_DATA] != ELFDATA2LSB) {
    return fail(ErrorCode::kParse, "not a 64-bit little-endian ELF file");
  }
  if (header.e_type != ET_DYN) {
    return fail(ErrorCode::kParse, "not a shared library (ELF type {}, a shared library has {})",
                header.e_type, ET_DYN);
  }
  if (header.e_machine != kHostMachine) {
    return fail(ErrorCode::kIncompatible,
                "built for another processor (ELF machine {}, this one is {}): rebuild it here",
                header.e_machine, kHostMachine);
  }
  if (header.e_shoff != 0 && header.e_shnum != 0 && header.e_shentsize != sizeof(Elf64_Shdr)) {
    return fail(ErrorCode::kParse, "damaged: its section headers have {} bytes, not {}",
                header.e_shentsize, sizeof(Elf64_Shdr));
  }
  return header;
}

/// Whether the name at `offset` of the table of names is that of the stamp's section. The end of
/// the table also ends a name, so a missing zero cannot cause reads beyond it.
Result<bool> is_stamp_name(const Bytes& bytes, const Elf64_Shdr& names, std::uint64_t offset) {
  if (offset >= names.sh_size) return false;
  // With the zero behind it, unless the table ends there. The table can be long, a name is not.
  std::array<char, kSection.size() + 1> name{};
  const std::size_t size = std::min<std::uint64_t>(name.size(), names.sh_size - offset);
  RAVE_TRY(bytes.read(names.sh_offset + offset, std::as_writable_bytes(std::span(name).first(size)),
                      "its section names reach"));
  return std::string_view(name.data(), std::find(name.begin(), name.end(), '\0')) == kSection;
}

/// The header of the stamp's section; empty if there is none.
Result<std::optional<Elf64_Shdr>> find_section(const Bytes& bytes, const Elf64_Ehdr& header) {
  if (header.e_shoff == 0 || header.e_shnum == 0) return std::optional<Elf64_Shdr>{};
  std::vector<Elf64_Shdr> sections(header.e_shnum);
  RAVE_TRY(bytes.read(header.e_shoff, std::as_writable_bytes(std::span(sections)),
                      "its table of sections reaches"));
  if (header.e_shstrndx >= sections.size()) {
    return bytes.beyond_end("its section names lie");
  }
  const Elf64_Shdr& names = sections[header.e_shstrndx];
  if (!bytes.contain(names.sh_offset, names.sh_size)) {
    return bytes.beyond_end("its section names reach");
  }
  for (const Elf64_Shdr& candidate : sections) {
    // A file with split debug symbols has the section's header without its bytes: SHT_NOBITS.
    if (candidate.sh_type != SHT_PROGBITS) continue;
    RAVE_TRY_ASSIGN(const bool found, is_stamp_name(bytes, names, candidate.sh_name));
    if (found) return candidate;
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

Result<Stamp> stamp_in(const Bytes& bytes) {
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
  RAVE_TRY_ASSIGN(const auto stamp, bytes.value<Stamp>(section->sh_offset, "its stamp reaches"));
  if (stamp.magic != Stamp::kMagic) {
    return fail(ErrorCode::kIncompatible,
                "its stamp is unknown to this version: rebuild it against this installation");
  }
  return stamp;
}

}  // namespace

Result<Stamp> parse_stamp(std::string_view bytes) { return stamp_in(Bytes(bytes)); }

Result<Stamp> read_stamp(const std::filesystem::path& path) {
  RAVE_TRY_ASSIGN(const int opened, open_regular_file(path));
  const Descriptor file(opened);
  const ::off_t size = ::lseek(file.get(), 0, SEEK_END);
  if (size < 0) return fail(ErrorCode::kIo, "cannot be read: {}", std::strerror(errno));
  return stamp_in(Bytes(file, static_cast<std::uint64_t>(size)));
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
