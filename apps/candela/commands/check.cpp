// candela check: reports a scene's errors, or a summary of it.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/scene_compilation.h"
#include "console/diagnostics_text.h"
#include "console/exit_code.h"
#include "console/reporting.h"
#include "console/terminal.h"
#include "film/frame_pattern.h"
#include "json/json.h"

import candela.render;
import candela.util;

using candela::Diagnostics;
using candela::RenderScene;
using candela::Scene;

namespace {

std::string count(std::size_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

/// "2 point, 1 ambient"
std::string tally(const std::vector<std::string>& names) {
    std::map<std::string, std::size_t> times;
    for (const std::string& name : names) ++times[name];
    std::string result;
    for (const auto& [name, n] : times) result += fmt::format("{}{} {}", result.empty() ? "" : ", ", n, name);
    return result;
}

template <class Items, class NameOf>
std::vector<std::string> names_of(const Items& items, NameOf name_of) {
    std::vector<std::string> names;
    std::ranges::transform(items, std::back_inserter(names), name_of);
    return names;
}

std::string in_parentheses(const std::string& text) { return text.empty() ? "" : " (" + text + ")"; }

std::size_t triangles_of(const RenderScene& compiled) {
    std::size_t all = 0;
    for (const candela::RenderObject& object : compiled.objects) all += object.mesh.triangle_count();
    return all;
}

/// A line if the scene is animated; otherwise empty.
std::string animation_text(const Scene& scene) {
    if (!scene.animation) return "";
    const candela::Animation& animation = *scene.animation;
    std::string moved = animation.orbit ? "the observer's orbit" : "";
    for (const candela::Track& track : animation.tracks)
        moved += (moved.empty() ? "" : ", ") + candela::printable(track.path);
    return fmt::format("  film      {}, {} per second, {:.3g} s{}\n",
                       count(static_cast<std::size_t>(animation.frames), "frame"), animation.fps,
                       animation.frames / animation.fps, in_parentheses(moved));
}

Json animation_json(const candela::Animation& animation) {
    Json tracks = Json::array();
    for (const candela::Track& track : animation.tracks) tracks.push_back(track.path);
    return {{"frames", animation.frames},
            {"fps", animation.fps},
            {"orbit", animation.orbit.has_value()},
            {"tracks", std::move(tracks)}};
}

void print_summary(const Scene& scene, const RenderScene& compiled) {
    const candela::Room& room = scene.room;
    const auto type_of = [](const candela::LightSource& l) {
        return candela::shown_model_name(l.model.name);
    };
    std::cout << "The scene is valid.\n"
              << fmt::format("  room      {} m wide, {} m high, {} m deep\n", room.width, room.height,
                             room.depth)
              << fmt::format("  picture   {} x {} pixels, {} per pixel\n", scene.image.width,
                             scene.image.height,
                             count(static_cast<std::size_t>(scene.image.samples), "sample"))
              << animation_text(scene)
              << fmt::format("  lights    {}{}\n", scene.lights.size(),
                             in_parentheses(tally(names_of(scene.lights, type_of))))
              << fmt::format("  objects   {}, {}\n", scene.objects.size(),
                             count(triangles_of(compiled), "triangle"));
    constexpr std::size_t k_most_lines = 50;
    for (std::size_t i = 0; i < std::min(scene.objects.size(), k_most_lines); ++i) {
        const candela::Object& object = scene.objects[i];
        std::cout << fmt::format("    {:<12} {}, {}, {} shading, {} reflection\n",
                                 candela::printable(object.label.text()), object.shape.name,
                                 count(compiled.objects[i].mesh.triangle_count(), "triangle"),
                                 candela::shown_model_name(object.shading.name),
                                 candela::shown_model_name(object.reflection.name));
    }
    if (scene.objects.size() > k_most_lines) {
        const auto rest = std::vector(scene.objects.begin() + k_most_lines, scene.objects.end());
        std::cout << fmt::format(
            "    and {} more{}\n", rest.size(),
            in_parentheses(tally(names_of(rest, [](const auto& o) { return o.shape.name; }))));
    }
}

void print_json(const std::optional<RenderScene>& compiled, const Scene* scene,
                const Diagnostics& diagnostics) {
    Json result = {{"valid", compiled.has_value()},
                   {"diagnostics", parse_json(diagnostics_json(diagnostics))}};
    if (compiled) {
        Json objects = Json::array();
        for (std::size_t i = 0; i < scene->objects.size(); ++i) {
            const candela::Object& object = scene->objects[i];
            objects.push_back(
                {{"label", object.label.text()},
                 {"type", object.shape.name},
                 {"triangles", compiled->objects[i].mesh.triangle_count()},
                 {"closed", compiled->objects[i].mesh.closed && compiled->objects[i].mesh.open_edges == 0},
                 {"shading", object.shading.name},
                 {"reflection", object.reflection.name}});
        }
        Json lights = Json::array();
        for (const candela::LightSource& light : scene->lights)
            lights.push_back({{"label", light.label.text()}, {"type", light.model.name}});
        result["scene"] = {{"width", scene->image.width},
                           {"height", scene->image.height},
                           {"samples", scene->image.samples},
                           {"lights", std::move(lights)},
                           {"objects", std::move(objects)}};
        if (scene->animation) result["scene"]["animation"] = animation_json(*scene->animation);
    }
    std::cout << json_text(result, 2) << '\n';
}

}  // namespace

int run_check(const std::vector<std::string>& arguments) {
    CommandLine line("candela check SCENE... [options]",
                     "Read a scene from one or more files, and report all its errors, or a summary of it.");
    add_scene_options(line);
    add_frame_option(line);
    line.options()("json", "print the diagnostics and the summary as JSON")(
        "print", "print the scene as one file, with includes, --set and all defaults filled in");
    if (!line.parse(arguments)) return 0;
    if (line.has("json") && line.has("print"))
        throw candela::Error(candela::ErrorCategory::bad_request,
                             "--json and --print both use standard output; choose one");
    if (!line.has("scene"))
        throw candela::Error(candela::ErrorCategory::bad_request, "candela check needs a scene file");

    candela::Registry registry = registry_from(line);
    Diagnostics diagnostics;
    candela::SceneRequest request = scene_request_from(line, registry);
    // The report is the same everywhere, and a check never waits: where `render` would ask, it reports what
    // is missing.
    // missing.
    request.ask = nullptr;
    auto frames = candela::SceneFrames::read(request, registry, diagnostics);
    std::optional<candela::SceneDraft> draft;
    std::optional<RenderScene> compiled;
    if (frames && frames->animation()) {
        // Errors of this frame are found with those of all others.
        Diagnostics ignored;
        draft = frames->draft(request.frame, ignored);
        check_all_frames(*frames, frames_from(std::nullopt, 1, frames->count()), registry, diagnostics);
        if (!diagnostics.has_errors()) compiled = compile_scene(*draft, registry, ignored);
    } else if (frames) {
        draft = frames->draft(request.frame, diagnostics);
        compiled = compile_scene(*draft, registry, diagnostics);
    }
    if (line.has("json")) {
        print_json(compiled, draft ? &draft->scene : nullptr, diagnostics);
    } else {
        report(diagnostics);
        if (compiled && line.has("print")) {
            std::cout << candela::scene_text(draft->scene);
        } else if (compiled && !is_quiet()) {
            print_summary(draft->scene, *compiled);
        }
    }
    return static_cast<int>(exit_code_of(diagnostics));
}
