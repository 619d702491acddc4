// Notices changes of files through the kernel (inotify).
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "candela/file_descriptor.h"

namespace view {

/// Watches folders, because editors replace files instead of writing to them. stop() may be called on any
/// thread, everything else only on one.
class Watcher {
  public:
    /// Throws candela::Error (failure) if the system allows no more watchers.
    Watcher();

    /// Watches these files, whether they exist or not, and everything in these folders. Changes since the
    /// last wait() are not lost.
    void watch(const std::vector<std::filesystem::path>& files,
               const std::vector<std::filesystem::path>& folders);

    /// Waits until something watched has changed and then stayed unchanged for a moment. False after stop().
    bool wait();
    /// Whether nothing at all happens during `time`.
    bool is_quiet_for(std::chrono::milliseconds time) const;
    void stop() noexcept;

  private:
    void add(const std::filesystem::path& folder, const std::string& name);
    /// Reads the pending events; returns whether something watched was among them.
    bool read_events();

    candela::FileDescriptor events_, stop_;
    std::map<int, std::set<std::string>> names_;  // by watch; "" is every name
};

}  // namespace view
