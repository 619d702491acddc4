// A POV-Ray scene with POV-Ray's own models of light and reflection, filled into a template.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <string>

#include "candela/color.h"
#include "candela/embed.h"
#include "candela/target/building.h"
#include "candela/target/files.h"
#include "candela/target/literals.h"
#include "candela/target/mean_materials.h"
#include "candela/target/mirror.h"
#include "candela/target/renderers.h"
#include "candela/target/text_template.h"
#include "candela/target_plugin.h"
#include "lights.h"
#include "meshes.h"
#include "opacity.h"
#include "pigment.h"
#include "shadows.h"
#include "text.h"

CANDELA_EMBED(candela_povray_scene, CANDELA_SOURCE_DIR "/templates/scene.pov");
CANDELA_EMBED(candela_povray_options, CANDELA_SOURCE_DIR "/templates/scene.ini");

namespace candela::povray_target {

namespace fs = std::filesystem;

namespace {

std::string camera_text(const ExportedScene& scene) {
    const ExportedObserver& observer = scene.observer;
    const target::ViewAxes axes = target::axes_of(observer);
    const auto scaled = [](const target::Vector& v, double by) {
        return vector_text(target::Vector{by * v[0], by * v[1], by * v[2]});
    };
    const double aspect = static_cast<double>(scene.image.width) / scene.image.height;
    const bool is_perspective = observer.projection == Projection::perspective;
    const double height =
        is_perspective ? 2 * std::tan(observer.fov * std::numbers::pi / 360) : double{observer.height};
    return fmt::format("    {}\n    location {}\n    direction {}\n    right {}\n    up {}",
                       is_perspective ? "perspective" : "orthographic", vector_text(observer.position),
                       scaled(axes.backward, -1), scaled(axes.right, aspect * height),
                       scaled(axes.up, height));
}

std::string scene_text(const ExportedScene& scene, FileSink& files) {
    const auto color = decoded(scene.image.background, scene.image.color_management);
    target::approximate_mirror_images(scene, files);
    if (scene.has_shadows) approximate_shadows(scene, files);
    std::string meshes;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) meshes += mesh_text(scene, i, files);
    return target::filled(candela_povray_scene, {{"TITLE", target::ascii_identifier(scene.title)},
                                                 {"VERSION", CANDELA_PLUGIN_VERSION},
                                                 {"GAMMA", gamma_text(scene)},
                                                 {"AMBIENT", rgb_text(ambient_of(scene))},
                                                 {"TRACE_LEVEL", trace_level_text(scene)},
                                                 {"BACKGROUND", rgb_text({color.r, color.g, color.b})},
                                                 {"CAMERA", camera_text(scene)},
                                                 {"LIGHTS", lights_text(scene, files)},
                                                 {"MESHES", meshes}});
}

std::string options_text(const ExportedImage& image) {
    const auto depth = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(image.samples.size()))));
    return target::filled(
        candela_povray_options,
        {{"WIDTH", fmt::format("{}", image.width)},
         {"HEIGHT", fmt::format("{}", image.height)},
         {"ANTIALIASING",
          depth < 2
              ? "Antialias=off"
              : fmt::format("Antialias=on\nSampling_Method=1\nAntialias_Threshold=0\nAntialias_Depth={}",
                            depth)}});
}

/// A folder in which POV-Ray may read and write as Debian configures it, wherever the scene is.
fs::path permitted_folder() {
    const fs::path folder = "/tmp";
    return fs::is_directory(folder) ? folder : fs::temp_directory_path();
}

class PovRayTarget final : public Target {
  public:
    explicit PovRayTarget(const sdk::NoParams&) {}

    TargetAbilities abilities() const noexcept override {
        return {.models_without_kernel = true,
                .triangle = true,
                .vertex_colors = true,
                .textures = true,
                .textured_numbers = true,
                .vertex_channels = true,
                .normal_maps = true,
                .emission = true,
                .occlusion = true,
                .opacity = true,
                .shadows = true,
                .display = true};
    }
    const char* main_file() const noexcept override { return "scene.pov"; }
    bool can_draw() const noexcept override { return true; }

    void write(const ExportedScene& scene, FileSink& files) const override {
        if (scene.image.tone != ToneCurve::none)
            throw std::runtime_error(
                "[image] tone: POV-Ray shows intensities as they are, without a tone curve; --tone none "
                "leaves it out");
        const target::MeanMaterials means(scene, files);
        for (const ExportedObject& object : scene.objects) {
            if (object.normal_map == nullptr) continue;
            const char* const what = object.normal_map->has_slopes ? "bump map" : "normal map";
            files.approximate(fmt::format("the {} of object {} is left out", what, object.label).c_str());
        }
        target::write(files, main_file(), scene_text(means.scene(), files));
        target::write(files, "scene.ini", options_text(scene.image));
    }

    void draw(const char* directory, const char* picture, ProgramRunner& programs) const override {
        if (!programs.has("povray"))
            throw std::runtime_error(
                "'povray', which draws the scene, is not installed; on Debian, run apt-get install povray");
        const fs::path from = directory;
        const target::TemporaryFolder folder("candela-povray", permitted_folder());
        for (const fs::directory_entry& file : fs::directory_iterator(from)) {
            const fs::path name = file.path().filename();
            if (name == main_file() || name == "scene.ini" || name.extension() == ".ppm")
                fs::copy_file(file.path(), folder.path() / name);
        }
        const std::string at = folder.path().string();
        target::run(
            programs,
            {"povray", at + "/scene.ini", "+I" + at + "/scene.pov", "+L" + at, "+O" + at + "/picture.png"},
            "POV-Ray failed to draw the scene");
        std::ifstream drawn(folder.path() / "picture.png", std::ios::binary);
        target::write_whole(picture, std::string(std::istreambuf_iterator<char>(drawn), {}));
    }

    int show(const char* directory, ProgramRunner& programs) const override {
        draw(directory, (std::string(directory) + "/scene.png").c_str(), programs);
        return 0;
    }
};

constexpr Property k_properties[] = {{"exact-light", "ambient, directional, distributed, point, spot"},
                                     {"exact-reflection", "lambert, phong, blinn-phong, unlit"},
                                     {"exact-shading", "phong, angle-weighted, area-weighted, max-weighted"}};

}  // namespace

}  // namespace candela::povray_target

using candela::povray_target::PovRayTarget;

CANDELA_PLUGIN(target, PovRayTarget, candela::sdk::k_no_fields,
               {.title = "POV-Ray",
                .summary = "a POV-Ray 3.7 scene with POV-Ray's own models where they are equivalent",
                .reference = "Persistence of Vision Pty. Ltd. (2013), POV-Ray 3.7 reference",
                .properties = candela::povray_target::k_properties})
