#include "objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "candela/embed.h"
#include "candela/target/arrays.h"
#include "candela/target/kernels.h"
#include "candela/target/literals.h"
#include "candela/target/shadow_tree.h"
#include "candela/target/textures.h"
#include "shadows.h"

CANDELA_EMBED(candela_cpp_grid, CANDELA_SOURCE_DIR "/templates/grid.h");
CANDELA_EMBED(candela_cpp_arrays, CANDELA_SOURCE_DIR "/templates/arrays.h");

namespace candela::cpp_target {

using namespace target;

std::string material_member(const ExportedModel& model) { return identifier(model.plugin->name, "material"); }
std::string shading_member(const ExportedModel& model) { return identifier(model.plugin->name, "shading"); }
std::string reflection_enumerator(const ExportedModel& model) {
    return identifier(model.plugin->name, "reflection");
}
std::string shading_enumerator(const ExportedModel& model) {
    return identifier(model.plugin->name, "shading");
}

std::vector<std::string> reflection_enumerators(const ExportedScene& scene) {
    std::vector<std::string> names;
    for (const ExportedReflection& model : scene.reflections) names.push_back(reflection_enumerator(model));
    return names;
}
std::vector<std::string> shading_enumerators(const ExportedScene& scene) {
    std::vector<std::string> names;
    for (const ExportedShading& model : scene.shadings) names.push_back(shading_enumerator(model));
    return names;
}

std::string list(float x, float y, float z) {
    return fmt::format("{}, {}, {}", float_text(x), float_text(y), float_text(z));
}

namespace {

/// The picture of a number or a normal map, and how it continues.
template <class Reader>
std::string picture_text(const Reader& reader) {
    return fmt::format("{{&texture_{}(), {}, {}}}", reader.texture, static_cast<int>(reader.wrap[0]),
                       static_cast<int>(reader.wrap[1]));
}

}  // namespace

CppObjects::CppObjects(const ExportedScene& scene) : scene_(scene) {
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) add_object(i);
}

std::string CppObjects::shapes() const {
    std::string text;
    if (!shape_models_.empty()) text += std::string(candela_cpp_grid) + "\n";
    if (!meshes_.empty()) {
        text += std::string(candela_cpp_arrays) + "\n";
        for (std::size_t i = 0; i < meshes_.size(); ++i) text += fmt::format("Mesh mesh_{}();\n", i);
        text += "\n";
    }
    return text;
}

