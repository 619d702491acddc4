#include "cpp_objects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "arrays.h"
#include "literals.h"

using candela::ParamSet;
using candela::Vec3;

namespace generate {

/// A plugin's name as an identifier of C++.
std::string identifier(const std::string& name) {
    static const std::set<std::string> k_taken = {
        "and",  "auto",  "bool",   "break", "case",  "char",   "class",  "const", "default", "double",
        "else", "enum",  "export", "false", "float", "for",    "friend", "goto",  "if",      "int",
        "long", "new",   "not",    "or",    "short", "static", "switch", "this",  "throw",   "true",
        "try",  "union", "using",  "void",  "while", "xor",    "inline", "signed"};
    std::string result = name;
    std::ranges::replace(result, '-', '_');
    return k_taken.contains(result) ? result + "_" : result;
}

std::string material_member(const ExportedModel& model) { return identifier(model.name()) + "_material"; }
std::string shading_member(const ExportedModel& model) { return identifier(model.name()) + "_shading"; }

std::string list(float x, float y, float z) {
    return fmt::format("{}, {}, {}", float_text(x), float_text(y), float_text(z));
}

/// A kernel's struct with these values: "PhongMaterial{vec3(0.1f), ...}", its members in their order.
std::string struct_text(const KernelSource& kernel, const ParamSet& values, candela::ColorEncoding encoding) {
    const std::vector<candela::ParamValue> delivered = values.delivered(encoding);
    std::vector<std::string> members;
    for (const KernelMember& member : kernel.parameters()->members) {
        const std::size_t at = values.index_of(member.name);
        members.push_back(at < delivered.size() ? member_text(values.schema()[at], delivered[at]) : "{}");
    }
    return fmt::format("{}{{{}}}", kernel.parameters()->name, fmt::join(members, ", "));
}

CppObjects::CppObjects(const ExportedScene& scene, const Templates& templates, candela::Registry& registry)
    : scene_(scene), templates_(templates), registry_(registry), encoding_(scene.image.color_management) {
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) add_object(i);
}

std::string CppObjects::shapes() const {
    std::string text;
    if (!shape_models_.empty()) text += templates_.text("cpp/grid.h") + "\n";
    if (!meshes_.empty()) {
        text += templates_.text("cpp/arrays.h") + "\n";
        for (std::size_t i = 0; i < meshes_.size(); ++i) text += fmt::format("Mesh mesh_{}();\n", i);
        text += "\n";
    }
    return text;
}

void CppObjects::add_object(std::size_t index) {
    const ExportedObject& object = scene_.objects[index];
    const bool needs_derivatives = scene_.needs_derivatives();
    const candela::MeshRequest request{.uv = true, .derivatives = needs_derivatives};
    const candela::PlacedShape shape = candela::place(*object.tessellator, request, {});
    require_plain_normals(object);
    std::optional<GridShape> grid;
    if (object.shape_model && object.shape_model->kernel.function("position") != nullptr)
        grid = grid_of(shape);
    if (grid) shape_models_.push_back(&*object.shape_model);

    std::string text =
        fmt::format("    {{  // {}: {}\n        Object o;\n", tame(object.label), tame(object.shape));
    text += grid ? grid_text(object, *grid, needs_derivatives)
                 : fmt::format("        o.mesh = mesh_{}();\n", mesh_number(shape));
    const candela::Transform& at = object.transform;
    text += fmt::format("        o.position = {};\n", vec3_text(at.position));
    if (at.rotation != Vec3{}) text += fmt::format("        o.rotation = {};\n", vec3_text(at.rotation));
    if (at.scale != Vec3{1, 1, 1}) text += fmt::format("        o.scale = {};\n", vec3_text(at.scale));
    text +=
        fmt::format("        o.color = color({});\n", list(object.color.x, object.color.y, object.color.z));
    if (scene_.shadings.size() > 1)
        text += fmt::format("        o.shading = Shading::{};\n",
                            identifier(scene_.shadings[object.shading].name()));
    if (scene_.reflections.size() > 1)
        text += fmt::format("        o.reflection = Reflection::{};\n",
                            identifier(scene_.reflections[object.reflection].name()));
    const auto add = [&](const ExportedModel& model, const std::string& name, const ParamSet& values) {
        if (model.kernel.parameters() != nullptr)
            text += fmt::format("        o.{} = {};\n", name, struct_text(model.kernel, values, encoding_));
    };
    for (std::size_t i = 0; i < scene_.reflections.size(); ++i)
        add(scene_.reflections[i], material_member(scene_.reflections[i]), object.materials[i]);
    for (std::size_t i = 0; i < scene_.shadings.size(); ++i)
        add(scene_.shadings[i], shading_member(scene_.shadings[i]), object.shadings[i]);
    statements_ += text + "        all.push_back(o);\n    }\n";
}

