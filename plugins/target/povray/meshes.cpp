#include "meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "candela/target/literals.h"
#include "candela/target/renderers.h"
#include "lights.h"
#include "material.h"
#include "opacity.h"
#include "shadows.h"
#include "triangles.h"
#include "vertex_values.h"

namespace candela::povray_target {

namespace {

class Statement {
  public:
    explicit Statement(const std::string& comment) : text_(fmt::format("\n// {}\nmesh2 {{\n", comment)) {}

    void add(const char* name, std::span<const Vec3> vectors) {
        begin(name, vectors.size());
        for (const Vec3& v : vectors)
            fmt::format_to(std::back_inserter(text_), ",\n        <{}, {}, {}>", v.x, v.y, v.z);
        text_ += "\n    }\n";
    }
    void add(const char* name, std::span<const std::array<float, 2>> vectors) {
        begin(name, vectors.size());
        for (const auto& [u, v] : vectors)
            fmt::format_to(std::back_inserter(text_), ",\n        <{}, {}>", u, v);
        text_ += "\n    }\n";
    }
    void add(const char* name, std::span<const std::string> textures) {
        begin(name, textures.size());
        for (const std::string& texture : textures)
            fmt::format_to(std::back_inserter(text_), ",\n        texture {{ {} }}", texture);
        text_ += "\n    }\n";
    }
    /// `texture_of_vertex`: empty if all vertices share one.
    void add(const char* name, std::span<const std::uint32_t> indices,
             std::span<const std::size_t> texture_of_vertex = {}) {
        begin(name, indices.size() / 3);
        // Clockwise seen from outside: POV-Ray's own coordinates are left-handed.
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            const std::uint32_t a = indices[i], b = indices[i + 2], c = indices[i + 1];
            fmt::format_to(std::back_inserter(text_), ",\n        <{}, {}, {}>", a, b, c);
            if (!texture_of_vertex.empty())
                fmt::format_to(std::back_inserter(text_), ", {}, {}, {}", texture_of_vertex[a],
                               texture_of_vertex[b], texture_of_vertex[c]);
        }
        text_ += "\n    }\n";
    }
    std::string ended_with(const std::string& rest) { return text_ + rest + "}\n"; }

  private:
    void begin(const char* name, std::size_t count) {
        fmt::format_to(std::back_inserter(text_), "    {} {{ {}", name, count);
    }

    std::string text_;
};

/// A texture for each colour and opacity that vertices of an object have, declared before its meshes.
class VertexMaterials {
  public:
    VertexMaterials(const ExportedScene& scene, std::size_t object, const Cover& cover,
                    const VertexValues& values, FileSink& files)
        : scene_(scene), object_(object), cover_(cover), files_(files) {
        if (values.colors.empty()) {
            base_ = fmt::format("Surface_{}", object);
            declarations_ = fmt::format("#declare {} =\n{}", base_, material_of(scene, object, files).front);
        }
        for (std::size_t v = 0; v < count_of(values); ++v)
            if (numbers_.try_emplace(key_of(values, v), names_.size()).second) declare(values, v);
    }

    const std::string& declarations() const { return declarations_; }
    std::span<const std::string> names() const { return names_; }
    std::vector<std::size_t> numbers_of(const VertexValues& values) const {
        std::vector<std::size_t> numbers;
        for (std::size_t v = 0; v < count_of(values); ++v) numbers.push_back(numbers_.at(key_of(values, v)));
        return numbers;
    }

  private:
    static std::size_t count_of(const VertexValues& values) {
        return std::max(values.colors.size(), values.opacities.size());
    }
    static std::array<float, 4> key_of(const VertexValues& values, std::size_t v) {
        const Vec3 color = values.colors.empty() ? Vec3{} : values.colors[v];
        return {color.x, color.y, color.z, values.opacities.empty() ? 1 : values.opacities[v]};
    }

