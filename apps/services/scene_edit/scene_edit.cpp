#include "scene_edit/scene_edit.h"

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "scene_edit/text_edits.h"

import candela.plugins;
import candela.scene;
import candela.util;

namespace candela {

namespace {

namespace fs = std::filesystem;

/// How the paths of files among the new values are written: as given, which means relative to the working
/// directory, or relative to the file that they are written to, which is how they are read from it.
enum class Paths : bool { as_given, relative_to_file };

/// Turns changes of a merged document into edits of the files that it was merged from.
class Editor {
  public:
    Editor(const MergedDocument& document, Paths paths, Diagnostics& diagnostics)
        : document_(document), paths_(paths), diagnostics_(diagnostics), index_(document.root) {}

    /// The scene with this change must be valid: its path leads somewhere.
    void change(const Setting& setting) {
        std::vector<std::string> parts = parts_of(setting.path);
        const auto value = parse_value(setting.value, {setting.origin, 0, 0, 0}, diagnostics_);
        if (!value) return;
        InsertionPoint place{.table = &document_.root};
        std::size_t next = 0;
        if (parts[0] == "light" || parts[0] == "object") {
            const ArrayNode& all = *document_.root.find(parts[0])->node.array();
            const Node& element = all[*index_.find(parts[0], parts[1])];
            place = {.holder = &element, .table = element.table()};
            next = 2;
        }
        for (; next + 1 < parts.size() && place.table != nullptr; ++next) step(place, parts[next]);
        for (; next + 1 < parts.size(); ++next) place.key += toml_key(parts[next]) + ".";
        write(place, parts.back(), *value);
    }

    std::vector<TextChange> texts() {
        std::vector<TextChange> result;
        for (const auto& [where, entries] : additions_) {
            const auto& [file, holder] = where;
            edits_[file].push_back(insertion(
                text_of(file), holder != nullptr ? std::get<TableNode>(holder->value) : document_.root,
                holder != nullptr ? &holder->place : nullptr, entries));
        }
        for (const auto& [name, entries] : new_tables_) {
            const std::string& file = document_.place.file;
            edits_[file].push_back(new_table(text_of(file), name, entries));
        }
        for (const auto& [file, edits] : edits_) {
            const std::string& before = text_of(file).text();
            std::string after = edited(before, edits);
            if (after != before) result.push_back({canonical_path(file), before, std::move(after)});
        }
        return result;
    }

  private:
    /// The position of a value, or where it would be inserted.
    struct InsertionPoint {
        const Node* holder = nullptr;      // the table whose lines or braces contain it; null: the document
        const TableNode* table = nullptr;  // null if it is missing
        std::string key{};                 // from the holder on, with a trailing dot
    };

    const SourceText& text_of(const std::string& file) {
        auto found = texts_.find(file);
        if (found == texts_.end()) {
            auto text = read_text_file(file);
            if (!text) throw Error(ErrorCategory::failure, fmt::format("'{}' cannot be read", file));
            found = texts_.emplace(file, *std::move(text)).first;
        }
        return found->second;
    }

    void step(InsertionPoint& place, const std::string& part) {
        const TableNode::Entry* const entry = place.table->find(part);
        if (entry == nullptr) {
            place.table = nullptr;
            place.key += toml_key(part) + ".";
            return;
        }
        place.table = entry->node.table();
        if (has_lines_of_its_own(text_of(entry->node.place.file), entry->node)) {
            place.holder = &entry->node;
            place.key.clear();
        } else {
            place.key += toml_key(part) + ".";
        }
    }

    static void make_relative(Node& value, const fs::path& to) {
        if (TableNode* const table = value.table())
            for (TableNode::Entry& entry : table->entries) make_relative(entry.node, to);
        auto* const text = std::get_if<std::string>(&value.value);
        std::error_code problem;
        if (text == nullptr || !fs::is_regular_file(*text, problem)) return;
        const fs::path relative = fs::absolute(*text).lexically_proximate(to);
        *text = relative.string();
    }

    std::string text_in(const std::string& file, Node value) const {
        if (paths_ == Paths::relative_to_file) make_relative(value, fs::absolute(file).parent_path());
        return toml_text(value);
    }

