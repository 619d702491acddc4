#include "viewer/scene_follower.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <system_error>
#include <utility>

#include "aov/terms.h"
#include "candela/file_descriptor.h"
#include "console/reporting.h"
#include "console/stopwatch.h"
#include "json/json.h"
#include "plugin_project/plugin_project.h"
#include "sandbox/process_tree.h"
#include "viewer/arguments.h"

import candela.plugins;
import candela.util;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

std::string content_of(const fs::path& file) {
    std::optional<std::string> text = candela::read_text_file(file);
    if (!text) throw Error(ErrorCategory::failure, fmt::format("'{}' cannot be read", file.string()));
    return *std::move(text);
}

std::vector<fs::path> names_listed_in(const fs::path& list) {
    std::vector<fs::path> names;
    for (const auto& name : parse_json(content_of(list))) names.emplace_back(name.get<std::string>());
    return names;
}

/// Runs a verb of this program in a process of its own.
candela::ProgramOutput run_verb(const std::vector<std::string>& verb,
                                const std::vector<std::string>& arguments,
                                const std::vector<std::string>& options,
                                const candela::Patience& patience = {}) {
    std::vector<std::string> words{"/proc/self/exe"};
    for (const auto& some : {verb, view::with_options(arguments, options)})
        words.insert(words.end(), some.begin(), some.end());
    return candela::run_program(words, patience);
}

constexpr const char* k_inputs = "inputs.json";
constexpr std::chrono::minutes k_longest_rendering{5}, k_longest_making{5};
// Browsers get both the scene and the processors to themselves until they have drawn it.
constexpr std::chrono::milliseconds k_until_shown{300};

std::vector<FileState> states_in(const std::vector<fs::path>& folders) {
    std::vector<FileState> states;
    for (const fs::path& folder : folders) {
        std::error_code problem;
        for (fs::recursive_directory_iterator file(folder, problem), end; !problem && file != end;
             file.increment(problem)) {
            struct stat found{};
            if (::stat(file->path().c_str(), &found) != 0) continue;
            states.push_back({.path = file->path(),
                              .inode = found.st_ino,
                              .seconds = found.st_ctim.tv_sec,
                              .nanoseconds = found.st_ctim.tv_nsec});
        }
    }
    std::ranges::sort(states, {}, &FileState::path);
    return states;
}

}  // namespace

WithoutDescendants::WithoutDescendants()
    : thread_([this] {
          while (!is_over_) {
              end_descendants();
              std::this_thread::sleep_for(std::chrono::milliseconds(5));
          }
      }) {}

WithoutDescendants::~WithoutDescendants() {
    is_over_ = true;
    thread_.join();
}

view::Outcome rendered(const std::vector<std::string>& arguments, const std::vector<view::Change>& changes,
                       const fs::path& file, std::stop_token unwanted) try {
    const candela::ProgramOutput result =
        run_verb({"render", "--quiet", "--output", file.string()}, arguments, view::options_of(changes),
                 {.longest = k_longest_rendering, .unwanted = std::move(unwanted)});
    if (result.end == candela::ProgramEnd::late) {
        return {.is_success = false,
                .content = fmt::format("Rendering was stopped after {} minutes; make the picture "
                                       "smaller, or render it with candela render.\n",
                                       k_longest_rendering.count())};
    }
    if (result.exit_code != 0) return {.is_success = false, .content = result.err};
    const auto term = std::ranges::find(changes, "--terms", &view::Change::option);
    return {.is_success = true,
            .content = content_of(term == changes.end() ? file : file_of_term(term->value, file))};
} catch (const std::exception& problem) {
    return {.is_success = false, .content = problem.what()};
}

view::Outcome saved(const std::vector<std::string>& arguments, const std::vector<view::Change>& changes) try {
    std::vector<std::string> options;
    for (const view::Change& change : changes) {
        const bool is_model = change.option != "--set";
        options.push_back(is_model
                              ? fmt::format("--change={}.model={}", change.option.substr(2), change.value)
                              : fmt::format("--change={}", change.value));
    }
    const candela::ProgramOutput result = run_verb({"edit", "--quiet"}, arguments, options);
    return {.is_success = result.exit_code == 0, .content = result.err};
} catch (const std::exception& problem) {
    return {.is_success = false, .content = problem.what()};
}

view::Outcome kept(const std::vector<std::string>& arguments, const std::vector<view::Change>& changes,
                   const std::string& kernel, const fs::path& file) try {
    const auto value_of = [&](const char* option) {
        return std::ranges::find(changes, option, &view::Change::option)->value;
    };
    // The name is checked before anything is written: a plugin's name has no '/'.
    const std::string name = project_names(value_of("--name")).name;
    std::error_code problem;
    if (fs::exists(fs::symlink_status(name, problem)))
        return {.is_success = false,
                .content = fmt::format("The formula was not kept: '{}' already exists.", name)};
    candela::write_text_file(file, kernel);
    const candela::ProgramOutput result =
        run_verb({"plugin", "new", "reflection", name}, arguments,
                 {fmt::format("--from={}", value_of("--model")), fmt::format("--kernel={}", file.string())});
    if (result.exit_code != 0) return {.is_success = false, .content = result.err};
    return {.is_success = true,
            .content =
                fmt::format("Kept in '{}'. Build and test it there: cmake -B build && cmake --build build && "
                            "ctest --test-dir build. {}",
                            fs::absolute(name).string(), result.err)};
} catch (const std::exception& problem) {
    return {.is_success = false, .content = fmt::format("The formula was not kept: {}", problem.what())};
}

