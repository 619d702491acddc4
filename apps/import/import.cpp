#include "import/import.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <numbers>

#include "import/framing.h"
#include "import/readers.h"
#include "import/scene_text.h"
#include "import/vectors.h"

import candela.diagnostics;
import candela.mesh;
import candela.parameters;
import candela.shape;
import candela.text;
import candela.transform;

namespace fs = std::filesystem;

namespace importing {

void Model::note(std::string sentence) {
    if (std::ranges::find(notes, sentence) == notes.end()) notes.push_back(std::move(sentence));
}

bool is_model(const fs::path& file) {
    constexpr std::array k_extensions = {"obj", "ply", "stl", "gltf", "glb"};
    return std::ranges::find(k_extensions, candela::extension_of(file)) != k_extensions.end();
}

namespace {

/// What only the triangles tell.
struct Geometry {
    Bounds bounds;
    bool has_colors = false, has_uv = false, is_closed = false;
};

Geometry geometry_of(const fs::path& file, bool is_z_up, candela::Registry& registry) {
    candela::ParamSet parameters = registry.parameters(candela::PluginKind::shape, "mesh");
    parameters.set("file", fs::absolute(file).string());
    const auto shape = registry.create<candela::Shape>("mesh", parameters, candela::ColorEncoding::srgb);
    candela::Transform transform;
    if (is_z_up) transform.rotation = {-90, 0, 0};
    candela::PlacedShape placed;
    try {
        placed = candela::place(*shape, {.uv = true, .color = true}, transform);
    } catch (const candela::Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& problem) {
        throw candela::Error(candela::ErrorCategory::failure, problem.what());
    }
    const candela::Mesh& mesh = placed.mesh;
    Geometry result;
    result.has_colors = !mesh.color.empty();
    result.has_uv = !mesh.u.empty();
    result.is_closed = mesh.open_edges == 0;
    const candela::ConstVec3Span position = mesh.position.span();
    const auto grow = [&](std::size_t axis, const float* values) {
        const auto [low, high] = std::minmax_element(values, values + mesh.vertex_count());
        result.bounds.low[axis] = static_cast<double>(*low);
        result.bounds.high[axis] = static_cast<double>(*high);
    };
    grow(0, position.x);
    grow(1, position.y);
    grow(2, position.z);
    return result;
}

Model model_of(const fs::path& file, candela::Registry& registry) {
    const std::string extension = candela::extension_of(file);
    if (extension == "obj") return read_obj(file, registry);
    if (extension == "gltf" || extension == "glb") return read_gltf(file, registry);
    Model model;
    model.parts.emplace_back();
    return model;
}

/// No scene has anything farther out than a mesh may be.
bool is_near(const Vector& position) {
    constexpr double k_farthest = 1e9;
    return std::ranges::all_of(position, [](double x) { return std::abs(x) <= k_farthest; });
}

void leave_out_what_is_too_far(Model& model) {
    if (model.camera && !is_near(model.camera->position)) {
        model.camera.reset();
        model.note("its camera is left out: it is more than a million kilometres away");
    }
    const std::size_t far =
        std::erase_if(model.lights, [](const Light& light) { return !is_near(light.position); });
    if (far > 0) model.note("lights more than a million kilometres away are left out");
}

}  // namespace

Imported import_model(const Request& request, candela::Registry& registry) {
    if (!is_model(request.file)) {
        throw candela::Error(
            candela::ErrorCategory::bad_request,
            fmt::format("'{}' is of no format that can be imported: .obj, .ply, .stl, .gltf, .glb",
                        request.file.string()));
    }
    std::error_code problem;
    if (!fs::exists(request.file, problem)) {
        throw candela::Error(candela::ErrorCategory::failure,
                             fmt::format("there is no file '{}'", request.file.string()));
    }
    // What machines print has z upwards.
    const bool is_stl = candela::extension_of(request.file) == "stl";
    const bool is_z_up = request.up == UpAxis::z || (request.up == UpAxis::by_format && is_stl);
    const Geometry geometry = geometry_of(request.file, is_z_up, registry);
    Model model = model_of(request.file, registry);
    model.is_z_up = is_z_up;
    leave_out_what_is_too_far(model);

    Setting setting;
    setting.file = request.shown_file;
    setting.has_vertex_colors = geometry.has_colors;
    setting.is_textured = geometry.has_uv;
    setting.is_closed = geometry.is_closed;
    if (!model.pictures.empty() && !geometry.has_uv) {
        model.note("its textures are left out: it has no texture coordinates");
        model.pictures.clear();
        for (Material& material : model.materials) material.picture.reset();
    }
    for (const Picture& picture : model.pictures)
        setting.pictures.push_back(picture.content.empty()
                                       ? request.name_of_picture(picture.file)
                                       : request.write_picture(picture.file.string(), picture.content));
    constexpr double k_aspect = 4.0 / 3;
    const Bounds& bounds = geometry.bounds;
    setting.camera = model.camera ? *model.camera : camera_for(bounds, k_aspect);
    const Vector to_center = bounds.center() - setting.camera.position;
    const double least_ahead = std::max(0.1 * bounds.radius(), 1e-3 * length(setting.camera.position));
    const double ahead = std::max(dot(to_center, unit(setting.camera.towards)), least_ahead);
    setting.look_at = setting.camera.position + ahead * unit(setting.camera.towards);
    if (!model.camera) setting.look_at = bounds.center();
    setting.lights = model.lights;
    if (setting.lights.empty()) {
        const bool is_physical = std::ranges::any_of(
            model.materials, [](const Material& material) { return material.reflection == "ggx"; });
        setting.lights = lights_for(setting.camera, is_physical ? 0.55 : 1);
    } else {
        const double factor = expose(setting.lights, bounds);
        if (factor != 1)
            model.note(fmt::format(
                "its lights are {:.3g} times as bright as in the file, for which it has no exposure",
                factor));
        if (separate(setting.lights, setting.camera, bounds))
            model.note(
                "lights at one place, or where the camera is, are moved a little along the line of sight");
    }
    setting.room = room_for(bounds, setting.camera, setting.lights);
    return {.scene = scene_text(model, setting),
            .notes = model.notes,
            .objects = model.parts.size(),
            .lights = setting.lights.size(),
            .textures = model.pictures.size()};
}

}  // namespace importing
