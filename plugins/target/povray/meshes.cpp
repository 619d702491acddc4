#include "meshes.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <utility>

#include "candela/target/literals.h"
#include "candela/target/renderers.h"
#include "material.h"
#include "triangles.h"

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
    void add(const char* name, std::span<const std::uint32_t> indices) {
        begin(name, indices.size() / 3);
        // Clockwise seen from outside: POV-Ray's own coordinates are left-handed.
        for (std::size_t i = 0; i < indices.size(); i += 3)
            fmt::format_to(std::back_inserter(text_), ",\n        <{}, {}, {}>", indices[i], indices[i + 2],
                           indices[i + 1]);
        text_ += "\n    }\n";
    }
    std::string ended_with(const std::string& material) { return text_ + material + "    no_shadow\n}\n"; }

  private:
    void begin(const char* name, std::size_t count) {
        fmt::format_to(std::back_inserter(text_), "    {} {{ {}", name, count);
    }

    std::string text_;
};

std::string mesh_text(const std::string& comment, Triangles triangles, const std::string& material) {
    if (triangles.indices.empty()) return "";
    keep_equal_normals(triangles);
    Statement statement(comment);
    statement.add("vertex_vectors", triangles.positions);
    if (!triangles.normals.empty()) statement.add("normal_vectors", triangles.normals);
    statement.add("face_indices", triangles.indices);
    if (!triangles.normal_indices.empty()) statement.add("normal_indices", triangles.normal_indices);
    return statement.ended_with(material);
}

}  // namespace

std::string mesh_text(const ExportedScene& scene, std::size_t index, FileSink& files) {
    const ExportedObject& object = scene.objects[index];
    const ExportedShading& shading = scene.shadings[object.shading];
    target::approximate_shading(shading, files);
    const ExportedMesh mesh = scene.geometry->in_world_space(index);
    const std::string name =
        fmt::format("{}: {}", target::tame(object.label), target::tame(object.shape.plugin->name));
    if (shading.rate == ShadingRate::face)
        return mesh_text(name, triangles_of(mesh, {}), material_text(scene, object, false, files));
    Triangles triangles = triangles_of(mesh, mesh.normals[mesh.normals_of[object.shading]]);
    const std::string turning = material_text(scene, object, true, files);
    if (mesh.closed) return mesh_text(name, std::move(triangles), turning);
    const Triangles outline = split_off_outline(triangles, scene.observer);
    return mesh_text(name, std::move(triangles), material_text(scene, object, false, files)) +
           mesh_text(name + ", its triangles at the outline, as the observer sees them", outline, turning);
}

}  // namespace candela::povray_target
