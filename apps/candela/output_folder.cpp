#include "output_folder.h"

#include <fmt/format.h>

#include <string>
#include <system_error>

import candela.files;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

[[noreturn]] void fail(const fs::path& folder, const std::string& reason) {
    throw Error(ErrorCategory::failure,
                fmt::format("the folder '{}' cannot be made: {}", folder.string(), reason));
}

/// The folder itself, or the nearest above it that there is: what is written there can be moved without a
/// copy.
fs::path existing_part_of(const fs::path& target) {
    std::error_code problem;
    for (fs::path folder = fs::absolute(target).lexically_normal();; folder = folder.parent_path()) {
        const fs::file_status status = fs::status(folder, problem);
        if (fs::is_directory(status)) return folder;
        if (fs::exists(status)) fail(target, fmt::format("'{}' is a file", folder.string()));
        if (status.type() == fs::file_type::none) fail(target, problem.message());
    }
}

/// Moves every file below `from` to the same place below `to`.
void move_files(const fs::path& from, const fs::path& to) {
    const auto names = candela::names_in(from);
    if (!names) throw fs::filesystem_error("", from, std::make_error_code(std::errc::io_error));
    fs::create_directories(to);
    for (const std::string& name : *names) {
        if (fs::is_directory(fs::symlink_status(from / name)))
            move_files(from / name, to / name);
        else
            fs::rename(from / name, to / name);
    }
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& target)
    : target_(target), beside_(existing_part_of(target), ".candela-") {}

void OutputFolder::write(const fs::path& name, std::string_view content) {
    const fs::path file = beside_.path() / name;
    std::error_code problem;
    fs::create_directories(file.parent_path(), problem);
    if (problem) fail(target_, problem.message());
    try {
        candela::write_text_file(file, content);
    } catch (const Error& error) {
        // The person knows the file by the name that it was to have.
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
        fs::rename(beside_.path(), target);
        return beside_.release();
    }
    for (const fs::path& name : outdated) fs::remove(target_ / name);
    move_files(beside_.path(), target_);
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
