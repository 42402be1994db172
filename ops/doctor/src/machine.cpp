// SPDX-License-Identifier: Apache-2.0
#include "rave/doctor/machine.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <sys/resource.h>
#include <sys/utsname.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <memory>

#include "rave/base/file.hpp"
#include "rave/base/wall_clock.hpp"
#include "socket.hpp"

namespace rave::doctor {
namespace {

constexpr std::size_t kLongest = 4096;

struct FreeAddresses {
  void operator()(::ifaddrs* list) const noexcept { ::freeifaddrs(list); }
};

const ::sockaddr_in* inet_of(const ::sockaddr* address) {
  if (address == nullptr || address->sa_family != AF_INET) return nullptr;
  return reinterpret_cast<const ::sockaddr_in*>(address);
}

std::vector<Interface> interfaces_here() {
  ::ifaddrs* raw = nullptr;
  if (::getifaddrs(&raw) != 0) return {};
  const std::unique_ptr<::ifaddrs, FreeAddresses> list(raw);
  std::vector<Interface> found;
  for (const ::ifaddrs* entry = list.get(); entry != nullptr; entry = entry->ifa_next) {
    const ::sockaddr_in* const address = inet_of(entry->ifa_addr);
    const auto same = [&](const Interface& i) { return i.name == entry->ifa_name; };
    // getifaddrs() has an entry for each address family of an interface. One without an IPv4
    // address is kept only while there is no better one.
    if (address == nullptr && std::ranges::any_of(found, same)) continue;
    Interface interface;
    interface.name = entry->ifa_name;
    interface.up = (entry->ifa_flags & IFF_UP) != 0 && (entry->ifa_flags & IFF_RUNNING) != 0;
    interface.multicast = (entry->ifa_flags & IFF_MULTICAST) != 0;
    interface.loopback = (entry->ifa_flags & IFF_LOOPBACK) != 0;
    if (address != nullptr) {
      interface.address = place_of(*address).address;
      std::erase_if(found, [&](const Interface& i) { return same(i) && i.address.empty(); });
    }
    found.push_back(std::move(interface));
  }
  return found;
}

std::vector<std::uint64_t> numbers_in(const char* file) {
  const auto text = read_file(file, kLongest);
  if (!text) return {};
  std::vector<std::uint64_t> numbers;
  const char* at = text->data();
  const char* const end = at + text->size();
  while (at < end) {
    std::uint64_t number = 0;
    const auto [after, error] = std::from_chars(at, end, number);
    if (error == std::errc()) numbers.push_back(number);
    at = error == std::errc() ? after : at + 1;
  }
  return numbers;
}

}  // namespace

const Interface* Machine::find(std::string_view interface) const noexcept {
  const auto found = std::ranges::find_if(interfaces, [&](const Interface& i) {
    return i.name == interface || (!i.address.empty() && i.address == interface);
  });
  return found == interfaces.end() ? nullptr : &*found;
}

bool Machine::has_address(std::string_view address) const noexcept {
  return std::ranges::any_of(interfaces, [&](const Interface& i) { return i.address == address; });
}

Machine this_machine() {
  Machine machine;
  ::utsname names{};
  if (::uname(&names) == 0) {
    machine.name = names.nodename;
    machine.kernel = names.release;
  }
  machine.interfaces = interfaces_here();
  ::rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) == 0) machine.open_files = files.rlim_cur;
  if (const auto most = numbers_in("/proc/sys/net/core/rmem_max"); !most.empty()) {
    // setsockopt() cuts a larger request silently, so the limit is read here.
    machine.receive_buffer_max = most.front();
  }
  if (const auto range = numbers_in("/proc/sys/net/ipv4/ip_local_port_range"); range.size() == 2) {
    machine.first_handed_out = static_cast<std::uint32_t>(range[0]);
    machine.last_handed_out = static_cast<std::uint32_t>(range[1]);
  }
  if (const char* const uri = std::getenv("CYCLONEDDS_URI")) machine.cyclone_uri = uri;
  machine.now_s = wall_ns() / kSecond_ns;
  return machine;
}

}  // namespace rave::doctor
