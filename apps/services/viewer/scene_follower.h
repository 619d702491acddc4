// The actions of candela view when a file is saved.
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

#include "process/process.h"
#include "sandbox/temporary_folder.h"
#include "viewer/publication.h"
#include "viewer/server.h"
#include "viewer/watcher.h"

import candela.util;

/// Identifies a file's state: it changes whenever the file is written or replaced.
struct FileState {
    std::filesystem::path path;
    std::uint64_t inode = 0;
    std::int64_t seconds = 0, nanoseconds = 0;  // last change of the file or its metadata

    bool operator==(const FileState&) const = default;
};

/// RAII guard: ends all programs that this one has started.
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

/// Runs `candela render` with these arguments and `changes` on a scene, to `file`; the changes may select a
/// term. The rendering is stopped when nobody wants the picture any more, or after some minutes.
view::Outcome rendered(const std::vector<std::string>& arguments, const std::vector<view::Change>& changes,
                       const std::filesystem::path& file, std::stop_token unwanted);

/// Writes a page that redirects to `address` into `folder`, readable by this user only: every user of the
/// machine can read the arguments of programs. Returns its path; throws candela::Error (failure).
std::filesystem::path page_leading_to(const std::string& address, const std::filesystem::path& folder);

/// Runs `candela edit` with these arguments to write the changes into the scene's files.
view::Outcome saved(const std::vector<std::string>& arguments, const std::vector<view::Change>& changes);

/// Runs `candela plugin new` with these arguments to make a project of the formula in `kernel`, in a new
/// folder of the working directory. The model and the folder's name are among `changes`. The text is passed
/// in `file`. Returns the message for the page.
view::Outcome kept(const std::vector<std::string>& arguments, const std::vector<view::Change>& changes,
                   const std::string& kernel, const std::filesystem::path& file);

/// Makes a scene's page again whenever one of its files changes. `candela generate` makes it in a process of
/// its own, which may crash and never has an outdated plugin library loaded.
class SceneFollower {
  public:
    struct Job {
        std::vector<std::string> arguments;  // for `candela generate`, without target and output
        std::string target;
        std::vector<std::string> scenes;
        std::vector<std::filesystem::path> plugin_folders;
    };

    /// Starts at once, on a thread of its own, which also calls `publish`.
    SceneFollower(Job job, std::function<void(view::Publication)> publish);
    SceneFollower(const SceneFollower&) = delete;
    SceneFollower& operator=(const SceneFollower&) = delete;
    /// Waits for the running program.
    ~SceneFollower();

  private:
    void follow();
    /// Returns whether the scene became a page.
    bool make_page();
    void note_inputs(bool is_complete);
    void watch(bool is_right);
    /// Starts a program that loads the plugins and waits for the next save.
    void get_ready();
    /// The output of the waiting program, or of a new one if plugins have changed.
    candela::ProgramOutput generated();
    bool has_input_since(std::filesystem::file_time_type time) const;

    Job job_;
    std::function<void(view::Publication)> publish_;
    TemporaryFolder folder_;
    view::Watcher watcher_;
    view::Publication latest_;
    std::vector<std::filesystem::path> inputs_;
    std::optional<candela::WaitingProgram> waiting_;
    std::vector<FileState> plugins_;  // loaded by the waiting program
    std::atomic<bool> is_ending_{false};
    std::thread thread_;  // declared last: it uses all the other members
};
