module;

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

module candela.scene;

import :document;
import :schema;
import :setting;
import :text;
import candela.plugins;
import candela.util;

namespace candela {

namespace {

namespace fs = std::filesystem;

std::string place_text(const SourceLocation& place) {
    return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

// Far more than people write, but a program that generates scenes may have bugs.
constexpr int k_deepest_include = 32;
constexpr std::size_t k_most_files = 1000;
constexpr std::size_t k_most_lights_or_objects = 100'000;

void report_too_many(const TableNode& root, Diagnostics& diagnostics) {
    for (const char* const kind : {"light", "object"}) {
        const TableNode::Entry* const entry = root.find(kind);
        const ArrayNode* const all = entry != nullptr ? entry->node.array() : nullptr;
        if (all == nullptr || all->size() <= k_most_lights_or_objects) continue;
        diagnostics.error((*all)[k_most_lights_or_objects].place,
                          fmt::format("the scene has {} {}s; it may have at most {}", all->size(), kind,
                                      k_most_lights_or_objects));
    }
}

/// Whether `file` is in `folder` or in a folder below it. Both are canonical.
bool is_within(const fs::path& file, const fs::path& folder) {
    return std::ranges::mismatch(folder, file).in1 == folder.end();
}

/// Whether a table contains anything that belongs in a scene. If not, a file has been included by mistake.
bool is_part_of_a_scene(const TableNode& table) {
    return std::ranges::any_of(table.entries, [](const TableNode::Entry& entry) {
        const auto has_name = [&](const auto& named) { return named.name == entry.key; };
        return std::ranges::any_of(scene_schema(), has_name) ||
               std::ranges::any_of(top_schema().parameters, has_name);
    });
}

class Gatherer {
  public:
    /// Quotes nothing from files outside `home` until they turn out to be scenes; see add_foreign().
    Gatherer(fs::path home, const std::map<fs::path, std::string>& unsaved, Diagnostics& diagnostics)
        : home_(std::move(home)), unsaved_(unsaved), diagnostics_(diagnostics) {}

    void add_file(const fs::path& file, const SourceLocation* included_at) {
        const std::string shown = file.string();
        const fs::path canonical = canonical_path(file);
        std::error_code problem;
        if (const auto seen = files_.find(canonical); seen != files_.end()) {
            const SourceLocation place =
                included_at != nullptr ? *included_at : SourceLocation{shown, 0, 0, 0};
            diagnostics_.error(
                place, seen->second ? fmt::format("'{}' includes itself, directly or through others", shown)
                                    : fmt::format("'{}' is read twice", shown));
            return;
        }
        if (included_at != nullptr && !may_include(*included_at)) return;
        files_[canonical] = true;
        ++depth_;
        if (included_at != nullptr && !fs::exists(file, problem)) {
            diagnostics_.error(*included_at, fmt::format("there is no file '{}' to include", shown),
                               file_suggestion(file));
        } else if (included_at != nullptr && !is_within(canonical, home_)) {
            add_foreign(file, shown, *included_at);
        } else if (auto table = read(canonical, file, shown)) {
            add(std::move(*table), file.parent_path());
        }
        --depth_;
        files_[canonical] = false;
    }

    void add_text(std::string_view text, const std::string& shown) {
        if (auto table = parse_document(text, shown, diagnostics_)) add(std::move(*table), {});
    }

    void add_stream(const std::string& bytes, const std::string& shown) {
        if (!streams_.insert(shown).second) {
            return diagnostics_.error({shown, 0, 0, 0}, fmt::format("'{}' is read twice", shown));
        }
        if (auto table = read_document(bytes, shown, left_, diagnostics_)) add(std::move(*table), {});
    }

    TableNode take() { return std::move(root_); }
    std::vector<fs::path> files() const {
        std::vector<fs::path> all;
        for (const auto& [file, is_open] : files_) all.push_back(file);
        return all;
    }

  private:
    std::optional<TableNode> read(const fs::path& canonical, const fs::path& file, const std::string& shown) {
        const auto unsaved = unsaved_.find(canonical);
        return unsaved != unsaved_.end() ? read_document(unsaved->second, shown, left_, diagnostics_)
                                         : read_document(file, shown, left_, diagnostics_);
    }

    /// A scene from elsewhere may include any file that its user can read, and messages may be shown to
    /// others. So messages reveal nothing about the contents of a file outside the scene's folder until it
    /// has turned out to be part of a scene.
    void add_foreign(const fs::path& file, const std::string& shown, const SourceLocation& place) {
        Diagnostics found;
        auto table = read_document(file, shown, left_, found);
        if (table && is_part_of_a_scene(*table)) {
            // From here on, its lines may be shown.
            ReadingLimits ignored;
            static_cast<void>(read_document(file, shown, ignored, diagnostics_));
            return add(std::move(*table), file.parent_path());
        }
        const std::vector<Diagnostic> problems = found.sorted();
        if (found.worst() == ErrorCategory::failure) {
            return diagnostics_.failure(
                place, fmt::format("'{}' cannot be included: {}", shown, problems.front().message));
        }
        const SourceLocation in_file = problems.empty() ? SourceLocation{} : problems.front().place;
        diagnostics_.error(
            place,
            fmt::format("'{}' is not part of a scene{}", shown,
                        in_file.line > 0 ? fmt::format(": it is not TOML at line {}, column {}", in_file.line,
                                                       in_file.column)
                                         : ""),
            "it is outside the scene's folder, so its contents are not shown");
    }

    bool may_include(const SourceLocation& place) {
        if (depth_ > k_deepest_include) {
            diagnostics_.error(
                place, fmt::format("files include one another more than {} levels deep", k_deepest_include),
                "include them from the scene's first file");
            return false;
        }
        if (files_.size() < k_most_files) return true;
        if (!too_many_files_) {
            diagnostics_.error(place, fmt::format("the scene consists of more than {} files", k_most_files),
                               "merge some of them");
        }
        too_many_files_ = true;
        return false;
    }

    void add(TableNode table, const fs::path& directory) {
        if (const TableNode::Entry* const include = table.find("include")) follow(include->node, directory);
        for (TableNode::Entry& entry : table.entries) {
            if (entry.key != "include") merge(std::move(entry));
        }
    }

    void follow(const Node& list, const fs::path& directory) {
        const ArrayNode* const files = list.array();
        if (files == nullptr) {
            diagnostics_.error(list.place,
                               fmt::format("'include' is {}; expected a list of paths", description(list)));
            return;
        }
        for (const Node& file : *files) {
            if (too_many_files_) return;
            if (const auto* path = std::get_if<std::string>(&file.value)) {
                add_file(directory / *path, &file.place);
            } else {
                diagnostics_.error(file.place, fmt::format("'include' contains {}; expected a quoted path",
                                                           description(file)));
            }
        }
    }

    void merge(TableNode::Entry entry) {
        const auto [known, is_new] = index_.try_emplace(entry.key, root_.entries.size());
        if (is_new) {
            root_.entries.push_back(std::move(entry));
            return;
        }
        TableNode::Entry* const before = &root_.entries[known->second];
        if (before->node.array() != nullptr && entry.node.array() != nullptr) {
            ArrayNode& all = *before->node.array();
            for (Node& node : *entry.node.array()) all.push_back(std::move(node));
        } else if (entry.key != "version" || before->node.value.index() != entry.node.value.index() ||
                   std::get_if<std::int64_t>(&before->node.value) == nullptr ||
                   std::get<std::int64_t>(before->node.value) != std::get<std::int64_t>(entry.node.value)) {
            diagnostics_.error(entry.key_place, fmt::format("'{}' is given twice; first at {}", entry.key,
                                                            place_text(before->key_place)));
        }
    }

    fs::path home_;
    const std::map<fs::path, std::string>& unsaved_;
    Diagnostics& diagnostics_;
    TableNode root_;
    std::unordered_map<std::string, std::size_t> index_;  // index of the root's keys
    std::map<fs::path, bool> files_;                      // whether it is currently being read
    std::set<std::string> streams_;
    ReadingLimits left_;
    int depth_ = 0;
    bool too_many_files_ = false;
};

/// A stream has no folder: paths in it are relative to the working directory.
std::string shown_name(const SceneRequest& request, const fs::path& file) {
    if (!request.streams.contains(file)) return file.string();
    if (file == "-" || file.filename() == "stdin") return "standard input";
    // A descriptor's number says little without its folder, which is the system's.
    return file.parent_path().filename() == "fd" ? fmt::format("stream {}", file.filename().string())
                                                 : file.string();
}

/// The folder of the scene's first file.
fs::path home_of(const SceneRequest& request) {
    std::error_code problem;
    const bool has_file = !request.files.empty() && !request.streams.contains(request.files.front());
    const fs::path folder = has_file ? request.files.front().parent_path() : fs::path();
    return canonical_path(folder.empty() ? fs::current_path(problem) : folder);
}

/// Makes the path of a kernel file that names a model absolute.
void resolve_kernel_file(TableNode& table, std::string_view key) {
    TableNode::Entry* const entry = table.find(key);
    if (entry == nullptr) return;
    auto* const name = std::get_if<std::string>(&entry->node.value);
    if (name == nullptr || !is_kernel_file(*name)) return;
    *name = absolute_model_name(path_at(entry->node.place, *name));
}

void resolve_kernel_files(TableNode& root) {
    for (const char* const name : {"shading", "reflection"}) {
        TableNode::Entry* const entry = root.find(name);
        if (entry != nullptr && entry->node.table() != nullptr)
            resolve_kernel_file(*entry->node.table(), "model");
    }
    for (const char* const name : {"light", "object"}) {
        TableNode::Entry* const entry = root.find(name);
        if (entry == nullptr || entry->node.array() == nullptr) continue;
        for (Node& element : *entry->node.array()) {
            if (element.table() == nullptr) continue;
            for (const char* const key : {"type", "shading", "reflection"})
                resolve_kernel_file(*element.table(), key);
        }
    }
}

}  // namespace

std::optional<MergedDocument> merge_documents(const SceneRequest& request, Diagnostics& diagnostics) {
    Gatherer gatherer(home_of(request), request.unsaved, diagnostics);
    MergedDocument merged;
    if (request.files.empty()) {
        merged.place.file = "default scene";
        gatherer.add_text(default_scene_text(), merged.place.file);
    } else {
        merged.place.file = shown_name(request, request.files.front());
        for (const fs::path& file : request.files) {
            const auto stream = request.streams.find(file);
            if (stream != request.streams.end()) {
                gatherer.add_stream(stream->second, shown_name(request, file));
            } else {
                gatherer.add_file(file, nullptr);
            }
        }
    }
    // Continuing after an unreadable file would only cause errors about missing values.
    if (diagnostics.has_errors()) return std::nullopt;
    merged.root = gatherer.take();
    merged.files = gatherer.files();
    report_too_many(merged.root, diagnostics);
    if (diagnostics.has_errors()) return std::nullopt;
    ElementIndex index(merged.root);
    for (const Setting& setting : request.settings) {
        const SourceLocation place{setting.origin, 0, 0, 0};
        if (auto value = parse_value(setting.value, place, diagnostics))
            set_value(merged.root, parts_of(setting.path), *std::move(value), place, diagnostics, &index);
        if (setting.path.ends_with("name")) index = ElementIndex(merged.root);
    }
    resolve_kernel_files(merged.root);
    return merged;
}

}  // namespace candela
