#include "files/output_folder.h"

#include <fmt/format.h>

#include <string>
#include <system_error>

#include "files/owned_files.h"

import candela.util;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

[[noreturn]] void fail(const fs::path& folder, const std::string& reason) {
    throw Error(ErrorCategory::failure,
                fmt::format("the folder '{}' cannot be created: {}", folder.string(), reason));
}

/// The folder itself, or its nearest existing parent: files written there can be moved into place without a
/// copy.
fs::path existing_part_of(const fs::path& target) {
    std::error_code problem;
    for (fs::path folder = fs::absolute(target).lexically_normal();; folder = folder.parent_path()) {
        const fs::file_status status = fs::status(folder, problem);
        if (fs::is_directory(status)) return folder;
        if (fs::exists(status)) fail(target, fmt::format("'{}' is not a folder", folder.string()));
        if (status.type() == fs::file_type::none) fail(target, problem.message());
    }
}

/// Throws if something blocks the files below `from`, before any of them is moved.
void require_no_obstacle(const fs::path& from, const fs::path& to) {
    for (const std::string& name : candela::names_in(from).value_or(std::vector<std::string>())) {
        const fs::file_status there = fs::symlink_status(to / name);
        if (!fs::exists(there)) continue;
        const bool is_folder = fs::is_directory(fs::symlink_status(from / name));
        if (is_folder && !fs::is_directory(there))
            fail(to / name, "a link or a file is in its place; remove it");
        if (!is_folder && fs::is_directory(there)) {
            throw Error(ErrorCategory::failure, fmt::format("'{}' is a directory; expected a file name",
                                                            (to / name).lexically_normal().string()));
        }
        if (is_folder) require_no_obstacle(from / name, to / name);
    }
}

/// Moves every file below `from` to the same place below `to`, an existing folder.
void move_files(const fs::path& from, const fs::path& to) {
    const auto names = candela::names_in(from);
    if (!names) throw fs::filesystem_error("", from, std::make_error_code(std::errc::io_error));
    for (const std::string& name : *names) {
        if (fs::is_directory(fs::symlink_status(from / name))) {
            make_owned_folder(to, name);
            move_files(from / name, to / name);
        } else {
            fs::rename(from / name, to / name);
        }
    }
}

/// Removes a file below a folder, unless its path contains a link.
void remove_below(const fs::path& folder, const fs::path& name) {
    fs::path part = folder;
    for (const fs::path& each : name.parent_path()) {
        part /= each;
        if (!fs::is_directory(fs::symlink_status(part))) return;
    }
    fs::remove(folder / name);
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& target, candela::Links links)
    : target_(target), beside_(".candela-", existing_part_of(target)), draft_(beside_.path() / "draft") {
    std::error_code none;
    if (links == candela::Links::not_followed && fs::is_symlink(target, none))
        fail(target, "a link is in its place; remove it");
    make_folder(draft_);
}

void OutputFolder::write(const fs::path& name, std::string_view content) {
    const fs::path file = draft_ / name;
    std::error_code problem;
    fs::create_directories(file.parent_path(), problem);
    if (problem) fail(target_, problem.message());
    try {
        candela::write_text_file(file, content);
    } catch (const Error& error) {
        // The user knows the file by its final name.
        std::string reason = error.what();
        if (const std::size_t at = reason.find(file.string()); at != std::string::npos)
            reason.replace(at, file.string().size(), (target_ / name).string());
        throw Error(error.category(), reason, error.help());
    }
}

void OutputFolder::finish(const std::vector<fs::path>& outdated) try {
    const WithoutInterruption during_this;
    if (!fs::exists(target_)) {
        const fs::path target = fs::absolute(target_ / "").lexically_normal().parent_path();
        fs::create_directories(target.parent_path());
        fs::rename(draft_, target);
        return;
    }
    require_no_obstacle(draft_, target_);
    for (const fs::path& name : outdated) remove_below(target_, name);
    move_files(draft_, target_);
} catch (const fs::filesystem_error& problem) {
    fail(target_, problem.code().message());
}

fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

void make_folder(const fs::path& folder) {
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem) fail(folder, problem.message());
}
