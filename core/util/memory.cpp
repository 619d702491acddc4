module;

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

module candela.util;

namespace candela {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t k_unlimited = std::numeric_limits<std::uint64_t>::max();

/// The number in a file; none for "max", or if the file does not exist.
std::optional<std::uint64_t> number_in(const fs::path& file) {
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

/// Of the bytes that a group uses, those that the kernel would discard rather than deny memory: cached files.
std::uint64_t droppable_in(const fs::path& group, std::string_view prefix) {
    std::uint64_t droppable = 0;
    std::ifstream in(group / "memory.stat");
    std::string name;
    for (std::uint64_t bytes = 0; in >> name >> bytes;) {
        if (name == fmt::format("{}inactive_file", prefix) || name == fmt::format("{}active_file", prefix))
            droppable += bytes;
    }
    return droppable;
}

struct GroupFiles {
    std::array<const char*, 2> limits;
    const char* used;
    const char* stat_prefix;
};
// Above memory.high, a group is throttled until it is unusable.
constexpr GroupFiles k_version_2 = {{"memory.max", "memory.high"}, "memory.current", ""};
constexpr GroupFiles k_version_1 = {
    {"memory.limit_in_bytes", "memory.memsw.limit_in_bytes"}, "memory.usage_in_bytes", "total_"};

/// The memory that one group leaves.
std::uint64_t left_in(const fs::path& group, const GroupFiles& files) {
    std::uint64_t limit = k_unlimited;
    for (const char* const name : files.limits) {
        if (const auto number = number_in(group / name)) limit = std::min(limit, *number);
    }
    const auto used = limit != k_unlimited ? number_in(group / files.used) : std::nullopt;
    return used ? left_of(limit, left_of(*used, droppable_in(group, files.stat_prefix))) : k_unlimited;
}

/// A limit applies to all groups below it.
std::uint64_t left_in_group_and_above(const fs::path& mount, const fs::path& group, const GroupFiles& files) {
    std::uint64_t left = left_in(mount, files);
    fs::path at = mount;
    for (const fs::path& part : group.relative_path()) {
        at /= part;
        left = std::min(left, left_in(at, files));
    }
    return left;
}

std::uint64_t of_address_space() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return k_unlimited;
    const auto pages = number_in("/proc/self/statm");
    return pages ? left_of(limit.rlim_cur, *pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)))
                 : limit.rlim_cur;
}

}  // namespace

std::uint64_t memory_left_by_control_groups(const fs::path& mount, const fs::path& membership) {
    std::uint64_t left = k_unlimited;
    std::ifstream in(membership);
    // "0::/user.slice/session" (version 2), "4:cpu,memory:/docker/5f1a" (version 1). In a container, the path
    // may be one outside it, of which only the mount's own folder is visible.
    for (std::string line; std::getline(in, line);) {
        const std::size_t first = line.find(':');
        const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = ',' + line.substr(first + 1, second - first - 1) + ',';
        const fs::path group = line.substr(second + 1);
        if (controllers == ",,") {
            // If both versions are mounted, version 2 has its own folder.
            for (const fs::path& at : {mount, mount / "unified"})
                left = std::min(left, left_in_group_and_above(at, group, k_version_2));
        } else if (controllers.find(",memory,") != std::string::npos) {
            left = std::min(left, left_in_group_and_above(mount / "memory", group, k_version_1));
        }
    }
    return left;
}

std::uint64_t available_memory() {
    return std::min({of_machine(), memory_left_by_control_groups("/sys/fs/cgroup", "/proc/self/cgroup"),
                     of_address_space()});
}

void require_memory(std::uint64_t bytes, std::string_view what) {
    constexpr std::uint64_t k_worth_a_look = 64'000'000;
    constexpr std::uint64_t k_reserve = 128'000'000;  // for small allocations
    static std::atomic<std::uint64_t> unseen{0};
    if (bytes < k_worth_a_look && unseen.fetch_add(bytes) + bytes < k_worth_a_look) return;
    unseen = 0;
    const std::uint64_t available = available_memory();
    if (bytes <= left_of(available, k_reserve)) return;
    throw MemoryShortage(
        fmt::format("{} needs {} of memory; {} are available", what, size_text(bytes), size_text(available)));
}

}  // namespace candela
