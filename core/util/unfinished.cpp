module;

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <random>
#include <string>

module candela.util;

import :unfinished;

namespace candela {

namespace {

// If more files are written at once than there are slots, the rest are written as well, but a signal handler
// will not find them.
constinit std::array<std::atomic<std::string*>, 256> unfinished{};
static_assert(std::atomic<std::string*>::is_always_lock_free, "a signal handler must not wait");

std::string new_name(const std::filesystem::path& directory) {
    std::random_device random;
    const std::uint64_t number = (std::uint64_t{random()} << 32) | random();
    // Not derived from the file's own name, which may already have the maximum length.
    return (directory / fmt::format(".candela-{:016x}", number)).string();
}

}  // namespace

UnfinishedName::UnfinishedName(const std::filesystem::path& directory)
    : name_(std::make_unique<std::string>(new_name(directory))) {
    for (std::atomic<std::string*>& slot : unfinished) {
        std::string* expected = nullptr;
        if (slot.compare_exchange_strong(expected, name_.get())) {
            slot_ = &slot;
            return;
        }
    }
}

UnfinishedName::~UnfinishedName() {
    std::string* expected = name_.get();
    if (slot_ != nullptr && !slot_->compare_exchange_strong(expected, nullptr)) {
        // A signal handler has taken the name and may be reading it, so this thread must not free it.
        static_cast<void>(name_.release());
        return;
    }
    ::unlink(name_->c_str());
}

void remove_unfinished_files() noexcept {
    for (std::atomic<std::string*>& slot : unfinished) {
        if (const std::string* const name = slot.exchange(nullptr)) ::unlink(name->c_str());
    }
}

}  // namespace candela
