// SPDX-License-Identifier: Apache-2.0
#include "rave/plugin/stamp.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tiny_elf.hpp"

namespace rave::plugin {
namespace {

Stamp sample() { return make_stamp(0x1234, 0, " left  right\tlast "); }

std::string problem(const std::string& bytes) {
  const auto stamp = parse_stamp(bytes);
  return stamp ? "no error" : stamp.error().message;
}

std::string problem(const TinyElf& file) { return problem(file.bytes()); }

std::string difference(const Stamp& plugin, const Stamp& host) {
  const Status status = check_stamp(plugin, host);
  return status ? "no difference" : status.error().message;
}

void expect_says(const std::string& message, std::string_view part) {
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(ParseStamp, ReadsWhatWasWritten) {
  const auto stamp = parse_stamp(TinyElf(sample()).bytes());
  ASSERT_TRUE(stamp) << stamp.error().text();
  EXPECT_EQ(stamp->robot_interface, 0x1234U);
  EXPECT_EQ(parse_provides(*stamp), (std::vector<std::string>{"left", "right", "last"}));
}

TEST(ParseStamp, RefusesFilesThatAreNoSharedLibraryOfThisMachine) {
  expect_says(problem(""), "not a shared library (no ELF file)");
  expect_says(problem("#!/bin/sh\n"), "not a shared library (no ELF file)");
  TinyElf file(sample());
  file.header.e_type = ET_REL;
  expect_says(problem(file), "not a shared library (ELF type 1");
  file = TinyElf(sample());
  file.header.e_machine = EM_386;
  expect_says(problem(file), "built for another processor (ELF machine 3");
  file = TinyElf(sample());
  file.header.e_ident[EI_CLASS] = ELFCLASS32;
  expect_says(problem(file), "not a 64-bit little-endian ELF file");
}

TEST(ParseStamp, EveryShorterFileIsRefused) {
  const std::string whole = TinyElf(sample()).bytes();
  ASSERT_EQ(problem(whole), "no error");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(problem(whole.substr(0, size)), "no error") << size;
  }
  expect_says(problem(whole.substr(0, 20)),
              "the ELF header reaches beyond the end of the file (20");
  expect_says(problem(whole.substr(0, 100)), "its table of sections reaches beyond the end");
  expect_says(problem(whole.substr(0, whole.size() - 1)), "its stamp reaches beyond the end");
}

TEST(ParseStamp, NumbersThatOverflowAreRefused) {
  TinyElf file(sample());
  file.header.e_shoff = ~std::uint64_t{0} - 63;
  expect_says(problem(file), "its table of sections reaches beyond the end");
  file = TinyElf(sample());
  file.sections[2].sh_offset = ~std::uint64_t{0} - 100;
  expect_says(problem(file), "its stamp reaches beyond the end");
  file = TinyElf(sample());
  file.sections[1].sh_size = ~std::uint64_t{0};
  expect_says(problem(file), "its section names reach beyond the end");
  file = TinyElf(sample());
  file.header.e_shstrndx = 3;
  expect_says(problem(file), "its section names lie beyond the end");
  file = TinyElf(sample());
  file.header.e_shentsize = 8;
  expect_says(problem(file), "its section headers have 8 bytes, not 64");
}

TEST(ParseStamp, SaysThatThereIsNoUsableStamp) {
  TinyElf file(sample());
  file.names[11] = '_';
  expect_says(problem(file), "without the stamp of a RAVE plug-in");
  file = TinyElf(sample());
  file.sections[2].sh_name = 1000;
  expect_says(problem(file), "without the stamp of a RAVE plug-in");
  file = TinyElf(sample());
  file.sections[2].sh_type = SHT_NOBITS;
  expect_says(problem(file), "without the stamp of a RAVE plug-in");
  file = TinyElf(sample());
  file.header.e_shnum = 0;
  expect_says(problem(file), "without the stamp of a RAVE plug-in");
  file = TinyElf(sample());
  file.sections[2].sh_size = 128;
  expect_says(problem(file), "its stamp has 128 bytes, this version's has 256");
  file = TinyElf(sample());
  file.stamp.magic = 0;
  expect_says(problem(file), "its stamp is unknown to this version");
}

// A file of 1 TiB that takes a few kilobytes on the disk: who reads all of it does not come back.
TEST(ReadStamp, ReadsOfALargeFileOnlyWhereTheStampStands) {
  constexpr std::uint64_t kFar = std::uint64_t{1} << 40;
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / fmt::format("far_{}.so", ::getpid());
  TinyElf file(sample());
  file.header.e_shoff = kFar;
  const std::string bytes = file.bytes();
  {
    std::ofstream out(path, std::ios::binary);
    out << bytes;  // The names and the stamp in front, the table of sections behind the gap.
    out.seekp(static_cast<std::streamoff>(kFar));
    out.write(bytes.data() + sizeof file.header, sizeof file.sections);
    ASSERT_TRUE(out.flush());
  }
  const auto stamp = read_stamp(path);
  ASSERT_TRUE(stamp) << stamp.error().text();
  EXPECT_EQ(parse_provides(*stamp), (std::vector<std::string>{"left", "right", "last"}));
  std::filesystem::resize_file(path, kFar + sizeof file.sections - 1);
  const auto cut = read_stamp(path);
  ASSERT_FALSE(cut);
  expect_says(cut.error().message, "its table of sections reaches beyond the end");
  std::filesystem::remove(path);
}

TEST(ParseProvides, TakesAFieldWithoutATerminatingZero) {
  Stamp stamp = sample();
  for (char& c : stamp.provides) c = 'x';
  EXPECT_EQ(parse_provides(stamp), std::vector<std::string>{std::string(216, 'x')});
  EXPECT_TRUE(parse_provides(make_stamp(1, 0, "")).empty());
}

TEST(CheckStamp, EqualStampsMatchAndTheListOfDriversDoesNotCount) {
  EXPECT_TRUE(check_stamp(sample(), make_stamp(0x1234, 77, "others")));
}

TEST(CheckStamp, SaysWhatDiffersAndWhatToDo) {
  const Stamp host = make_stamp(0x1234, 77, "");
  Stamp plugin = host;
  plugin.robot_interface = 5;
  expect_says(difference(plugin, host), "built for another plug-in interface (0000000000000005");
  expect_says(difference(plugin, host), "rebuild it against this installation");
  plugin = host;
  plugin.virtual_interface = 78;
  expect_says(difference(plugin, host), "built for another interface of virtual drivers");
  expect_says(difference(plugin, sample()), "needs the virtual world, which this program");
  plugin = host;
  plugin.compiler_abi += 1;
  expect_says(difference(plugin, host), "built with another compiler ABI");
  expect_says(difference(plugin, host), "rebuild it with the compiler that built the host");
  plugin = host;
  plugin.alignment = 64;
  expect_says(difference(plugin, host), "built for another alignment (64 bytes");
}

TEST(CheckStamp, NamesTheSanitizerOfEitherSide) {
  Stamp host = sample();
  Stamp plugin = sample();
  host.sanitizer = 0;
  plugin.sanitizer = 1;
  expect_says(difference(plugin, host), "built with the address sanitizer, unlike the host");
  host.sanitizer = 2;
  expect_says(difference(plugin, host),
              "built with the address sanitizer, the host with the thread sanitizer");
  plugin.sanitizer = 0;
  expect_says(difference(plugin, host), "built without a sanitizer, the host with the thread");
}

TEST(CheckStamp, SaysAllDifferencesAtOnce) {
  Stamp plugin = sample();
  plugin.robot_interface = 5;
  plugin.sanitizer = 7;
  expect_says(difference(plugin, sample()), "another plug-in interface");
  expect_says(difference(plugin, sample()), "; built with an unknown sanitizer");
}

}  // namespace
}  // namespace rave::plugin
