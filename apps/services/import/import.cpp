#include "import/import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <optional>

#include "import/animation.h"
#include "import/framing.h"
#include "import/geometry.h"
#include "import/heights.h"
#include "import/readers.h"
#include "import/scene_text.h"
#include "import/vectors.h"

import candela.api;
import candela.geometry;
import candela.plugins;
import candela.scene;
import candela.util;

namespace fs = std::filesystem;

namespace importing {

Vector encoded(const std::vector<double>& linear) {
    Vector color{};
    for (std::size_t k = 0; k < 3; ++k)
        color[k] =
            std::round(255 * candela::linear_to_srgb(static_cast<float>(std::clamp(linear[k], 0.0, 1.0))));
    return color;
}

double rounded(double number) { return std::round(1e4 * number) / 1e4; }

std::vector<double> shortened(std::vector<double> numbers) {
    for (double& x : numbers) x = rounded(x);
    if (std::ranges::all_of(numbers, [&](double x) { return x == numbers[0]; })) numbers.resize(1);
    return numbers;
}

void set_emission(const std::vector<double>& intensity, Material& to) {
    const double strength = *std::ranges::max_element(intensity);
    to.emission = {0, 0, 0};
    to.emission_strength = 1;
    if (!(strength > 0)) return;
    std::vector<double> share = intensity;
    for (double& channel : share) channel /= strength;
    to.emission = encoded(share);
    to.emission_strength = strength;
}

void Model::note(std::string sentence) {
    if (std::ranges::find(notes, sentence) == notes.end()) notes.push_back(std::move(sentence));
}

void Model::count(const std::string& kind, std::string one, std::string_view many) {
    const auto [known, is_new] =
        counted_.try_emplace(kind, Counted{.note = notes.size(), .count = 1, .many = std::string(many)});
    if (is_new) return notes.push_back(std::move(one));
    // Not with fmt: names from the file may contain braces.
    std::string sentence = known->second.many;
    sentence.replace(sentence.find("{}"), 2, std::to_string(++known->second.count));
    notes[known->second.note] = std::move(sentence);
}

namespace {

/// Ambient light that shows only what is unlit, whose share of it is large.
constexpr double k_for_unlit = 0.02;

Model model_of(const Source& source, bool with_animation, candela::Registry& registry) {
    const std::string extension = candela::extension_of(source.file);
    if (extension == "obj") return read_obj(source, registry);
    if (extension == "gltf" || extension == "glb") return read_gltf(source, with_animation, registry);
    if (extension == "ply") return read_ply(source, registry);
    Model model;
    model.parts.emplace_back();
    return model;
}

/// Shows back faces of a model seen only from behind; a single-sided plane would otherwise give an empty
/// picture.
void show_backs_alone(Model& model, const candela::Mesh& mesh, const Vector& to_observer) {
    if (std::ranges::any_of(model.parts, [](const Part& part) { return part.sides != Sides::front; })) return;
    const auto vertex = [&](std::uint32_t index) {
        const candela::Vec3 p = mesh.position.span()[index];
        return Vector{p.x, p.y, p.z};
    };
    double front = 0, back = 0;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const Vector a = vertex(mesh.indices[3 * t]);
        const double area =
            dot(cross(vertex(mesh.indices[3 * t + 1]) - a, vertex(mesh.indices[3 * t + 2]) - a), to_observer);
        (area > 0 ? front : back) += std::abs(area);
    }
    constexpr double k_hardly_any = 0.01;
    if (front > k_hardly_any * back) return;
    for (Part& part : model.parts) part.sides = Sides::both;
    model.note("its triangles are single-sided and face away from the observer, so both sides are drawn");
}

/// Positions in a scene are limited like those of a mesh.
bool is_near(const Vector& position) {
    constexpr double k_farthest = 1e9;
    return std::ranges::all_of(position, [](double x) { return std::abs(x) <= k_farthest; });
}

/// Moves the model's camera and lights along with its coordinates.
void move(Model& model, const Geometry& geometry) {
    if (geometry.origin.empty()) return;
    if (model.camera) model.camera->position = model.camera->position - geometry.moved;
    for (Light& light : model.lights) light.position = light.position - geometry.moved;
    model.note(fmt::format("it lies around [{}] of the file's coordinates, which is the scene's origin",
                           geometry.origin));
}

bool is_physical(const Model& model) {
    return std::ranges::any_of(model.materials, [](const Material& material) {
        return material.reflection == "metallic-roughness" || material.reflection == "specular-glossiness";
    });
}

/// How much of the chosen lights a white surface of Phong's model reflects at most.
struct Reach {
    double direct, ambient;
};

/// The brightness of the chosen lights, such that the brightest surface facing them does not burn out.
double brightness_for(const Model& model, Reach reach) {
    double brightest = 0;
    for (const Material& material : model.materials) {
        // Bright spots of a picture are somewhat brighter than its mean.
        constexpr double k_spots = 1.3;
        const double image = material.color_map
                                 ? std::min(1.0, k_spots * model.images[material.color_map->image].brightness)
                                 : 1;
        double sum = 0;
        for (const auto& [name, value] : material.values) {
            const double factor = name == "kd" ? reach.direct : name == "ka" ? reach.ambient : 0;
            sum += factor * *std::ranges::max_element(value);
        }
        brightest = std::max(brightest, image * sum);
    }
    return brightest > 1 ? 1 / brightest : 1;
}

/// The lights of a model that has none.
std::vector<Light> chosen_lights(const Model& model, const Camera& camera, bool with_studio) {
    if (!with_studio) {
        // The key light with most of the fill light.
        const double brightness =
            is_physical(model) ? 0.55 : brightness_for(model, {.direct = 1.9, .ambient = 0.6});
        return lights_for(camera, brightness);
    }
    if (!is_physical(model))
        return studio_with_key_for(camera, brightness_for(model, {.direct = 1, .ambient = 0.3}));
    std::vector<Light> lights{studio_for(camera, 1)};
    if (std::ranges::find(model.materials, "unlit", &Material::reflection) != model.materials.end())
        lights.push_back({.name = "sky", .type = "ambient", .intensity = k_for_unlit});
    return lights;
}

/// The exposure of a file's own lights. glTF-Sample-Viewer shows a luminance of 1 cd/m² as 1, unless its user
/// moves a slider, and so does a scene without an exposure. Returns the factor by which luminances are
/// multiplied.
double expose(Model& model, const Bounds& bounds, Setting& setting) {
    const double factor = exposure_for(setting.lights, bounds);
    if (factor == 1) return 1;
    // As in exposure_factor(), in two decimals, and within the limits of the key.
    constexpr double k_limit = 24;
    const double value = std::round(100 * -std::log2(1.2 * factor)) / 100;
    setting.exposure = std::clamp(value, -k_limit, k_limit);
    const auto exposed = double{candela::exposure_factor(static_cast<float>(*setting.exposure))};
    model.note(
        fmt::format("'exposure' in [observer] suits its lights; the file has none, and "
                    "glTF-Sample-Viewer's default is {:.3f}, which shows 1 cd/m² as white",
                    candela::k_unexposed));
    if (value == *setting.exposure) return exposed;
    for (Light& light : setting.lights) light.intensity *= factor / exposed;
    model.note(fmt::format("its lights are {:.3g} times as bright as in the file", factor / exposed));
    return exposed;
}

/// Gives unlit materials their own brightness in the ambient light of the scene, as exposed.
void show_unlit(Model& model, const std::vector<Light>& lights, double exposed) {
    Vector ambient{};
    for (const Light& light : lights)
        for (std::size_t k = 0; k < 3 && light.type == "ambient"; ++k)
            ambient[k] +=
                light.intensity * double{candela::srgb_to_linear(static_cast<float>(light.color[k] / 255))};
    for (Material& material : model.materials) {
        if (material.reflection != "unlit") continue;
        std::vector<double> brightness;
        for (const double channel : ambient) brightness.push_back(1 / (exposed * channel));
        material.values = {{"ka", std::move(brightness)}};
    }
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
            fmt::format("'{}' has an unsupported format; expected .obj, .ply, .stl, .gltf or .glb",
                        request.file.string()));
    }
    std::error_code problem;
    if (!fs::exists(request.file, problem)) {
        throw candela::Error(candela::ErrorCategory::failure,
                             fmt::format("'{}' does not exist", request.file.string()));
    }
    // Files for 3D printers have z upwards.
    const bool is_stl = candela::extension_of(request.file) == "stl";
    const bool is_z_up = request.up == UpAxis::z || (request.up == UpAxis::by_format && is_stl);
    const Source source{.file = request.file, .allows_outside = request.allow_outside};
    const Geometry geometry = geometry_of(source, is_z_up, registry);
    Model model = model_of(source, request.with_animation, registry);
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
    if (!model.images.empty() && !geometry.has_uv) {
        model.note("its textures are left out; it has no texture coordinates");
        model.images.clear();
        for (Material& material : model.materials) {
            material.color_map.reset();
            std::erase_if(material.maps, [](const ParameterMap& map) { return map.attribute.empty(); });
        }
    }
    if (geometry.has_uv) measure_heights(model, source, geometry, registry);
    for (const Image& image : model.images)
        setting.images.push_back(image.content.empty()
                                     ? request.name_of_image(image.file)
                                     : request.write_image(image.file.string(), image.content));
    constexpr double k_aspect = 4.0 / 3;
    const Bounds& bounds = geometry.bounds;
    setting.camera = model.camera ? *model.camera : camera_for(bounds, k_aspect);
    Animator animator(model, geometry);
    animator.take_parts(source, registry);
    const bool is_still_seen = model.camera || animator.is_seen(setting.camera);
    if (!is_still_seen) setting.camera = camera_for(animator.bounds(), k_aspect);
    const Vector to_center = bounds.center() - setting.camera.position;
    const double least_ahead = std::max(0.1 * bounds.radius(), 1e-3 * length(setting.camera.position));
    const double ahead = std::max(dot(to_center, unit(setting.camera.towards)), least_ahead);
    show_backs_alone(model, geometry.mesh, -1 * unit(setting.camera.towards));
    setting.look_at = setting.camera.position + ahead * unit(setting.camera.towards);
    if (!model.camera) setting.look_at = is_still_seen ? bounds.center() : animator.bounds().center();
    setting.lights = model.lights;
    double exposed = 1;
    if (setting.lights.empty()) {
        setting.lights = chosen_lights(model, setting.camera, request.with_studio);
    } else {
        // Makes parts that the lights do not reach dark rather than black.
        constexpr double k_little = 0.08;
        exposed = expose(model, bounds, setting);
        if (separate(setting.lights, setting.camera, bounds))
            model.note(
                "lights at the position of another light or the camera are moved slightly along the line of "
                "sight");
        setting.lights.push_back({.name = "sky", .type = "ambient", .intensity = k_little / exposed});
    }
    show_unlit(model, setting.lights, exposed);
    animator.take_view(setting);
    animator.note();
    setting.room = room_for(animator.bounds(), setting.camera, setting.lights);
    return {.scene = scene_text(model, setting),
            .notes = model.notes,
            .objects = model.parts.size(),
            .lights = setting.lights.size(),
            .textures = model.images.size(),
            .triangles = geometry.file};
}

}  // namespace importing
