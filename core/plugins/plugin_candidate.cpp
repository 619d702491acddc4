// Whether the files of a plugin can be used, and if not, why.
module;

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

module candela.plugins;

import candela.util;

namespace candela {

namespace {

namespace fs = std::filesystem;

/// The shipped manifests have two or three thousand bytes.
constexpr std::size_t k_largest_manifest = 1u << 20;

bool is_missing(const fs::path& directory) {
    return ::access(directory.c_str(), F_OK) != 0 && errno == ENOENT;
}

bool is_readable(const fs::path& file) { return ::access(file.c_str(), R_OK) == 0; }

bool is_regular(const fs::path& file) {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored);
}

/// Why an existing file cannot be read; empty if it can be, or does not exist. That this user cannot read a
/// whole folder says nothing about a file in it.
std::string reading_problem(const fs::path& file) {
    struct stat status{};
    if (::access(file.parent_path().c_str(), X_OK) != 0 || ::lstat(file.c_str(), &status) != 0) return {};
    if (is_readable(file)) return {};
    return errno == ENOENT ? "it is a dangling link" : std::strerror(errno);
}

/// "belongs to …" or "is writable by every user"; empty if only this user and root can modify the file or
/// folder.
std::string who_else_can_write(const fs::path& path) {
    struct stat status{};
    if (::stat(path.c_str(), &status) != 0) return {};
    if (status.st_uid != 0 && status.st_uid != ::geteuid())
        return fmt::format("belongs to user {}", status.st_uid);
    if ((status.st_mode & S_IWOTH) != 0) return "is writable by every user";
    return {};
}

/// In full, because only its last part may differ; a manifest may contain anything in its place.
std::string fingerprint_text(std::string_view abi) {
    constexpr std::size_t k_longest = 100;
    const bool is_plain =
        abi.size() <= k_longest && std::ranges::all_of(abi, [](char c) { return c >= ' ' && c <= '~'; });
    return is_plain ? std::string(abi) : shortened(abi);
}

}  // namespace

std::unique_ptr<PluginFile> Registry::look_at(const fs::path& directory, PluginKind kind,
                                              std::string_view name) {
    const std::string id = fmt::format("{}/{}", candela::name_of(kind), name);
    if (is_missing(directory)) return nullptr;
    const std::string stem = fmt::format("{}-{}", candela::name_of(kind), name);
    const fs::path manifest_path = directory / (stem + ".json");
    const fs::path library = directory / (stem + ".so");
    const auto refuse = [&](const std::string& reason, Help help = {}) {
        refused_[library] = {library, fmt::format("plugin '{}' is refused: {}", library.string(), reason),
                             std::move(help)};
        return std::unique_ptr<PluginFile>();
    };
    const auto text = read_text_file(manifest_path, k_largest_manifest);
    if (!text || !is_readable(library)) {
        for (const fs::path& part : {library, manifest_path}) {
            if (const std::string problem = reading_problem(part); !problem.empty())
                return refuse(
                    fmt::format("{} cannot be read: {}", part == library ? "it" : "its manifest", problem));
        }
    }
    const bool has_library = is_regular(library);
    if (!text && is_regular(manifest_path)) {
        // An error that may be temporary says nothing about the plugin.
        throw Error(ErrorCategory::failure, fmt::format("'{}' cannot be read", manifest_path.string()));
    }
    if (!text) {
        return has_library ? refuse(fmt::format(
                                 "its manifest {}.json is missing; build it with candela_add_plugin()", stem))
                           : nullptr;
    }
    if (!has_library) return refuse("its manifest exists, but the library does not");
    if (text->size() > k_largest_manifest) {
        return refuse(fmt::format("its manifest {}.json is larger than {} bytes", stem, k_largest_manifest));
    }
    if (trust_ != PluginTrust::any) {
        for (const fs::path& part : {directory, library}) {
            if (const std::string who = who_else_can_write(part); !who.empty()) {
                return refuse(
                    fmt::format("'{}' {}, so anybody could run code here; change that", part.string(), who),
                    {Help::Topic::plugin_trust});
            }
        }
    }
    const auto refuse_abi = [&](std::string_view abi) {
        return refuse(
            fmt::format("it was built for '{}', but this is '{}'; build it again with this Candela's SDK",
                        fingerprint_text(abi), host_abi()));
    };
    auto file = std::make_unique<PluginFile>();
    try {
        file->manifest = manifest_from_json(*text);
    } catch (const Error& problem) {
        if (const std::string abi = abi_from_json(*text); !abi.empty() && abi != host_abi())
            return refuse_abi(abi);
        return refuse(fmt::format("its manifest {}.json cannot be used: {}", stem, problem.what()));
    }
    if (file->manifest.abi != host_abi()) return refuse_abi(file->manifest.abi);
    if (file->manifest.id() != id) {
        return refuse(
            fmt::format("its manifest is that of {}; a plugin's file must be called <kind>-<name>.so",
                        file->manifest.id()));
    }
    if (const std::string damage = library_damage(library); !damage.empty())
        return refuse(fmt::format("it cannot be loaded ({}); build it again, or remove it", damage));
    file->library = library;
    std::vector<Parameter> schema = file->manifest.parameters;
    for (Parameter& parameter : schema) parameter.notation = notation_of(file->manifest, parameter);
    file->schema = std::make_shared<const std::vector<Parameter>>(std::move(schema));
    return file;
}

}  // namespace candela