void CppObjects::add_object(std::size_t index) {
    const ExportedObject& object = scene_.objects[index];
    require_default_normals(index);
    const ExportedMesh mesh = scene_.geometry->in_object_space(index);
    const bool is_solid = mesh.is_solid;
    std::optional<GridShape> grid;
    if (has_function(object.shape, "position") && !mesh.color && mesh.channels.empty()) grid = grid_of(mesh);
    if (grid) shape_models_.push_back(object.shape);

    std::string text = fmt::format("    {{  // {}: {}\n        Object o;\n", ascii_identifier(object.label),
                                   ascii_identifier(object.shape.plugin->name));
    text += grid ? grid_text(object, *grid, scene_.needs_derivatives)
                 : fmt::format("        o.mesh = mesh_{}();\n", mesh_number(mesh));
    const Transform& at = object.transform;
    text += fmt::format("        o.position = {};\n", vec3_text(at.position));
    if (at.rotation != Vec3{}) text += fmt::format("        o.rotation = {};\n", vec3_text(at.rotation));
    if (at.scale != Vec3{1, 1, 1}) text += fmt::format("        o.scale = {};\n", vec3_text(at.scale));
    text +=
        fmt::format("        o.color = color({});\n", list(object.color.x, object.color.y, object.color.z));
    if (object.normal_map != nullptr) {
        const ExportedNormalMap& map = *object.normal_map;
        const auto axis = [&](std::size_t at) {
            return fmt::format("vec2({}, {})", float_text(map.to_uv[at]), float_text(map.to_uv[at + 1]));
        };
        text += fmt::format("        o.normal_map = {{{}, {{{}, {}}}, {}, {}, {}{}}};\n", picture_text(map),
                            list(map.placing[0], map.placing[1], map.placing[2]),
                            list(map.placing[3], map.placing[4], map.placing[5]), map.has_slopes, axis(0),
                            axis(2), map.uv == 0 ? "" : ", true");
    }
    if (scene_.shadings.size() > 1)
        text += fmt::format("        o.shading = Shading::{};\n",
                            shading_enumerator(scene_.shadings[object.shading]));
    if (scene_.reflections.size() > 1)
        text += fmt::format("        o.reflection = Reflection::{};\n",
                            reflection_enumerator(scene_.reflections[object.reflection]));
    const auto add = [&](const ExportedModel& model, const std::string& name, const ExportedValues& values) {
        if (has_parameters(model))
            text += fmt::format("        o.{} = {};\n", name, struct_text(model, values));
    };
    for (std::size_t i = 0; i < scene_.reflections.size(); ++i)
        add(scene_.reflections[i], material_member(scene_.reflections[i]), object.materials[i]);
    for (std::size_t i = 0; i < scene_.shadings.size(); ++i)
        add(scene_.shadings[i], shading_member(scene_.shadings[i]), object.shadings[i]);
    const Rgb emission = emission_of(object, scene_.image.color_management);
    if (has_emission(scene_) && emission != Rgb{})
        text += fmt::format("        o.emission = vec3({});\n", list(emission.r, emission.g, emission.b));
    if (object.occlusion != 1)
        text += fmt::format("        o.occlusion = {};\n", float_text(object.occlusion));
    if (!all_textured_numbers(object).empty()) {
        text += fmt::format("        o.textured = {};\n", textured_count_);
        textured_materials_ += textured_material(textured_count_++, object);
    }
    if (object.is_see_through()) {
        text += fmt::format("        o.opacity = {};\n", float_text(object.opacity));
        if (object.opacity_cutoff > 0)
            text += fmt::format("        o.opacity_cutoff = {};\n", float_text(object.opacity_cutoff));
    }
    if (!object.opacity_numbers.empty()) {
        text += fmt::format("        o.textured_opacity = {};\n", textured_opacity_count_);
        std::string product;
        for (const ExportedTexturedNumber& number : object.opacity_numbers)
            product += (product.empty() ? "" : " * ") +
                       number_text(number, texel_text(number, "opacity_place(o, triangle, b, is_seen)"));
        textured_opacities_ +=
            fmt::format("    if (o.textured_opacity == {})  // {}\n        opacity = {};\n",
                        textured_opacity_count_++, ascii_identifier(object.label), product);
    }
    if (casts_shadows(scene_)) {
        if (!object.casts_shadows) text += "        o.casts_shadows = false;\n";
        if (!object.receives_shadows) text += "        o.receives_shadows = false;\n";
        if (!is_solid) text += "        o.is_solid = false;\n";
        if (lights_vertices(scene_, object)) {
            const Vec3 middle = target::middle_of(scene_.geometry->in_world_space(index));
            text += fmt::format("        o.middle = vec3({});\n", list(middle.x, middle.y, middle.z));
        }
    }
    statements_ += text + "        all.push_back(o);\n    }\n";
}

/// Looks up a number's texel at a TexturePlace, or the channel of the vertices that it takes.
std::string CppObjects::texel_text(const ExportedTexturedNumber& n, const std::string& at) {
    if (n.vertex_channel != ExportedTexturedNumber::k_none)
        return fmt::format("channel_at({}, {})", at, n.vertex_channel);
    return fmt::format("texture_at({}, placed({{{}, {}}}, {}))", picture_text(n),
                       list(n.placing[0], n.placing[1], n.placing[2]),
                       list(n.placing[3], n.placing[4], n.placing[5]),
                       n.uv == 0 ? at : fmt::format("on_second_uv({})", at));
}

/// Sets the numbers of an object's material that textures give.
std::string CppObjects::textured_material(std::size_t number, const ExportedObject& object) const {
    const ExportedReflection& model = scene_.reflections[object.reflection];
    const auto lookup = [](const ExportedTexturedNumber& n) { return texel_text(n, "at"); };
    const auto [texels, assignments, common] = material_statements(
        scene_, object, {"        ", "const ", "m", "own.color", "own.emission", "own.occlusion"}, lookup);
    std::string material;
    if (!object.textured_numbers.empty())
        material =
            fmt::format("        {} m = {};\n{}        own.{} = {};\n", model.plugin->kernel.parameters,
                        parameters_text(model, object.materials[object.reflection]), assignments,
                        material_member(model), prepared(model, "m"));
    return fmt::format("    if (o.textured == {}) {{  // {}\n{}{}{}    }}\n", number,
                       ascii_identifier(object.label), texels, material, common);
}

