#include "import/import.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "import/framing.h"
#include "import/geometry.h"
#include "import/readers.h"
#include "import/scene_text.h"
#include "import/vectors.h"

import candela.diagnostics;
import candela.text;

namespace fs = std::filesystem;

namespace importing {

void Model::note(std::string sentence) {
    if (std::ranges::find(notes, sentence) == notes.end()) notes.push_back(std::move(sentence));
}

void Model::note_one_of(const std::string& kind, std::string sentence) {
    const auto [known, is_new] = kinds_.try_emplace(kind, Kind{.note = notes.size()});
    if (is_new) {
        notes.push_back(std::move(sentence));
    } else {
        ++known->second.more;
    }
}

void Model::count_notes() {
    for (const auto& [kind, each] : kinds_)
        if (each.more > 0)
            notes[each.note] += fmt::format("; so {} {} more", each.more == 1 ? "is" : "are", each.more);
    kinds_.clear();
}

bool is_model(const fs::path& file) {
    constexpr std::array k_extensions = {"obj", "ply", "stl", "gltf", "glb"};
    return std::ranges::find(k_extensions, candela::extension_of(file)) != k_extensions.end();
}

namespace {

Model model_of(const Source& source, candela::Registry& registry) {
    const std::string extension = candela::extension_of(source.file);
    if (extension == "obj") return read_obj(source, registry);
    if (extension == "gltf" || extension == "glb") return read_gltf(source, registry);
    if (extension == "ply") return read_ply(source, registry);
    Model model;
    model.parts.emplace_back();
    return model;
}

/// No scene has anything farther out than a mesh may be.
bool is_near(const Vector& position) {
    constexpr double k_farthest = 1e9;
    return std::ranges::all_of(position, [](double x) { return std::abs(x) <= k_farthest; });
}

/// By what the model's coordinates are moved, too.
void move(Model& model, const Geometry& geometry) {
    if (geometry.origin.empty()) return;
    if (model.camera) model.camera->position = model.camera->position - geometry.moved;
    for (Light& light : model.lights) light.position = light.position - geometry.moved;
    model.note(fmt::format("it lies around [{}] of the file's coordinates, which is the scene's origin",
                           geometry.origin));
}

/// How bright the chosen lights are, so that the brightest surface that faces them does not burn out.
double brightness_for(const Model& model) {
    double brightest = 0;
    bool is_physical = false;
    for (const Material& material : model.materials) {
        is_physical = is_physical || material.reflection == "ggx";
        // Bright spots of a picture are somewhat brighter than its mean.
        constexpr double k_spots = 1.3;
        const double picture =
            material.picture ? std::min(1.0, k_spots * model.pictures[*material.picture].brightness) : 1;
        double sum = 0;
        // Of the key light and most of the fill light, and of the ambient light.
        constexpr double k_direct = 1.9, k_ambient = 0.6;
        for (const auto& [name, value] : material.values) {
            const double factor = name == "kd" ? k_direct : name == "ka" ? k_ambient : 0;
            sum += factor * *std::ranges::max_element(value);
        }
        brightest = std::max(brightest, picture * sum);
    }
    if (is_physical) return 0.55;
    return brightest > 1 ? 1 / brightest : 1;
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
    const Source source{.file = request.file, .allows_outside = request.allow_outside};
    const Geometry geometry = geometry_of(source, is_z_up, registry);
    Model model = model_of(source, registry);
    model.is_z_up = is_z_up;
    move(model, geometry);
    leave_out_what_is_too_far(model);

    Setting setting;
    setting.file = request.shown_file;
    setting.has_vertex_colors = geometry.has_colors;
    setting.is_textured = geometry.has_uv;
    setting.is_closed = geometry.is_closed;
    setting.origin = geometry.origin;
    setting.allows_outside = request.allow_outside;
    setting.tolerance = geometry.bounds.tolerance();
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
        setting.lights = lights_for(setting.camera, brightness_for(model));
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
    model.count_notes();
    setting.room = room_for(bounds, setting.camera, setting.lights);
    return {.scene = scene_text(model, setting),
            .notes = model.notes,
            .objects = model.parts.size(),
            .lights = setting.lights.size(),
            .textures = model.pictures.size()};
}

}  // namespace importing
