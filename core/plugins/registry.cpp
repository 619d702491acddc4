module;

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <boost/dll/runtime_symbol_info.hpp>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

module candela.plugins;

import candela.util;

namespace candela {

namespace {

namespace fs = std::filesystem;

void add_path_list(std::vector<fs::path>& directories, std::string_view list) {
    while (!list.empty()) {
        const auto colon = list.find(':');
        if (colon != 0) directories.emplace_back(list.substr(0, colon));
        list.remove_prefix(colon == std::string_view::npos ? list.size() : colon + 1);
    }
}

fs::path library_of(const fs::path& directory, PluginKind kind, std::string_view name) {
    return directory / fmt::format("{}-{}.so", candela::name_of(kind), name);
}

std::string_view environment(const char* name) {
    const char* const value = std::getenv(name);
    return value != nullptr ? value : "";
}

}  // namespace

std::vector<fs::path> plugin_search_path(std::span<const fs::path> first) {
    std::vector<fs::path> directories(first.begin(), first.end());
    add_path_list(directories, environment("CANDELA_PLUGIN_PATH"));
    if (const auto data = environment("XDG_DATA_HOME"); !data.empty()) {
        directories.push_back(fs::path(data) / "candela/plugins");
    } else if (const auto home = environment("HOME"); !home.empty()) {
        directories.push_back(fs::path(home) / ".local/share/candela/plugins");
    }
    // This library is lib/libcandela_core.so, so plugins are in lib/candela/plugins.
    directories.push_back(
        (boost::dll::this_line_location().parent_path() / "candela/plugins").lexically_normal());
    return directories;
}

bool is_plugin_name(std::string_view name) {
    const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
    const auto is_allowed = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '-'; };
    return !name.empty() && is_letter(name.front()) && name.back() != '-' && name.find("--") == name.npos &&
           std::ranges::all_of(name, is_allowed);
}

std::string absolute_model_name(const fs::path& name) {
    if (!is_kernel_file(name.native())) return name.string();
    std::error_code problem;
    const fs::path file = fs::absolute(name, problem);
    return problem ? name.string() : file.lexically_normal().string();
}

std::string shown_model_name(std::string_view name) {
    const fs::path file(name);
    if (!is_kernel_file(name) || file.is_relative()) return std::string(name);
    std::error_code problem;
    const fs::path here = fs::current_path(problem);
    const bool is_inside = !problem && std::ranges::mismatch(here, file).in1 == here.end();
    return is_inside ? file.lexically_relative(here).string() : file.string();
}

std::string plugin_id(PluginKind kind, std::string_view name) {
    const std::string shown = shown_model_name(name);
    return is_kernel_file(name) ? shown : fmt::format("{}/{}", name_of(kind), shown);
}

std::string kernel_file_hint(std::string_view name) {
    const std::size_t slash = name.find('/');
    const bool is_id = slash != std::string_view::npos && plugin_kind_named(name.substr(0, slash));
    const bool is_path = !is_id && name.find_first_of("./") != std::string_view::npos;
    return is_path ? "; the name of a kernel file ends with .kernel" : "";
}

KernelError::KernelError(SourceLocation place, const std::string& message, const std::string& hint,
                         std::string source)
    : Error(ErrorCategory::invalid_scene, fmt::format("{}:{}:{}: {}{}{}", place.file, place.line,
                                                      place.column, message, hint.empty() ? "" : "; ", hint)),
      place_(std::move(place)),
      message_(message),
      hint_(hint),
      source_(std::move(source)) {}

KernelError::~KernelError() = default;

void KernelError::report_in(Diagnostics& diagnostics) const {
    diagnostics.remember_source(place_.file, source_);
    diagnostics.error(place_, message_, hint_);
}

Registry::Registry(std::vector<fs::path> search_path, PluginTrust trust, std::size_t named_folders,
                   ReplacementHandler on_replaced, KernelCompiler compile_kernel)
    : search_path_(std::move(search_path)),
      trust_(trust),
      named_folders_(named_folders),
      on_replaced_(std::move(on_replaced)),
      compile_kernel_(std::move(compile_kernel)) {}

/// Throws Error.
std::unique_ptr<PluginFile> Registry::plugin_of_kernel(const fs::path& file) {
    if (!compile_kernel_)
        throw Error(ErrorCategory::bad_request,
                    fmt::format("'{}' is a kernel file, which cannot be used here", file.string()));
    const CompiledKernel compiled = compile_kernel_(file);
    if (auto plugin = look_at(compiled.folder, compiled.kind, compiled.name)) return plugin;
    const auto refused = refused_.find(library_of(compiled.folder, compiled.kind, compiled.name));
    throw Error(ErrorCategory::failure,
                refused != refused_.end() ? refused->second.reason
                                          : fmt::format("the compiled '{}' has disappeared", file.string()));
}

