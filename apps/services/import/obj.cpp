#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "import/material_library.h"
#include "import/obj_statements.h"
#include "import/readers.h"

import candela.plugins;
import candela.util;

namespace fs = std::filesystem;

namespace importing {

Model read_obj(const Source& source, candela::Registry& registry) {
    Model model;
    obj::MaterialLibraries libraries(model, source, registry);
    const auto text = candela::read_text_file(source.file);
    std::vector<std::string> used;  // in the order of their first faces
    std::set<std::string, std::less<>> known;
    std::map<std::string, std::size_t> numbers;  // the shape `mesh`'s numbers
    std::string current = "(none)";
    bool is_listed = false;
    obj::each_statement(text ? *text : std::string_view(), [&](const obj::Statement& s) {
        if (s.keyword == "mtllib") {
            libraries.read_named(s.rest);
        } else if (s.keyword == "usemtl") {
            const std::string name = obj::name_from(s.rest);
            current = name.empty() ? "(none)" : name;
            numbers.try_emplace(current, numbers.size());
            is_listed = known.contains(current);
        } else if (!is_listed && (s.keyword == "f" || s.keyword == "fo")) {
            used.push_back(current);
            known.insert(current);
            numbers.try_emplace(current, numbers.size());
            is_listed = true;
        }
    });
    for (const std::string& name : used) {
        Part part;
        // A scene is UTF-8, but an OBJ file may not be.
        if (used.size() > 1)
            part.selector = candela::first_invalid_byte(name) ? fmt::format("#{}", numbers[name]) : name;
        if (libraries.has(name)) {
            part.material = model.materials.size();
            model.materials.push_back(libraries.material(name));
        } else if (name != "(none)") {
            model.count(
                "undescribed", fmt::format("the material '{}' is not in any material library", name),
                fmt::format("{{}} materials are not in any material library, the first of them '{}'", name));
        }
        model.parts.push_back(part);
    }
    const bool is_plain = std::ranges::all_of(used, [](const std::string& name) { return name == "(none)"; });
    if (libraries.are_there() && is_plain)
        model.note("it names a material library, but no face uses a material (usemtl); the model is grey");
    if (model.parts.empty()) model.parts.emplace_back();
    return model;
}

bool is_beside(const fs::path& part, const fs::path& model) {
    const fs::path folder = candela::canonical_path(fs::absolute(model).parent_path());
    const fs::path path = candela::canonical_path(fs::absolute(part));
    return std::ranges::mismatch(folder, path).in1 == folder.end();
}

bool Source::may_read(const fs::path& part) const { return allows_outside || is_beside(part, file); }

bool is_readable_picture(const fs::path& file, candela::Registry& registry) {
    return candela::reader_of(file, registry) != nullptr;
}

}  // namespace importing