    void write(const InsertionPoint& place, const std::string& key, const Node& value) {
        const TableNode::Entry* const entry = place.table != nullptr ? place.table->find(key) : nullptr;
        if (entry != nullptr) {
            const std::string& file = entry->node.place.file;
            edits_[file].push_back(replacement(text_of(file), entry->node, text_in(file, value)));
            return;
        }
        const std::string path = place.key + toml_key(key);
        if (place.holder == nullptr && place.table == nullptr) {
            const std::size_t dot = path.find('.');
            new_tables_[path.substr(0, dot)].emplace_back(path.substr(dot + 1),
                                                          text_in(document_.place.file, value));
            return;
        }
        const std::string& file =
            place.holder != nullptr ? place.holder->place.file : place.table->entries.front().node.place.file;
        additions_[{file, place.holder}].emplace_back(path, text_in(file, value));
    }

    const MergedDocument& document_;
    Paths paths_;
    Diagnostics& diagnostics_;
    ElementIndex index_;
    std::map<std::string, SourceText> texts_;             // of files, by the names that diagnostics show
    std::map<std::string, std::vector<TextEdit>> edits_;  // by the same names
    std::map<std::pair<std::string, const Node*>, Entries> additions_;  // to a file's table, or to the file
    std::map<std::string, Entries> new_tables_;
};

/// The last change of each path. Names and indices of the same light or object count as the same.
std::vector<Setting> last_ones(const std::vector<Setting>& changes, const MergedDocument& document) {
    std::map<std::vector<std::string>, std::size_t> last;
    const ElementIndex elements(document.root);
    for (std::size_t i = 0; i < changes.size(); ++i) {
        std::vector<std::string> parts = parts_of(changes[i].path);
        const TableNode::Entry* const entry = document.root.find(parts[0]);
        if ((parts[0] == "light" || parts[0] == "object") && entry != nullptr)
            parts[1] = std::to_string(*elements.find(parts[0], parts[1]));
        last[std::move(parts)] = i;
    }
    std::set<std::size_t> in_order;
    for (const auto& [path, index] : last) in_order.insert(index);
    std::vector<Setting> result;
    for (const std::size_t index : in_order) result.push_back(changes[index]);
    return result;
}

std::optional<std::string> text_of_scene(const SceneRequest& request, Registry& registry,
                                         Diagnostics& diagnostics) {
    const auto scene = read_scene(request, registry, diagnostics);
    if (!scene) return std::nullopt;
    return scene_text(*scene);
}

}  // namespace

std::vector<TextChange> edited_files(const SceneRequest& request, const std::vector<Setting>& changes,
                                     Registry& registry, Diagnostics& diagnostics) {
    SceneRequest wanted = request;
    wanted.ask = nullptr;
    wanted.settings.insert(wanted.settings.end(), changes.begin(), changes.end());
    const auto goal = text_of_scene(wanted, registry, diagnostics);
    if (!goal) return {};

    SceneRequest plain = request;
    plain.settings.clear();
    Diagnostics known;
    const auto document = merge_documents(plain, known);
    if (!document) throw Error(ErrorCategory::failure, "a file of the scene is being changed");
    // Only the reader of a scene knows which values are paths.
    for (const Paths paths : {Paths::as_given, Paths::relative_to_file}) {
        Editor editor(*document, paths, diagnostics);
        for (const Setting& change : last_ones(changes, *document)) editor.change(change);
        std::vector<TextChange> texts = editor.texts();
        SceneRequest saved = request;
        saved.ask = nullptr;
        for (const TextChange& text : texts) saved.unsaved[text.file] = text.after;
        Diagnostics found;
        if (text_of_scene(saved, registry, found) == goal) return texts;
    }
    throw Error(ErrorCategory::bad_request,
                "these changes would have a different effect in the scene's files than as overrides, because "
                "something takes precedence over them, such as an object's own model or an option");
}

void replace_texts(std::span<const TextChange> changes) {
    std::vector<std::unique_ptr<OutputFile>> files;
    for (const TextChange& change : changes) {
        files.push_back(std::make_unique<OutputFile>(change.file));
        files.back()->write(change.after);
        files.back()->complete();
    }
    for (const TextChange& change : changes) {
        if (read_text_file(change.file) != change.before)
            throw Error(
                ErrorCategory::failure,
                fmt::format("'{}' was saved by another program meanwhile; not overwriting it. Run the "
                            "command again to change the new version",
                            change.file.string()));
    }
    for (const auto& file : files) file->finish();
}

}  // namespace candela
