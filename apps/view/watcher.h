// Notices that files change, by the kernel's word (inotify).
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace view {

/// A file descriptor that is closed with this.
class Descriptor {
  public:
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor();

    int number() const { return number_; }

  private:
    int number_;
};

/// Watches folders, since editors replace files instead of writing to them. stop() is for any thread, all
/// else for one.
class Watcher {
  public:
    /// Throws candela::Error (failure) where the system allows no more of them.
    Watcher();

    /// From now on, these files, whether they are there or not, and everything in these folders. What has
    /// changed since the last wait() is not lost.
    void watch(const std::vector<std::filesystem::path>& files,
               const std::vector<std::filesystem::path>& folders);

    /// Waits until something watched has changed and for a moment has not changed any more. False after
    /// stop().
    bool wait();
    /// Whether nothing at all happens for so long.
    bool is_quiet_for(std::chrono::milliseconds time) const;
    void stop() noexcept;

  private:
    void add(const std::filesystem::path& folder, const std::string& name);
    /// Whether there was something watched among the events that have come.
    bool read_events();

    Descriptor events_, stop_;
    std::map<int, std::set<std::string>> names_;  // by watch; "" is every name
};

}  // namespace view
