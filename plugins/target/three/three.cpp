// One page with three.js: a template, the library, the scene as JSON, and the script that reads it.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>

#include "candela/embed.h"
#include "candela/plugin_files.h"
#include "candela/target/base64.h"
#include "candela/target/files.h"
#include "candela/target/literals.h"
#include "candela/target/page_arrays.h"
#include "candela/target/page_image.h"
#include "candela/target/text_template.h"
#include "candela/target_plugin.h"
#include "scene_json.h"

CANDELA_EMBED(candela_three_page, CANDELA_SOURCE_DIR "/templates/page.html");
CANDELA_EMBED(candela_three_style, CANDELA_SOURCE_DIR "/templates/page.css");
CANDELA_EMBED(candela_three_script, CANDELA_THREE_SCRIPT);

namespace candela::three_target {

namespace fs = std::filesystem;

namespace {

/// A file of three.js, in the plugin's folder.
std::string read_library(const fs::path& folder, const char* file) {
    std::ifstream stream(folder / file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (stream.bad() || text.empty())
        throw std::runtime_error(
            fmt::format("three.js is missing, which the pages contain; fetch it with npm pack three@{}, and "
                        "put its files LICENSE and build/three.module.min.js into the folder '{}'",
                        CANDELA_THREE_VERSION, folder.string()));
    return text;
}

class ThreeTarget final : public Target {
  public:
    explicit ThreeTarget(const sdk::NoParams&) : library_(sdk::data_folder()) {}

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
                .shadows = true,
                .display = true};
    }
    const char* main_file() const noexcept override { return "scene.html"; }
    bool can_draw() const noexcept override { return true; }

    void write(const ExportedScene& scene, FileSink& files) const override {
        target::PageArrays arrays;
        // Invalid UTF-8 is replaced.
        const std::string json =
            scene_json(scene, arrays).dump(-1, ' ', false, Json::error_handler_t::replace);
        const std::string three = read_library(library_, "build/three.module.min.js");
        target::write(files, main_file(),
                      target::filled(candela_three_page,
                                     {{"VERSION", CANDELA_PLUGIN_VERSION},
                                      {"TITLE", target::html_text(scene.title)},
                                      {"STYLE", candela_three_style},
                                      {"THREE_VERSION", CANDELA_THREE_VERSION},
                                      {"LICENSE", target::html_text(read_library(library_, "LICENSE"))},
                                      {"THREE", target::base64(std::as_bytes(std::span(three)))},
                                      {"SCENE", target::script_json(json)},
                                      {"ARRAYS", arrays.html()},
                                      {"SCRIPT", candela_three_script}}));
    }

    void draw(const char* directory, const char* image, ProgramRunner& programs) const override {
        target::draw_page(fs::path(directory) / main_file(), image, programs);
    }

  private:
    fs::path library_;
};

}  // namespace

}  // namespace candela::three_target

using candela::three_target::ThreeTarget;

CANDELA_PLUGIN(
    target, ThreeTarget, candela::sdk::k_no_fields,
    {.title = "three.js",
     .summary = "one HTML page with three.js, with its own materials where their formulas are the same",
     .reference = "three.js authors (2024), three.js r170"})