    void declare(const VertexValues& values, std::size_t v) {
        names_.push_back(fmt::format("Vertex_{}_{}", object_, names_.size()));
        const std::optional<float> opacity =
            values.opacities.empty() ? std::nullopt : std::optional(values.opacities[v]);
        Material material;
        if (base_.empty())
            material = cover_.over(
                {.front = material_at_vertex(scene_, object_, values.colors[v], files_).front, .turned = {}},
                names_.back() + "_covering", opacity);
        else
            material.front = fmt::format("    texture {{ {} }}\n", cover_.over(base_, opacity));
        fmt::format_to(std::back_inserter(declarations_), "{}#declare {} =\n{}", material.declarations,
                       names_.back(), material.front);
    }

    const ExportedScene& scene_;
    std::size_t object_;
    const Cover& cover_;
    FileSink& files_;
    std::map<std::array<float, 4>, std::size_t> numbers_;
    std::vector<std::string> names_;
    std::string base_;  // the texture that all vertices share but for their opacity
    std::string declarations_;
};

/// `rest`: the material of all vertices, except for what `of_vertices` determines, and keywords.
std::string mesh2_text(const std::string& comment, Triangles triangles, const std::string& rest,
                       const VertexMaterials* of_vertices = nullptr) {
    if (triangles.indices.empty()) return "";
    keep_equal_normals(triangles);
    Statement statement(comment);
    statement.add("vertex_vectors", triangles.positions);
    if (!triangles.normals.empty()) statement.add("normal_vectors", triangles.normals);
    if (!triangles.uv.empty()) statement.add("uv_vectors", triangles.uv);
    if (of_vertices != nullptr) {
        statement.add("texture_list", of_vertices->names());
        statement.add("face_indices", triangles.indices, of_vertices->numbers_of(triangles.values));
    } else {
        statement.add("face_indices", triangles.indices);
    }
    if (!triangles.normal_indices.empty()) statement.add("normal_indices", triangles.normal_indices);
    return statement.ended_with(rest);
}

Vec3 mean_of(std::span<const Vec3> colors) {
    Vec3 sum{};
    for (const Vec3& color : colors) sum = sum + color;
    return 1 / static_cast<float>(colors.size()) * sum;
}

std::optional<float> mean_of(std::span<const float> opacities) {
    if (opacities.empty()) return std::nullopt;
    float sum = 0;
    for (const float opacity : opacities) sum += opacity;
    return sum / static_cast<float>(opacities.size());
}

/// A mesh with colours or opacities at its vertices.
std::string varying_mesh_text(const ExportedScene& scene, std::size_t object, const Cover& cover,
                              const std::string& name, Triangles triangles, const char* keywords,
                              FileSink& files) {
    const VertexMaterials of_vertices(scene, object, cover, triangles.values, files);
    Triangles outline;
    if (!triangles.normals.empty()) outline = split_off_outline(triangles, scene.observer);
    std::string text =
        of_vertices.declarations() + mesh2_text(name, std::move(triangles), keywords, &of_vertices);
    if (outline.indices.empty()) return text;
    const VertexValues& values = outline.values;
    files.approximate("near the outline of an object, the colours at its vertices may be their mean");
    const Material mean =
        cover.over(values.colors.empty() ? material_of(scene, object, files)
                                         : material_at_vertex(scene, object, mean_of(values.colors), files),
                   fmt::format("Covering_{}", object), mean_of(values.opacities));
    return text + mean.declarations +
           mesh2_text(name + ", its triangles at the outline, as the observer sees them", std::move(outline),
                      mean.front + mean.turned + keywords, &of_vertices);
}

/// The visible surface of an object. `keywords`: at the end of its statements.
std::string visible_text(const ExportedScene& scene, std::size_t index, const ExportedMesh& mesh,
                         const Cover& cover, const std::string& name, const char* keywords, FileSink& files) {
    const ExportedObject& object = scene.objects[index];
    const ExportedShading& shading = scene.shadings[object.shading];
    target::approximate_shading(shading, files);
    const bool has_faces = shading.rate == ShadingRate::face;
    Triangles triangles =
        triangles_of(mesh, has_faces ? ConstVec3Span{} : mesh.normals[mesh.normals_of[object.shading]],
                     are_of_pictures(object.color_numbers) || cover.has_texture(),
                     vertex_values_of(scene, index, mesh, files));
    if (!triangles.values.empty())
        return varying_mesh_text(scene, index, cover, name, std::move(triangles), keywords, files);
    const Material material = cover.over(material_of(scene, index, files), fmt::format("Covering_{}", index));
    if (has_faces)
        return material.declarations + mesh2_text(name, std::move(triangles), material.front + keywords);
    if (mesh.closed)
        return material.declarations +
               mesh2_text(name, std::move(triangles), material.front + material.turned + keywords);
    Triangles outline = split_off_outline(triangles, scene.observer);
    return material.declarations + mesh2_text(name, std::move(triangles), material.front + keywords) +
           mesh2_text(name + ", its triangles at the outline, as the observer sees them", std::move(outline),
                      material.front + material.turned + keywords);
}

/// The triangles of an object as they block light, without being seen. The texture of the side on which a
/// shadow ray meets a surface stops it, or lets it pass: light leaves a solid object. POV-Ray looks at that
/// only if the outer texture is not quite opaque.
std::string blocker_text(const ExportedScene& scene, std::size_t index, const ExportedMesh& mesh,
                         const Cover& cover, const std::string& name, FileSink& files) {
    const std::optional<float> opacity = mean_of(vertex_values_of(scene, index, mesh, files).opacities);
    if (opacity)
        files.approximate(fmt::format("the shadow of object {} has the mean of the opacities at its vertices",
                                      scene.objects[index].label)
                              .c_str());
    const std::string opaque = "pigment { rgb 0 }";
    const std::string textures =
        mesh.is_solid
            ? "    texture { pigment { rgb 0 transmit 1e-9 } }\n"
              "    interior_texture { pigment { rgbt 1 } }\n"
            : "    texture { " + (cover.is_opaque() ? opaque : cover.over(opaque, opacity)) + " }\n";
    return mesh2_text(name + ", as it blocks light", triangles_of(mesh, {}, cover.has_texture()),
                      textures + "    no_image no_reflection\n");
}

/// The visible surface of an object, in a group with the lights that nothing blocks.
std::string group_text(const ExportedScene& scene, std::size_t index, const ExportedMesh& mesh,
                       const std::string& visible, FileSink& files) {
    const ExportedObject& object = scene.objects[index];
    const std::string shell = fmt::format("Shell_{}", index);
    std::string text = mesh2_text("light that reaches this shell is not blocked before", shell_of(mesh), "");
    text.insert(text.find("mesh2"), fmt::format("#declare {} = ", shell));
    return text + fmt::format("light_group {{\n{}{}    global_lights {}\n}}\n",
                              unblocked_lights_text(scene, shell, !object.receives_shadows, files), visible,
                              object.receives_shadows ? "on" : "off");
}

}  // namespace

std::string mesh_text(const ExportedScene& scene, std::size_t index, FileSink& files) {
    const ExportedObject& object = scene.objects[index];
    const ExportedMesh mesh = scene.geometry->in_world_space(index);
    const std::string name = fmt::format("{}: {}", target::ascii_identifier(object.label),
                                         target::ascii_identifier(object.shape.plugin->name));
    const Cover cover(scene, index, files);
    if (!scene.has_shadows) return visible_text(scene, index, mesh, cover, name, "    no_shadow\n", files);
    approximate_shadows(scene, index, mesh, files);
    const bool is_grouped = has_unblocked_lights(scene, object);
    const bool blocks_itself = object.casts_shadows && !mesh.is_solid && !is_grouped;
    std::string text =
        visible_text(scene, index, mesh, cover, name, blocks_itself ? "" : "    no_shadow\n", files);
    if (is_grouped) text = group_text(scene, index, mesh, text, files);
    return object.casts_shadows && !blocks_itself
               ? text + blocker_text(scene, index, mesh, cover, name, files)
               : text;
}

}  // namespace candela::povray_target
