// candela import: makes a scene of a model's file.
#include "import/import.h"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <system_error>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/outputs.h"
#include "console/reporting.h"
#include "files/output_folder.h"
#include "import/model_parts.h"

import candela.util;

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

importing::UpAxis up_from(const CommandLine& line) {
    if (!line.has("up")) return importing::UpAxis::by_format;
    const auto up = line.get<std::string>("up");
    if (up == "y") return importing::UpAxis::y;
    if (up == "z") return importing::UpAxis::z;
    throw Error(ErrorCategory::bad_request, fmt::format("--up is '{}'; expected y or z", up));
}

/// The name of a file in a scene in `folder`: relative to it if both are below one root.
std::string name_in(const fs::path& folder, const fs::path& file) {
    const fs::path relative = candela::canonical_path(fs::absolute(file))
                                  .lexically_relative(candela::canonical_path(fs::absolute(folder)));
    return relative.empty() ? fs::absolute(file).string() : relative.generic_string();
}

/// Throws if the output would overwrite the model or one of its parts.
void require_no_part_of(const fs::path& model, const fs::path& output) {
    require_no_scene_file(output.string(), {model}, "the scene");
    std::error_code problem;
    if (fs::exists(output, problem) && importing::is_part_of(model, output))
        throw Error(ErrorCategory::bad_request,
                    fmt::format("'{}' is part of the model '{}'; give the scene another name",
                                output.string(), model.string()));
}

/// Existing pictures may be the user's own, unless their contents are the same.
void require_place_for(const std::map<std::string, std::string>& images, const fs::path& folder,
                       const fs::path& model, bool is_forced) {
    for (const auto& [name, content] : images) {
        const fs::path file = folder / name;
        require_no_part_of(model, file);
        std::error_code problem;
        if (!is_forced && fs::exists(fs::symlink_status(file, problem)) &&
            candela::read_text_file(file, content.size()) != content)
            throw Error(ErrorCategory::failure,
                        fmt::format("'{}' already exists; --force replaces it", file.string()));
    }
}

}  // namespace

int run_import(const std::vector<std::string>& arguments) {
    CommandLine line("candela import FILE [options]",
                     "Write a scene that shows a model from another program: an OBJ file with its materials, "
                     "a glTF or GLB file with materials, cameras and lights, a PLY or an STL file. The scene "
                     "refers to the model's file. Anything the model lacks, such as a light, is chosen so "
                     "that all of the model is visible. Everything left out or approximated is reported.");
    line.positional("file", 1);
    line.options()("output,o", po::value<std::string>()->value_name("FILE"),
                   "the scene; default: the model's name with .toml; - prints it")(
        "force", "replace an existing scene, and its pictures")(
        "up", po::value<std::string>()->value_name("AXIS"),
        "the axis that points up in the file: y or z; default: z in STL files, "
        "y in others")("allow-outside",
                       "let the model name files outside its own folder, such as ../textures/wood.png")(
        "plain", "light a model by a key light, a fill light and ambient light, without the studio");
    add_plugin_options(line);
    if (!line.parse(arguments)) return 0;
    if (!line.has("file")) throw Error(ErrorCategory::bad_request, "candela import needs a model's file");

    const fs::path file = line.all("file").front();
    const std::string output =
        line.has("output") ? line.get<std::string>("output") : file.stem().string() + ".toml";
    require_no_default_link(line, "output", output);
    const bool is_printed = output == "-";
    const bool is_forced = line.has("force");
    std::error_code problem;
    if (!is_printed && !is_forced && fs::exists(fs::symlink_status(output, problem)))
        throw Error(ErrorCategory::failure, fmt::format("'{}' already exists; --force replaces it", output));
    const fs::path parent = fs::path(output).parent_path();
    const fs::path folder = is_printed || parent.empty() ? fs::path(".") : parent;
    if (!is_printed) {
        require_free(output, candela::Existing::replaced);
        require_no_part_of(file, output);
    }

    // Pictures embedded in the file are written next to the scene.
    const std::string images_folder = fs::path(output).stem().string() + "_textures";
    std::map<std::string, std::string> images;
    candela::Registry registry = registry_from(line);
    const importing::Imported imported = importing::import_model(
        {.file = file,
         .up = up_from(line),
         .allow_outside = line.has("allow-outside"),
         .with_studio = !line.has("plain"),
         .shown_file = name_in(folder, file),
         .write_image =
             [&](const std::string& name, const std::string& content) {
                 if (is_printed)
                     throw Error(
                         ErrorCategory::bad_request,
                         fmt::format("'{}' contains pictures, which are written next to the scene; name the "
                                     "scene with -o",
                                     file.string()));
                 images.emplace(name, content);
                 return images_folder + "/" + name;
             },
         .name_of_image = [&](const fs::path& image) { return name_in(folder, image); }},
        registry);
    for (const std::string& note : imported.notes) warn(note);
    if (is_printed) {
        std::cout << imported.scene;
        return 0;
    }
    if (!images.empty()) {
        require_place_for(images, folder / images_folder, file, is_forced);
        OutputFolder output_folder(folder / images_folder, candela::Links::not_followed);
        for (const auto& [name, content] : images) output_folder.write(name, content);
        output_folder.finish();
    }
    candela::write_text_file(output, imported.scene,
                             is_forced ? candela::Existing::replaced : candela::Existing::kept);
    say_afterwards([&] {
        const auto counted = [](std::size_t count, const char* what) {
            return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
        };
        return fmt::format("Wrote {}: {}, {}, {}. Next: candela render {}\n", output,
                           counted(imported.objects, "object"), counted(imported.lights, "light"),
                           counted(imported.textures, "texture"), output);
    });
    return 0;
}