fs::path page_leading_to(const std::string& address, const fs::path& folder) {
    fs::path file = folder / "open.html";
    const std::string page = fmt::format(
        "<!doctype html>\n<meta charset=\"utf-8\">\n<meta name=\"referrer\" content=\"no-referrer\">\n"
        "<meta http-equiv=\"refresh\" content=\"0; url={0}\">\n<title>candela view</title>\n"
        "<a href=\"{0}\">candela view</a>\n",
        address);
    constexpr mode_t k_for_its_owner = 0600;
    const candela::FileDescriptor descriptor(
        ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, k_for_its_owner));
    const bool is_written = descriptor.is_open() && ::write(descriptor.number(), page.data(), page.size()) ==
                                                        static_cast<ssize_t>(page.size());
    if (!is_written) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' cannot be written: {}", file.string(), std::strerror(errno)));
    }
    return file;
}

SceneFollower::SceneFollower(Job job, std::function<void(view::Publication)> publish)
    : job_(std::move(job)),
      publish_(std::move(publish)),
      folder_("candela-view-"),
      thread_([this] { follow(); }) {}

SceneFollower::~SceneFollower() {
    is_ending_ = true;
    watcher_.stop();
    thread_.join();
}

void SceneFollower::watch(bool is_right) {
    std::vector<fs::path> files = inputs_, folders = job_.plugin_folders;
    for (const std::string& scene : job_.scenes) {
        files.emplace_back(scene);
        // The files that an invalid scene names are unknown.
        if (!is_right) folders.push_back(fs::path(scene).parent_path());
    }
    // A kernel file among --models that has never been valid is not among the inputs.
    for (const std::string& argument : job_.arguments) {
        if (candela::is_kernel_file(argument)) files.emplace_back(argument.substr(argument.find('=') + 1));
    }
    watcher_.watch(files, folders);
}

void SceneFollower::get_ready() {
    std::vector<std::string> words{"/proc/self/exe", "generate", "--wait"};
    words.insert(words.end(), job_.arguments.begin(), job_.arguments.end());
    words.insert(words.end(), {"--target", job_.target, "--output", "-", "--inputs",
                               (folder_.path() / k_inputs).string()});
    plugins_ = states_in(job_.plugin_folders);
    waiting_.emplace(words);
}

candela::ProgramOutput SceneFollower::generated() {
    std::optional<candela::ProgramOutput> result;
    const candela::Patience patience{.longest = k_longest_making, .unwanted = {}};
    if (waiting_ && plugins_ == states_in(job_.plugin_folders)) result = waiting_->go_on(patience);
    if (!result) {
        get_ready();
        result = waiting_->go_on(patience);
    }
    waiting_.reset();
    if (result && result->end == candela::ProgramEnd::late) {
        result->err += fmt::format(
            "Making the page was stopped after {} minutes; it starts again when a file is "
            "saved.\n",
            k_longest_making.count());
    }
    if (!result) throw Error(ErrorCategory::failure, "candela generate ended before it received a request");
    return *std::move(result);
}

bool SceneFollower::make_page() {
    const Stopwatch watch;
    candela::ProgramOutput result = generated();
    if (is_ending_) return false;
    // While the scene has errors, its whole folder is watched, and much may happen there.
    const bool is_news = result.err != latest_.problems;
    latest_.problems = result.err;
    const bool is_right = result.exit_code == 0;
    note_inputs(is_right);
    if (is_right) {
        // Saved unchanged: existing pages stay valid.
        if (latest_.page == nullptr || result.out != latest_.page->html()) {
            latest_.page = std::make_shared<const view::Page>(std::move(result.out));
            ++latest_.generation;
        }
        latest_.problems.clear();
        say(fmt::format("{}shown after {:.0f} ms\n", result.err, watch.milliseconds()));
    } else if (is_news) {
        say(result.err);
    }
    if (is_news || is_right) publish_(latest_);
    return is_right;
}

/// Reads the list of the scene's files. That of an invalid scene is incomplete, so what was in the last one
/// stays in it.
void SceneFollower::note_inputs(bool is_complete) {
    const fs::path list = folder_.path() / k_inputs;
    std::error_code problem;
    if (!is_complete && !fs::exists(list, problem)) return;
    std::vector<fs::path> listed = names_listed_in(list);
    if (!is_complete) {
        std::erase_if(
            listed, [&](const fs::path& file) { return std::ranges::find(inputs_, file) != inputs_.end(); });
        listed.insert(listed.begin(), inputs_.begin(), inputs_.end());
    }
    inputs_ = std::move(listed);
}

bool SceneFollower::has_input_since(fs::file_time_type time) const {
    return std::ranges::any_of(inputs_, [&](const fs::path& input) {
        std::error_code problem;
        const fs::file_time_type written = fs::last_write_time(input, problem);
        return !problem && written >= time;
    });
}

void SceneFollower::follow() {
    try {
        watch(false);
        bool is_changed = true;
        while (is_changed && !is_ending_) {
            const fs::file_time_type begin = fs::file_time_type::clock::now();
            const std::vector<fs::path> before = inputs_;
            watch(make_page());
            if (!is_ending_ && watcher_.is_quiet_for(k_until_shown)) get_ready();
            // Files named by the scene for the first time were not watched while it was read.
            is_changed = (inputs_ != before && has_input_since(begin)) || watcher_.wait();
        }
    } catch (const std::exception& problem) {
        latest_.problems = fmt::format("The scene is no longer being followed: {}\n", problem.what());
        if (!is_ending_) warn(latest_.problems);
        publish_(latest_);
    }
}
