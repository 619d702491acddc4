// What candela view does whenever a file is saved.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "temporary_folder.h"
#include "view/publication.h"
#include "view/server.h"
#include "view/watcher.h"

import candela.process;

/// A file's, such that a file that has been written or replaced since has another one.
struct FileState {
    std::filesystem::path path;
    std::uint64_t inode = 0;
    std::int64_t seconds = 0, nanoseconds = 0;  // when it, or what is known of it, was last changed

    bool operator==(const FileState&) const = default;
};

/// While there is one, programs that this one has started are ended.
class WithoutDescendants {
  public:
    WithoutDescendants();
    WithoutDescendants(const WithoutDescendants&) = delete;
    WithoutDescendants& operator=(const WithoutDescendants&) = delete;
    ~WithoutDescendants();

  private:
    std::atomic<bool> is_over_{false};
    std::thread thread_;
};

/// What `candela render` with these arguments makes of a scene, with somebody's changes, or a term of it that
/// is among them; `file` is where. It is ended when nobody wants the picture any more, and after some
/// minutes.
view::Outcome rendered(const std::vector<std::string>& arguments, const std::vector<view::Change>& changes,
                       const std::filesystem::path& file, std::stop_token unwanted);

/// Writes a page that leads to `address` into `folder`, for this user alone: the arguments of programs can be
/// read by every user of the machine. Returns its path; throws candela::Error (failure).
std::filesystem::path page_leading_to(const std::string& address, const std::filesystem::path& folder);

/// Has `candela edit` with these arguments write somebody's changes into the scene's files.
view::Outcome saved(const std::vector<std::string>& arguments, const std::vector<view::Change>& changes);

/// Has `candela plugin new` with these arguments make a project of a formula, whose text is `kernel`, in a
/// new folder of the working directory: the model and the folder's name are among `changes`. The text is
/// handed over in `file`. What is to be said about it.
view::Outcome kept(const std::vector<std::string>& arguments, const std::vector<view::Change>& changes,
                   const std::string& kernel, const std::filesystem::path& file);

/// Makes a scene's page anew as often as one of the files changes that it is made from. `candela generate`
/// makes it, in a process of its own: it has no library loaded that has been built again since, and may
/// crash.
class SceneFollower {
  public:
    struct Job {
        std::vector<std::string> arguments;  // of `candela generate`, without target and output
        std::string target;
        std::vector<std::string> scenes;
        std::vector<std::filesystem::path> plugin_folders;
    };

    /// Begins at once, on a thread of its own, which also calls `publish`.
    SceneFollower(Job job, std::function<void(view::Publication)> publish);
    SceneFollower(const SceneFollower&) = delete;
    SceneFollower& operator=(const SceneFollower&) = delete;
    /// Waits for the program that is running.
    ~SceneFollower();

  private:
    void follow();
    /// Whether the scene became a page.
    bool make_page();
    void watch(bool is_right);
    /// Has a program load the plugins, and wait for the next save.
    void get_ready();
    /// What the program says that was ready, or another one if plugins have changed since.
    candela::ProgramOutput generated();
    bool has_input_since(std::filesystem::file_time_type time) const;

    Job job_;
    std::function<void(view::Publication)> publish_;
    TemporaryFolder folder_;
    view::Watcher watcher_;
    view::Publication latest_;
    std::vector<std::filesystem::path> inputs_;
    std::optional<candela::WaitingProgram> waiting_;
    std::vector<FileState> plugins_;  // that it has loaded
    std::atomic<bool> is_ending_{false};
    std::thread thread_;  // the last, since it uses all the others
};
