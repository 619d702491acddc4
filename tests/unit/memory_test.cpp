// The available memory according to control groups.
#include <catch2/catch_test_macros.hpp>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

#include "support/command.h"

import candela.core;

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t k_unlimited = std::numeric_limits<std::uint64_t>::max();

struct Groups {
    Groups() : mount(scratch_directory()) {}
    void set(const std::string& group, const std::string& file, const std::string& value) const {
        write_file(mount / group / file, value + "\n");
    }
    std::uint64_t left(const std::string& membership) const {
        return candela::memory_left_by_control_groups(mount, write_file(mount / "membership", membership));
    }
    fs::path mount;
};

}  // namespace

TEST_CASE("version 2: the limit minus the used memory is left, except that cached files count as free") {
    const Groups groups;
    groups.set("", "memory.max", "1000000");
    groups.set("", "memory.current", "700000");
    groups.set("", "memory.stat", "anon 300000\nfile 400000\ninactive_file 100000\nactive_file 200000");
    CHECK(groups.left("0::/\n") == 600000);
    groups.set("", "memory.high", "800000");
    CHECK(groups.left("0::/\n") == 400000);
    groups.set("", "memory.max", "max");
    groups.set("", "memory.high", "max");
    CHECK(groups.left("0::/\n") == k_unlimited);
}

TEST_CASE("version 2: the limits of all groups above apply as well") {
    const Groups groups;
    for (const char* const group : {"user.slice", "user.slice/session", "other"}) {
        groups.set(group, "memory.max", "max");
        groups.set(group, "memory.current", "50");
    }
    CHECK(groups.left("0::/user.slice/session\n") == k_unlimited);
    groups.set("other", "memory.max", "60");
    CHECK(groups.left("0::/user.slice/session\n") == k_unlimited);
    groups.set("user.slice", "memory.max", "5000");
    CHECK(groups.left("0::/user.slice/session\n") == 4950);
    groups.set("user.slice/session", "memory.high", "1050");
    CHECK(groups.left("0::/user.slice/session\n") == 1000);
    // More is used than the limit allows.
    groups.set("user.slice/session", "memory.high", "40");
    CHECK(groups.left("0::/user.slice/session\n") == 0);
}

TEST_CASE("version 1: its own files, and in a container the mount's own folder") {
    const Groups groups;
    groups.set("memory/docker/5f1a", "memory.limit_in_bytes", "2000");
    groups.set("memory/docker/5f1a", "memory.usage_in_bytes", "500");
    groups.set("memory/docker/5f1a", "memory.stat", "total_inactive_file 100\ntotal_active_file 0");
    CHECK(groups.left("12:cpu,memory:/docker/5f1a\n0::/\n") == 1600);
    CHECK(groups.left("12:cpu:/docker/5f1a\n") == k_unlimited);
    groups.set("memory", "memory.limit_in_bytes", "1200");
    groups.set("memory", "memory.usage_in_bytes", "300");
    CHECK(groups.left("3:memory:/elsewhere\n") == 900);
}

TEST_CASE("unknown control groups impose no limit") {
    const Groups groups;
    CHECK(groups.left("") == k_unlimited);
    CHECK(groups.left("nonsense\n::\n0:") == k_unlimited);
    CHECK(candela::memory_left_by_control_groups(groups.mount, "/nowhere") == k_unlimited);
    CHECK(candela::available_memory() > 0);
}