std::string CppObjects::grid_text(const ExportedObject& object, const GridShape& grid,
                                  bool needs_derivatives) {
    const ExportedModel& model = object.shape;
    std::string text;
    if (has_parameters(model))
        text += fmt::format("        const {} shape = {};\n", model.plugin->kernel.parameters,
                            struct_text(model, object.shape_values));
    text += fmt::format(
        "        o.mesh = grid({}, {}, {{{}, {}, {}}}, [{}](float u, float v) {{ return {}; }});\n",
        grid.columns, grid.rows, grid.u_is_periodic, grid.v_is_periodic, grid.v_ends_in_poles,
        has_parameters(model) ? "&" : "", call(model, "position", "shape", "u, v"));
    if (needs_derivatives) {
        text += fmt::format(
            "        for (const vec2& at : o.mesh.uv) {{\n            o.mesh.dpdu.push_back({});\n"
            "            o.mesh.dpdv.push_back({});\n        }}\n",
            call(model, "dpdu", "shape", "at.x, at.y"), call(model, "dpdv", "shape", "at.x, at.y"));
    }
    return text;
}

/// The number of an embedded mesh; equal meshes are embedded once.
std::size_t CppObjects::mesh_number(const ExportedMesh& mesh) {
    std::string body = number_array("float", "position", interleaved(mesh.position, mesh.vertex_count)) +
                       number_array("int", "corners", mesh.indices);
    std::string fill =
        "    Mesh m;\n    m.position = vectors_of(position);\n    m.corners.assign(std::begin(corners), "
        "std::end(corners));\n";
    const auto add_vectors = [&](const char* name, ConstVec3Span arrays) {
        if (!arrays) return;
        body += number_array("float", name, interleaved(arrays, mesh.vertex_count));
        fill += fmt::format("    m.{0} = vectors_of({0});\n", name);
    };
    bool has_groups = false;
    for (std::size_t v = 0; v < mesh.smooth_group.size(); ++v)
        has_groups = has_groups || mesh.smooth_group[v] != v;
    if (has_groups) {
        body += number_array("int", "group", mesh.smooth_group);
        fill += "    m.group.assign(std::begin(group), std::end(group));\n";
    }
    add_vectors("authored", mesh.authored_normal);
    if (scene_.needs_derivatives) {
        add_vectors("dpdu", mesh.dpdu);
        add_vectors("dpdv", mesh.dpdv);
    }
    add_vectors("color", mesh.color);
    has_vertex_colors_ = has_vertex_colors_ || mesh.color;
    if (scene_.needs_uv && mesh.uv) {
        body += number_array("float", "uv_pairs", interleaved(mesh.uv, mesh.vertex_count));
        fill +=
            "    for (std::size_t i = 0; i < std::size(uv_pairs); i += 2) m.uv.emplace_back(uv_pairs[i], "
            "uv_pairs[i + 1]);\n";
    }
    if (needs_channels(scene_)) {
        for (std::size_t i = 0; i < mesh.channels.size(); ++i) {
            const std::span<const float> channel = mesh.channels[i];
            const std::string name = fmt::format("channel_{}", i);
            body += number_array("float", name.c_str(), std::vector<float>(channel.begin(), channel.end()));
            fill += fmt::format("    m.channels.emplace_back(std::begin({0}), std::end({0}));\n", name);
        }
    }
    if (!mesh.closed) fill += "    m.is_closed = false;\n";
    body += fill + "    return m;\n}\n";
    const auto same = std::ranges::find(meshes_, body);
    if (same != meshes_.end()) return static_cast<std::size_t>(same - meshes_.begin());
    data_ += fmt::format("\nMesh mesh_{}() {{\n", meshes_.size()) + body;
    meshes_.push_back(std::move(body));
    return meshes_.size() - 1;
}

/// Throws unless the shading models' vertex normals follow from their kernels, which is all that the program
/// contains.
void CppObjects::require_default_normals(std::size_t object) const {
    for (std::size_t i = 0; i < scene_.shadings.size(); ++i) {
        const ExportedShading& model = scene_.shadings[i];
        if (has_function(model, "corner_weight") || scene_.geometry->has_default_normals(object, i)) continue;
        throw std::runtime_error(
            fmt::format("{} makes its own vertex normals, which its kernel does not describe (there is no "
                        "function {}_corner_weight), so a C++ program cannot make them",
                        model.id, model.plugin->kernel.prefix));
    }
}

}  // namespace candela::cpp_target
