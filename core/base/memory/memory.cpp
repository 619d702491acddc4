module;

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

module candela.memory;

import candela.diagnostics;
import candela.text;

namespace candela {

namespace {

constexpr std::uint64_t k_unlimited = std::numeric_limits<std::uint64_t>::max();

/// The number in a file; none for "max", or if there is no such file.
std::optional<std::uint64_t> number_in(const char* file) {
    std::ifstream in(file);
    std::uint64_t number = 0;
    return in >> number ? std::optional(number) : std::nullopt;
}

std::uint64_t left_of(std::uint64_t limit, std::uint64_t used) { return limit > used ? limit - used : 0; }

std::uint64_t of_machine() {
    std::ifstream in("/proc/meminfo");
    std::string name, unit;
    std::uint64_t kilobytes = 0;
    while (in >> name >> kilobytes) {
        if (name == "MemAvailable:") return kilobytes * 1024;
        std::getline(in, unit);
    }
    return k_unlimited;
}

/// Version 2, as containers see it; usage includes cached files that could be dropped.
std::uint64_t of_control_group() {
    const auto limit = number_in("/sys/fs/cgroup/memory.max");
    const auto used = number_in("/sys/fs/cgroup/memory.current");
    if (!limit || !used) return k_unlimited;
    std::uint64_t droppable = 0;
    std::ifstream in("/sys/fs/cgroup/memory.stat");
    std::string name;
    for (std::uint64_t bytes = 0; in >> name >> bytes;) {
        if (name == "inactive_file" || name == "active_file") droppable += bytes;
    }
    return left_of(*limit, left_of(*used, droppable));
}

std::uint64_t of_address_space() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return k_unlimited;
    const auto pages = number_in("/proc/self/statm");
    return pages ? left_of(limit.rlim_cur, *pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)))
                 : limit.rlim_cur;
}

}  // namespace

std::uint64_t available_memory() { return std::min({of_machine(), of_control_group(), of_address_space()}); }

void require_memory(std::uint64_t bytes, std::string_view what) {
    constexpr std::uint64_t k_worth_a_look = 64'000'000;
    constexpr std::uint64_t k_reserve = 128'000'000;  // for everything small
    static std::atomic<std::uint64_t> unseen{0};
    if (bytes < k_worth_a_look && unseen.fetch_add(bytes) + bytes < k_worth_a_look) return;
    unseen = 0;
    const std::uint64_t available = available_memory();
    if (bytes <= left_of(available, k_reserve)) return;
    throw Error(ErrorCategory::failure, fmt::format("{} needs {} of memory; {} are available", what,
                                                    size_text(bytes), size_text(available)));
}

}  // namespace candela
