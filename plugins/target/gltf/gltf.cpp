// A scene as one GLB file: nodes with meshes, a camera and lights.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "candela/target/files.h"
#include "candela/target/mirror.h"
#include "candela/target/renderers.h"
#include "candela/target/textures.h"
#include "candela/target_plugin.h"
#include "document.h"
#include "lights.h"
#include "materials.h"
#include "metallic_roughness.h"
#include "placement.h"
#include "vertex_numbers.h"

namespace candela::gltf_target {

namespace {

/// The visible distance: all of the room from anywhere in it.
double farthest(const ExportedScene& scene) { return 2 * std::max(length(scene.room), 100.0f); }

Json camera_json(const ExportedScene& scene) {
    const ExportedObserver& observer = scene.observer;
    const double aspect = static_cast<double>(scene.image.width) / scene.image.height;
    if (observer.projection == Projection::orthographic) {
        const double half = observer.height / 2.0;
        return {{"type", "orthographic"},
                {"orthographic",
                 {{"xmag", half * aspect}, {"ymag", half}, {"znear", 0}, {"zfar", farthest(scene)}}}};
    }
    constexpr double k_nearest = 0.01;
    return {
        {"type", "perspective"},
        {"perspective",
         {{"aspectRatio", aspect}, {"yfov", observer.fov * std::numbers::pi / 180}, {"znear", k_nearest}}}};
}

class Writer {
  public:
    Writer(const ExportedScene& scene, FileSink& files) : scene_(scene), files_(files) {}

    std::string write() {
        document_.root["asset"] = {{"version", "2.0"}, {"generator", "Candela " CANDELA_PLUGIN_VERSION}};
        document_.root["scene"] = 0;
        if (scene_.image.color_management == ColorEncoding::none)
            files_.approximate(
                "color_management = \"none\" becomes light that is added up linearly and encoded in the "
                "picture");
        target::approximate_mirror_images(scene_, files_);
        if (scene_.image.exposure != 1) files_.approximate("the exposure is left out");
        if (scene_.image.tone != ToneCurve::none) files_.approximate("the tone curve is left out");
        Json nodes = Json::array();
        for (std::size_t i = 0; i < scene_.objects.size(); ++i) add_object(i, nodes);
        add_lights(scene_, document_, nodes, files_);
        const std::size_t camera = document_.add("cameras", camera_json(scene_));
        nodes.push_back(document_.add(
            "nodes", {{"name", "observer"},
                      {"camera", camera},
                      {"matrix", placement(target::axes_of(scene_.observer), scene_.observer.position)}}));
        document_.add("scenes", {{"name", scene_.title}, {"nodes", std::move(nodes)}});
        return document_.glb();
    }

  private:
    void add_object(std::size_t index, Json& nodes) {
        const ExportedObject& whole = scene_.objects[index];
        const ExportedShading& shading = scene_.shadings[whole.shading];
        target::approximate_shading(shading, files_);
        if (scene_.has_shadows && !(whole.casts_shadows && whole.receives_shadows))
            files_.approximate("every object casts and receives shadows, or none does");
        const ExportedMesh mesh = scene_.geometry->in_world_space(index);
        if (mesh.indices.empty()) return;
        const VertexNumbers of_vertices(scene_, whole, mesh, files_);
        const ExportedObject& object = of_vertices.rest();
        const std::size_t count = mesh.vertex_count;
        Json attributes = {{"POSITION", document_.add_positions(mesh.position, count)}};
        const ConstVec3Span normals = mesh.normals[mesh.normals_of[object.shading]];
        // Without normals, a triangle is flat.
        if (shading.rate != ShadingRate::face) attributes["NORMAL"] = document_.add_vectors(normals, count);
        const bool has_tangents =
            mesh.dpdu && shading.rate != ShadingRate::face &&
            (object.normal_map != nullptr ||
             is_anisotropic(scene_.reflections[object.reflection], object.materials[object.reflection]));
        if (has_tangents)
            attributes["TANGENT"] = document_.add_tangents(mesh.dpdu, mesh.dpdv, normals, count);
        const bool is_textured =
            !target::all_textured_numbers(object).empty() || object.normal_map != nullptr;
        if (mesh.uv && (has_tangents || is_textured))
            attributes["TEXCOORD_0"] = document_.add_texture_coordinates(mesh.uv, count);
        if (mesh.second_uv) {
            attributes["TEXCOORD_1"] = document_.add_texture_coordinates(mesh.second_uv, count);
            // The sets of a primitive are numbered from 0.
            if (!attributes.contains("TEXCOORD_0")) attributes["TEXCOORD_0"] = attributes["TEXCOORD_1"];
        }
        of_vertices.add_to(attributes, document_);
        const std::size_t indices = document_.add_indices(mesh.indices);
        const std::size_t material = materials_.add(object, of_vertices.alpha(), mesh.closed);
        const std::size_t added =
            document_.add("meshes", {{"name", object.label},
                                     {"primitives", Json::array({{{"attributes", std::move(attributes)},
                                                                  {"indices", indices},
                                                                  {"material", material}}})}});
        nodes.push_back(document_.add("nodes", {{"name", object.label}, {"mesh", added}}));
    }

    const ExportedScene& scene_;
    FileSink& files_;
    Document document_;
    Materials materials_{scene_, document_, files_};
};

class GltfTarget final : public Target {
  public:
    explicit GltfTarget(const sdk::NoParams&) {}

    TargetAbilities abilities() const noexcept override {
        return {.models_without_kernel = true,
                .triangle = true,
                .vertex_colors = true,
                .textures = true,
                .textured_numbers = true,
                .second_uv = true,
                .vertex_channels = true,
                .normal_maps = true,
                .emission = true,
                .occlusion = true,
                .opacity = true,
                .shadows = true,  // programs that show the file cast their own, and expose it
                .display = true};
    }
    const char* main_file() const noexcept override { return "scene.glb"; }

    void write(const ExportedScene& scene, FileSink& files) const override {
        target::write(files, main_file(), Writer(scene, files).write());
    }
};

constexpr Property k_properties[] = {{"exact-light", "directional, distributed, point"},
                                     {"exact-reflection", "lambert, metallic-roughness, specular-glossiness"},
                                     {"exact-shading", "phong, angle-weighted, area-weighted, max-weighted"}};

}  // namespace

}  // namespace candela::gltf_target

using candela::gltf_target::GltfTarget;

CANDELA_PLUGIN(target, GltfTarget, candela::sdk::k_no_fields,
               {.title = "glTF",
                .summary = "one GLB file for other programs: meshes, camera, lights, materials, textures",
                .reference = "Khronos Group (2021), glTF 2.0 specification",
                .properties = candela::gltf_target::k_properties})