/// Compiles the file when it is named for the first time.
const Registry::KernelEntry& Registry::kernel_entry(std::string_view file) {
    const auto [entry, is_new] = kernels_.try_emplace(std::string(file));
    if (is_new) {
        try {
            entry->second.plugin = plugin_of_kernel(entry->first);
        } catch (...) {
            entry->second.problem = std::current_exception();
        }
    }
    return entry->second;
}

const PluginFile& Registry::require_kernel(const std::string& file) {
    const std::lock_guard lock(mutex_);
    const KernelEntry& entry = kernel_entry(file);
    if (entry.problem) std::rethrow_exception(entry.problem);
    return *entry.plugin;
}

std::vector<fs::path> Registry::kernel_files() const {
    const std::lock_guard lock(mutex_);
    std::vector<fs::path> files;
    for (const auto& [file, entry] : kernels_) files.emplace_back(file);
    return files;
}

const PluginFile* Registry::find(PluginKind kind, std::string_view name) {
    const std::lock_guard lock(mutex_);
    if (is_kernel_file(name)) {
        const PluginFile* const plugin = kernel_entry(name).plugin.get();
        return plugin != nullptr && plugin->manifest.kind == kind ? plugin : nullptr;
    }
    const std::string id = plugin_id(kind, name);
    if (const auto known = found_.find(id); known != found_.end()) return known->second.get();
    if (name.find('/') != std::string_view::npos) return nullptr;
    for (std::size_t i = 0; i < search_path_.size(); ++i) {
        if (auto plugin = look_at(search_path_[i], kind, name)) {
            const PluginFile* const file = (found_[id] = std::move(plugin)).get();
            report_replaced(*file, kind, name);
            return file;
        }
        if (i < named_folders_ && refused_.contains(library_of(search_path_[i], kind, name))) break;
    }
    found_[id] = nullptr;
    return nullptr;
}

std::vector<Refusal*> Registry::refused_before(const PluginFile* instead, PluginKind kind,
                                               std::string_view name) {
    std::vector<Refusal*> result;
    for (const fs::path& directory : search_path_) {
        const fs::path library = library_of(directory, kind, name);
        if (instead != nullptr && instead->library == library) break;
        if (const auto refused = refused_.find(library); refused != refused_.end())
            result.push_back(&refused->second);
    }
    return result;
}

void Registry::report_replaced(const PluginFile& instead, PluginKind kind, std::string_view name) {
    for (Refusal* const refused : refused_before(&instead, kind, name)) {
        if (!refused->used_instead.empty()) continue;
        refused->used_instead = instead.library;
        if (on_replaced_) on_replaced_(*refused);
    }
}

const PluginFile& Registry::require(PluginKind kind, std::string_view name) {
    if (const PluginFile* const file = find(kind, name)) return *file;
    const std::lock_guard lock(mutex_);
    if (is_kernel_file(name)) {
        const PluginFile& plugin = require_kernel(std::string(name));
        throw Error(ErrorCategory::bad_request,
                    fmt::format("'{}' is a {} model; expected a {} model", shown_model_name(name),
                                candela::name_of(plugin.manifest.kind), candela::name_of(kind)));
    }
    if (const auto refused = refused_before(nullptr, kind, name); !refused.empty())
        throw Error(ErrorCategory::failure, refused.front()->reason, refused.front()->help);
    const std::vector<std::string> known = names(kind);
    const std::string meant = suggestion(name, known);
    throw Error(ErrorCategory::failure,
                fmt::format("no {} plugin is called '{}'{}{}{} (installed: {})", candela::name_of(kind), name,
                            has_kernels(kind) ? kernel_file_hint(name) : "", meant.empty() ? "" : "; ", meant,
                            known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))),
                {meant.empty() ? Help::Topic::all_plugins : Help::Topic::none});
}