std::string CppObjects::grid_text(const ExportedObject& object, const GridShape& grid,
                                  bool needs_derivatives) const {
    const KernelSource& kernel = object.shape_model->kernel;
    std::string text;
    const bool has_parameters = kernel.parameters() != nullptr;
    if (has_parameters)
        text += fmt::format("        const {} shape = {};\n", kernel.parameters()->name,
                            struct_text(kernel, object.shape_values, encoding_));
    text += fmt::format(
        "        o.mesh = grid({}, {}, {{{}, {}, {}}}, [{}](float u, float v) {{ return {}; }});\n",
        grid.columns, grid.rows, grid.u_is_periodic, grid.v_is_periodic, grid.v_ends_in_poles,
        has_parameters ? "&" : "", kernel.call("position", "shape", "u, v"));
    if (needs_derivatives) {
        text += fmt::format(
            "        for (const vec2& at : o.mesh.uv) {{\n            o.mesh.dpdu.push_back({});\n       "
            "     "
            "o.mesh.dpdv.push_back({});\n        }}\n",
            kernel.call("dpdu", "shape", "at.x, at.y"), kernel.call("dpdv", "shape", "at.x, at.y"));
    }
    return text;
}

/// The number of an embedded mesh; equal ones are embedded once.
std::size_t CppObjects::mesh_number(const candela::PlacedShape& shape) {
    std::string body = number_array("float", "position", interleaved(shape.mesh.position)) +
                       number_array("int", "corners", shape.mesh.indices);
    std::string fill =
        "    Mesh m;\n    m.position = vectors_of(position);\n    m.corners.assign(std::begin(corners), "
        "std::end(corners));\n";
    const auto add_vectors = [&](const char* name, const candela::Vec3Arrays& arrays) {
        if (arrays.empty()) return;
        body += number_array("float", name, interleaved(arrays));
        fill += fmt::format("    m.{0} = vectors_of({0});\n", name);
    };
    bool has_groups = false;
    for (std::size_t v = 0; v < shape.smooth_group.size(); ++v)
        has_groups = has_groups || shape.smooth_group[v] != v;
    if (has_groups) {
        body += number_array("int", "group", shape.smooth_group);
        fill += "    m.group.assign(std::begin(group), std::end(group));\n";
    }
    add_vectors("authored", shape.authored_normal);
    if (scene_.needs_derivatives()) {
        add_vectors("dpdu", shape.mesh.dpdu);
        add_vectors("dpdv", shape.mesh.dpdv);
    }
    if (scene_.needs_uv() && !shape.mesh.u.empty()) {
        body += number_array("float", "uv_pairs", interleaved_uv(shape.mesh));
        fill +=
            "    for (std::size_t i = 0; i < std::size(uv_pairs); i += 2) m.uv.emplace_back(uv_pairs[i], "
            "uv_pairs[i + 1]);\n";
    }
    if (!shape.mesh.closed) fill += "    m.is_closed = false;\n";
    body += fill + "    return m;\n}\n";
    const auto same = std::ranges::find(meshes_, body);
    if (same != meshes_.end()) return static_cast<std::size_t>(same - meshes_.begin());
    data_ += fmt::format("\nMesh mesh_{}() {{\n", meshes_.size()) + body;
    meshes_.push_back(std::move(body));
    return meshes_.size() - 1;
}

/// The program finds vertex normals as a shading model does that says nothing else than its kernel.
void CppObjects::require_plain_normals(const ExportedObject& object) {
    struct Plain final : candela::ShadingModel {
        candela::ShadingRate shading_rate() const noexcept override { return {}; }
        void normals(const candela::ShadingPointBatch&, const candela::Vec3Span&) const override {}
    };
    for (std::size_t i = 0; i < scene_.shadings.size(); ++i) {
        const ExportedShading& model = scene_.shadings[i];
        if (model.kernel.function("corner_weight") != nullptr) continue;
        const auto shading =
            registry_.create<candela::ShadingModel>(model.name(), object.shadings[i], encoding_);
        const auto expected = candela::build_mesh(*object.tessellator, {}, object.transform, Plain());
        const auto actual = candela::build_mesh(*object.tessellator, {}, object.transform, *shading);
        const bool is_plain = std::ranges::equal(expected.vertices, actual.vertices, {},
                                                 &candela::MeshVertex::normal, &candela::MeshVertex::normal);
        if (!is_plain) {
            throw candela::Error(
                candela::ErrorCategory::failure,
                fmt::format("{} makes vertex normals of its own, of which its kernel says nothing "
                            "(there is no function {}_corner_weight), so that a C++ program cannot",
                            model.manifest->id(), model.kernel.prefix()));
        }
    }
}

}  // namespace generate
