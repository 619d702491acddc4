#include "verify/work_dir.h"

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "sandbox/process_tree.h"

namespace fs = std::filesystem;

namespace {

/// Drivers and browsers keep caches and settings in the home folder; compiler wrappers keep their results
/// there.
void move_home(const fs::path& home) {
    // Keeps the permission to draw on this screen.
    if (const char* const old = std::getenv("HOME"); old != nullptr && std::getenv("XAUTHORITY") == nullptr) {
        const fs::path authority = fs::path(old) / ".Xauthority";
        std::error_code none;
        if (fs::exists(authority, none)) ::setenv("XAUTHORITY", authority.c_str(), 1);
    }
    fs::create_directory(home);
    ::setenv("HOME", home.c_str(), 1);
    for (const char* const name : {"XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME"})
        ::unsetenv(name);
}

}  // namespace

Workplace::Workplace(const std::optional<std::string>& report) : temporary_("candela-") {
    ::setenv("TMPDIR", temporary_.path().c_str(), 1);
    move_home(scratch("home"));
    inherit_orphans();
    if (!report) return;
    report_ = *report;
    draft_.emplace(report_);
}

void Workplace::finish(const std::vector<LoadedTarget>& targets) {
    if (!draft_) return;
    std::vector<fs::path> outdated = images_of(targets);
    outdated.emplace_back("index.html");
    for (const LoadedTarget& target : targets) {
        // CMake refuses a moved folder unless its cache is deleted.
        const fs::path cache = fs::path(target.name()) / "build" / "CMakeCache.txt";
        std::error_code none;
        fs::remove(draft_->draft() / cache, none);
        outdated.push_back(cache);
    }
    draft_->finish(outdated);
}

std::string Workplace::in_place(std::string message) const {
    if (!draft_) return message;
    const std::string draft = draft_->draft().string();
    for (std::size_t at = 0; (at = message.find(draft, at)) != std::string::npos;)
        message.replace(at, draft.size(), report_.string());
    return message;
}

std::vector<fs::path> Workplace::images_of(const std::vector<LoadedTarget>& targets) {
    std::vector<fs::path> names{"reference.png", "edges.png"};
    for (const LoadedTarget& target : targets)
        for (const char* const end : {".png", "-difference.png"}) names.emplace_back(target.name() + end);
    return names;
}