void Registry::scan(PluginKind kind) {
    if (!scanned_.insert(kind).second) return;
    const std::string prefix = fmt::format("{}-", candela::name_of(kind));
    for (const fs::path& directory : search_path_) {
        std::error_code problem;
        std::set<std::string> names;
        const auto files = names_in(directory);
        if (!files && fs::exists(directory, problem) && ::access(directory.c_str(), R_OK) == 0) {
            throw Error(ErrorCategory::failure,
                        fmt::format("the folder '{}' cannot be read", directory.string()));
        }
        if (!files) continue;
        for (const std::string& name : *files) {
            const fs::path file(name);
            const std::string extension = file.extension().string();
            const std::string stem = file.stem().string();
            if ((extension == ".so" || extension == ".json") && stem.starts_with(prefix))
                names.insert(stem.substr(prefix.size()));
        }
        for (const std::string& name : names) find(kind, name);
    }
}

std::vector<const PluginFile*> Registry::list(PluginKind kind) {
    const std::lock_guard lock(mutex_);
    scan(kind);
    std::vector<const PluginFile*> all;
    for (const auto& [id, file] : found_) {
        if (file != nullptr && file->manifest.kind == kind) all.push_back(file.get());
    }
    std::ranges::sort(all, {},
                      [](const PluginFile* file) -> const std::string& { return file->manifest.name; });
    return all;
}

std::vector<const PluginFile*> Registry::list() {
    std::vector<const PluginFile*> all;
    for (const PluginKind kind : k_plugin_kinds) {
        const auto some = list(kind);
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

std::vector<std::string> Registry::names(PluginKind kind) {
    std::vector<std::string> result;
    for (const PluginFile* file : list(kind)) result.push_back(file->manifest.name);
    return result;
}

std::vector<Refusal> Registry::refusals() const {
    const std::lock_guard lock(mutex_);
    std::vector<Refusal> result;
    for (const auto& [file, refusal] : refused_) result.push_back(refusal);
    return result;
}

const PluginFile* Registry::find_format(std::string_view extension, FormatUse use) {
    // Trying the plugin named after its format first avoids reading all other manifests.
    const auto is_able = [&](const PluginFile* file) {
        return std::ranges::any_of(file->manifest.formats, [&](const ManifestFormat& format) {
            return format.extension == extension && (use == FormatUse::write || format.reads);
        });
    };
    const auto is_fallback = [](const PluginFile* file) {
        return file->manifest.property("fallback").has_value();
    };
    if (const PluginFile* const file = find(PluginKind::image, extension); file != nullptr && is_able(file))
        return file;
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < named_folders_; ++i) {
        const auto refused = refused_.find(library_of(search_path_[i], PluginKind::image, extension));
        if (refused != refused_.end())
            throw Error(ErrorCategory::failure, refused->second.reason, refused->second.help);
    }
    const PluginFile* best = nullptr;
    for (const PluginFile* file : list(PluginKind::image)) {
        if (is_able(file) && (best == nullptr || (is_fallback(best) && !is_fallback(file)))) best = file;
    }
    if (best != nullptr) report_replaced(*best, PluginKind::image, extension);
    return best;
}

std::vector<std::string> Registry::extensions(FormatUse use) {
    std::set<std::string> all;
    for (const PluginFile* file : list(PluginKind::image)) {
        for (const ManifestFormat& format : file->manifest.formats) {
            if (use == FormatUse::write || format.reads) all.insert(format.extension);
        }
    }
    return {all.begin(), all.end()};
}

ParamSet Registry::parameters(PluginKind kind, std::string_view name) {
    return ParamSet(require(kind, name).schema);
}

const PluginDescriptor& Registry::load(const PluginFile& file) {
    const std::lock_guard lock(mutex_);
    if (file.descriptor == nullptr) file.descriptor = &load_plugin(file.library, &file.manifest);
    return *file.descriptor;
}

const PluginDescriptor& Registry::descriptor(PluginKind kind, std::string_view name) {
    return load(require(kind, name));
}

std::unique_ptr<Instance> Registry::create_instance(PluginKind kind, std::string_view name,
                                                    const ParamSet& values, ColorEncoding encoding) {
    const PluginDescriptor& plugin = descriptor(kind, name);
    try {
        const PictureAccess pictures(*this, encoding);
        std::unique_ptr<Instance> instance(plugin.create(values.runtime(encoding)));
        if (instance == nullptr) throw std::runtime_error("created nothing");
        return instance;
    } catch (...) {
        rethrow_as_plugin_error(kind, name);
    }
}

void Registry::throw_wrong_interface(PluginKind kind, std::string_view name) {
    throw Error(ErrorCategory::failure, fmt::format("plugin {} created an object that is not a {}",
                                                    plugin_id(kind, name), candela::name_of(kind)));
}

}  // namespace candela
