#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "import/material_library.h"
#include "import/readers.h"
#include "mesh_io/obj_statements.h"
#include "mesh_io/surface.h"

import candela.plugins;
import candela.util;

namespace fs = std::filesystem;

namespace importing {

Model read_obj(const Source& source, candela::Registry& registry) {
    Model model;
    obj::MaterialLibraries libraries(model, source, registry);
    const auto text = candela::read_text_file(source.file);
    mesh_io::ObjMaterials materials = mesh_io::materials_of_obj(text ? *text : std::string_view());
    for (const std::string& names : materials.libraries) libraries.read_named(names);
    const std::vector<std::string>& used = materials.used;
    for (const std::string& name : used) {
        Part part;
        // A scene is UTF-8, but an OBJ file may not be.
        if (used.size() > 1)
            part.selector =
                candela::first_invalid_byte(name) ? fmt::format("#{}", materials.numbers.of(name)) : name;
        if (libraries.has(name)) {
            part.material = model.materials.size();
            model.materials.push_back(libraries.material(name));
        } else if (name != mesh_io::k_no_material) {
            model.count(
                "undescribed", fmt::format("the material '{}' is not in any material library", name),
                fmt::format("{{}} materials are not in any material library, the first of them '{}'", name));
        }
        model.parts.push_back(part);
    }
    const bool is_plain =
        std::ranges::all_of(used, [](const std::string& name) { return name == mesh_io::k_no_material; });
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

bool is_readable_image(const fs::path& file, candela::Registry& registry) {
    return candela::reader_of(file, registry) != nullptr;
}

}  // namespace importing
