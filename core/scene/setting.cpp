module;

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

module candela.scene;

import :document;
import :setting;
import candela.util;

namespace candela {

namespace {

/// The name of a light or an object, or null.
const std::string* name_of(const Node& node) {
    const TableNode* const table = node.table();
    const TableNode::Entry* const name = table != nullptr ? table->find("name") : nullptr;
    return name != nullptr ? std::get_if<std::string>(&name->node.value) : nullptr;
}

std::optional<std::size_t> number_from(const std::string& text) {
    std::size_t number = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

class Setter {
  public:
    Setter(std::vector<std::string> parts, const SourceLocation& place, TableNode& root,
           Diagnostics& diagnostics, const ElementIndex* index)
        : parts_(std::move(parts)), place_(place), root_(root), diagnostics_(diagnostics), index_(index) {}

    bool apply(Node value) {
        if (std::ranges::any_of(parts_, [](const std::string& part) { return part.empty(); })) {
            return fail("the path has an empty part");
        }
        if (parts_.size() < 2) return fail("the path needs a table and a key, as in image.width");
        TableNode* table = nullptr;
        std::size_t next = 1;
        if (parts_[0] == "light" || parts_[0] == "object") {
            if (parts_.size() < 3)
                return fail(fmt::format("the path needs a key, as in {}.0.color", parts_[0]));
            table = element(parts_[0], parts_[1]);
            next = 2;
        } else {
            table = table_in(root_, parts_[0]);
        }
        for (; table != nullptr && next + 1 < parts_.size(); ++next) table = table_in(*table, parts_[next]);
        if (table == nullptr) return false;
        if (TableNode::Entry* const entry = table->find(parts_.back())) {
            entry->key_place = place_;
            entry->node = std::move(value);
        } else {
            table->entries.push_back({parts_.back(), place_, std::move(value)});
        }
        return true;
    }

  private:
    bool fail(const std::string& message, const std::string& hint = {}) {
        diagnostics_.error(place_, message, hint);
        return false;
    }

    TableNode* table_in(TableNode& parent, const std::string& key) {
        if (parent.find(key) == nullptr) parent.entries.push_back({key, place_, Node{place_, TableNode{}}});
        TableNode* const table = parent.find(key)->node.table();
        if (table == nullptr) fail(fmt::format("'{}' is not a table", key));
        return table;
    }

    /// The light or object with that name, or with that index from 0.
    TableNode* element(const std::string& kind, const std::string& which) {
        TableNode::Entry* const entry = root_.find(kind);
        ArrayNode* const all = entry != nullptr ? entry->node.array() : nullptr;
        if (all == nullptr || all->empty()) {
            fail(fmt::format("the scene has no {}", kind));
            return nullptr;
        }
        const auto index =
            index_ != nullptr ? index_->find(kind, which) : ElementIndex(root_).find(kind, which);
        if (index) return (*all)[*index].table();
        if (const auto number = number_from(which)) {
            fail(fmt::format("there is no {} {}; they are numbered 0 to {}", kind, *number, all->size() - 1));
            return nullptr;
        }
        std::vector<std::string> names;
        for (const Node& node : *all)
            if (const std::string* const name = name_of(node)) names.push_back(*name);
        fail(fmt::format("no {} is called '{}'", kind, which), suggestion(which, names));
        return nullptr;
    }

    std::vector<std::string> parts_;
    const SourceLocation& place_;
    TableNode& root_;
    Diagnostics& diagnostics_;
    const ElementIndex* index_;
};

}  // namespace

std::vector<std::string> parts_of(std::string_view path) {
    std::vector<std::string> parts(1);
    bool quoted = false;
    for (const char c : path) {
        if (c == '"') {
            quoted = !quoted;
        } else if (c == '.' && !quoted) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

bool set_value(TableNode& root, std::vector<std::string> parts, Node value, const SourceLocation& place,
               Diagnostics& diagnostics, const ElementIndex* index) {
    return Setter(std::move(parts), place, root, diagnostics, index).apply(std::move(value));
}

ElementIndex::ElementIndex(const TableNode& root) {
    const auto add_all = [&](std::string_view kind, Kind& to) {
        const TableNode::Entry* const entry = root.find(kind);
        const ArrayNode* const all = entry != nullptr ? entry->node.array() : nullptr;
        if (all == nullptr) return;
        to.count = all->size();
        for (std::size_t i = 0; i < all->size(); ++i)
            if (const std::string* const name = name_of((*all)[i])) to.first_named.try_emplace(*name, i);
    };
    add_all("light", lights_);
    add_all("object", objects_);
}

std::optional<std::size_t> ElementIndex::find(std::string_view kind, const std::string& which) const {
    const Kind& elements = kind == "light" ? lights_ : objects_;
    if (const auto found = elements.first_named.find(which); found != elements.first_named.end())
        return found->second;
    const auto number = number_from(which);
    return number && *number < elements.count ? number : std::nullopt;
}

}  // namespace candela
