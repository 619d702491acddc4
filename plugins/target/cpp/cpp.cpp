// One C++17 file: a template, the kernels, and the scene as constants.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <regex>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "arguments.h"
#include "candela/embed.h"
#include "candela/target/building.h"
#include "candela/target/files.h"
#include "candela/target/kernels.h"
#include "candela/target/literals.h"
#include "candela/target/mirror.h"
#include "candela/target/text_template.h"
#include "candela/target/textures.h"
#include "candela/target_plugin.h"
#include "lights.h"
#include "objects.h"
#include "opacity.h"
#include "shadows.h"
#include "textures.h"
#include "vectors.h"

CANDELA_EMBED(candela_cpp_scene, CANDELA_SOURCE_DIR "/templates/scene.cpp");
CANDELA_EMBED(candela_cpp_cmake, CANDELA_SOURCE_DIR "/templates/CMakeLists.txt");
CANDELA_EMBED(candela_cpp_tables, CANDELA_SOURCE_DIR "/templates/tables.h");
CANDELA_EMBED(candela_cpp_readme, CANDELA_SOURCE_DIR "/templates/README.md");

namespace candela::cpp_target {

using namespace target;

namespace {

class CppWriter {
  public:
    explicit CppWriter(const ExportedScene& scene)
        : scene_(scene),
          lights_(lights_of(scene)),
          objects_(scene),
          textures_(textures_of(scene, objects_.textured_materials())),
          shadows_(shadow_texts(scene)) {}

    std::string run() {
        require_different_names(scene_);
        const std::string text = candela_cpp_scene;
        std::string glue = lights_.constants + lights_.loops + reflection() + shading() +
                           if_triangles(k_triangle_of) + textures_.declarations + textures_.seen +
                           objects_.shapes() + objects_.statements() + text;
        const Values opacity = opacity_texts(scene_, shadows_, objects_.textured_opacities());
        for (const Values& parts : {shadows_, opacity}) {
            for (const auto& [name, part] : parts) glue += part;
        }
        std::string kernels = model_kernels();
        const std::string library = vectors_for(kernels + textures_.declarations + textures_.seen);
        glue += tone_kernel_text() + toned_text();
        kernels = needed_parts(kernel_prelude(), kernels + glue) + "\n" + kernels;
        const bool has_tables = !scene_.tables.empty() || is_spoken_of("Table", without_comments(kernels));
        const std::string vectors = needed_parts(library, kernels + glue);
        const bool is_srgb = scene_.image.color_management == ColorEncoding::srgb;
        const ArgumentTexts arguments = arguments_of(scene_);
        const ExportedImage& image = scene_.image;
        const ExportedObserver& observer = scene_.observer;
        const bool is_perspective = observer.projection == Projection::perspective;
        Values values = {
            {"TITLE", ascii_identifier(scene_.title)},
            {"VERSION", CANDELA_PLUGIN_VERSION},
            {"VECTORS", vectors + (has_tables ? "\n" + std::string(candela_cpp_tables) : "")},
            {"CONSTRUCTORS", constructors(kernels)},
            {"KERNELS", kernels},
            {"DECODED_COMMENT",
             is_srgb
                 ? "// Colours are encoded as sRGB (IEC 61966-2-1); light is added up in linear intensities."
                 : "// Colours are used as intensities without conversion."},
            {"DECODED", is_srgb ? "c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f)" : "c"},
            {"ENCODED_COMMENT",
             is_srgb ? "// And back to sRGB." : "// Intensities are used without conversion."},
            {"ENCODED",
             is_srgb ? "x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f" : "x"},
            {"WIDTH", fmt::format("{}", image.width)},
            {"HEIGHT", fmt::format("{}", image.height)},
            {"EXPOSURE",
             is_exposed() ? fmt::format("const float k_exposure = {};  // intensities are multiplied by it\n",
                                        float_text(image.exposure))
                          : ""},
            // Shown as it is written, whatever the exposure.
            {"BACKGROUND_FACTOR", is_exposed() ? "1 / k_exposure * " : ""},
            {"TONE_KERNEL", tone_kernel_text()},
            {"INTENSITY", is_displayed_plainly() ? "p" : "intensity"},
            {"TONED", toned_text()},
            {"BACKGROUND", list(image.background.x, image.background.y, image.background.z)},
            {"SAMPLES", samples()},
            {"EYE", vec3_text(observer.position)},
            {"LOOK_AT", vec3_text(observer.look_at)},
            {"UP", vec3_text(observer.up)},
            {"IS_PERSPECTIVE", is_perspective ? "true" : "false"},
            {"VIEW_SIZE",
             is_perspective
                 ? fmt::format(
                       "const double k_field_of_view = {};  // degrees from top to bottom\n"
                       "const double k_pixels_per_unit = 0.5 * k_height / std::tan(0.5 * k_field_of_view * "
                       "0.017453292519943295);",
                       observer.fov)
                 : fmt::format("const double k_view_height = {};  // metres from top to bottom\n"
                               "const double k_pixels_per_unit = k_height / k_view_height;",
                               observer.height)},
            {"LIGHTS", lights_.constants},
            {"ENUMS", enums()},
            {"OBJECT_MEMBERS", members()},
            {"MATERIAL_STRUCT", if_textured(fmt::format("struct Material {{\n{}}};\n\n", materials()))},
            {"MATERIAL_BASE", if_textured(" : Material")},
            {"LIT_TYPE", lit_type()},
            {"LIT", if_textured("own", "o")},
            {"MAPPED_NORMAL", if_mapped(k_mapped_normal)},
            {"MAPPED", fmt::format("{}shading_normal(o, point{}){}", if_mapped("mapped_normal(o, "),
                                   if_triangles(", triangle"), if_mapped(", normal_texel, point)"))},
            {"TEXEL_PARAMETER", if_mapped(", vec3 normal_texel")},
            {"TEXEL_WITHIN", if_mapped(", is_normal_mapped(o) ? normal_texel(o, triangle, b) : vec3(0.0f)")},
            {"NO_TEXEL", if_mapped(", vec3(0.0f)")},
            {"EMISSION", has_emission(scene_) ? if_textured(" + own.emission", " + o.emission") : ""},
            {"OWN_PARAMETER", if_textured(", const Material& own")},
            {"OWN_WITHIN", if_textured(", material_within(o, triangle, b)")},
            {"OWN_AT_VERTEX", if_textured(", material_at_vertex(o, v)")},
            {"SHAPES", objects_.shapes()},
            {"OBJECTS", objects_.statements()},
            {"SHADING", shading()},
            {"REFLECTION", reflection()},
            {"LIGHT_FLAGS", lights_.flags},
            {"LIGHT_LOOPS", lights_.loops},
            {"TANGENT", tangent()},
            {"MESH_COLOR",
             if_colors("    std::vector<vec3> color;          // per vertex, multiplied by the object's, or "
                       "empty\n")},
            {"TEXTURES", textures_.declarations},
            {"MESH_CHANNELS", mesh_channels_of(scene_)},
            {"TEXTURE_SEEN", textures_.seen},
            {"TINT_PARAMETER", if_colors(", vec3 tint")},
            {"TIMES_TINT", if_colors(" * tint")},
            {"TINT_WITHIN", if_colors(", m.color.empty() ? vec3(1.0f) : blend(m.color, m, triangle, b)")},
            {"TINT_AT_VERTEX", if_colors(", o.mesh.color.empty() ? vec3(1.0f) : o.mesh.color[v]")},
            {"TRIANGLE_OF", if_triangles(k_triangle_of)},
            {"TRIANGLE_PARAMETER", if_triangles(", const Triangle& triangle")},
            {"THIS_TRIANGLE", if_triangles(", triangle_of(o, triangle)")},
            {"NO_TRIANGLE", if_triangles(", {}")},
            {"PICTURE_FILE", std::string(image_file_source())},
            {"USAGE", arguments.usage},
            {"HELP", arguments.help},
            {"MAIN", arguments.main},
            {"DATA", (has_tables ? table_numbers() : "") +
                         (objects_.data().empty() ? ""
                                                  : "\n// ---- 8. The triangles of shapes without a formula "
                                                    "----\n\nnamespace scene {\n" +
                                                        objects_.data() + "\n}  // namespace scene\n")}};
        values.insert(values.end(), shadows_.begin(), shadows_.end());
        values.insert(values.end(), opacity.begin(), opacity.end());
        return filled(text, views_of(values));
    }

  private:
    static constexpr const char* k_triangle_of =
        "Triangle triangle_of(const Object& o, int triangle) {\n"
        "    const int* const v = &o.mesh.corners[3 * static_cast<std::size_t>(triangle)];\n"
        "    const auto p = [&](int k) { return o.mesh.position[static_cast<std::size_t>(v[k])]; };\n"
        "    const auto n = [&](int k) { return o.vertex_normal[static_cast<std::size_t>(v[k])]; };\n"
        "    return {p(0), p(1), p(2), n(0), n(1), n(2)};\n"
        "}\n\n";
    static constexpr const char* k_mapped_normal =
        "// Where light is evaluated for each pixel.\n"
        "bool is_normal_mapped(const Object& o) { return o.normal_map.texture.levels != nullptr && "
        "rate_of(o) "
        "== Rate::pixel; }\n\n"
        "// The shading model's normal as the object's picture tilts it.\n"
        "vec3 mapped_normal(const Object& o, vec3 n, vec3 texel, const ShadingPoint& p) {\n"
        "    if (!is_normal_mapped(o)) return n;\n"
        "    const NormalMap& map = o.normal_map;\n"
        "    return map.has_slopes ? normal_from_slopes(texel, map.along_u, map.along_v, n, p.dpdu, p.dpdv) "
        ": "
        "normal_from_map(texel, map.along_u, map.along_v, n, p.dpdu, p.dpdv);\n"
        "}\n\n";
    bool is_exposed() const { return scene_.image.exposure != 1; }
    bool is_displayed_plainly() const { return !is_exposed() && scene_.image.tone == ToneCurve::none; }

    /// The function of a tone curve, with those that it calls; empty without one.
    std::string tone_kernel_text() const {
        if (scene_.image.tone == ToneCurve::none) return "";
        return needed_parts(tone_kernel(), toned_text()) + "\n";
    }

    /// The exposed and toned intensity `p` of a pixel; empty in a scene without exposure and tone.
    std::string toned_text() const {
        static constexpr std::array<const char*, 5> k_calls = {"", "tone_khronos_neutral", "tone_aces",
                                                               "tone_agx", "tone_reinhard"};
        if (is_displayed_plainly()) return "";
        const std::string exposed = is_exposed() ? "k_exposure * intensity" : "intensity";
        const char* const call = k_calls.at(static_cast<std::size_t>(scene_.image.tone));
        const bool has_tone = scene_.image.tone != ToneCurve::none;
        return has_tone ? fmt::format("        const vec3 p = {}(clamp({}, 0.0f, 1.0e12f));\n", call, exposed)
                        : fmt::format("        const vec3 p = {};\n", exposed);
    }

    /// Empty in a program in which no model reads its triangle.
    std::string if_triangles(const char* text) const {
        const bool sees =
            std::ranges::any_of(scene_.shadings, [](const auto& m) { return m.needs.triangle; });
        return sees ? text : "";
    }

    /// In a program in which pictures tilt normals.
    std::string if_mapped(const char* text) const { return has_normal_maps(scene_) ? text : ""; }

    /// In a program in which textures give numbers of materials.
    std::string if_textured(std::string text, const char* otherwise = "") const {
        return objects_.textured_materials().empty() ? otherwise : std::move(text);
    }
    /// The struct that has an object's reflection model and its material.
    std::string lit_type() const { return if_textured("Material", "Object"); }

    /// Colours at vertices; empty in a program without them.
    std::string if_colors(const char* text) const { return objects_.has_vertex_colors() ? text : ""; }

    static std::string radiance_functions() {
        return std::string(radiance_file_source()) +
               "\nstruct RadianceMap {\n    int first;  // of its texels\n    int size;\n    int "
               "last_level;\n"
               "    float density;\n};\n\n"
               "inline int radiance_size(RadianceMap m, int level) { return m.size >> level; }\n"
               "inline int radiance_last_level(RadianceMap m) { return m.last_level; }\n"
               "inline vec3 radiance_texel(RadianceMap m, int level, int x, int y) {\n"
               "    const int size = m.size >> level, at = m.first + (m.size * m.size - size * size) / 3 * 4 "
               "+ y "
               "* size + x;\n"
               "    const float* const texel = &radiance_texels()[3 * static_cast<std::size_t>(at)];\n"
               "    return vec3(texel[0], texel[1], texel[2]);\n}\n\n" +
               mirror_kernel() + "\n";
    }

    std::string model_kernels() const {
        std::string text;
        std::set<std::string> done;
        const auto add = [&](const ExportedModel& model) {
            if (!done.insert(model.id).second) return;
            text += model.plugin->kernel.text;
            if (text.back() != '\n') text += '\n';
            text += '\n';
        };
        if (has_mirror_images(scene_)) text += radiance_functions();
        for (const ExportedModel& model : models_of(scene_)) add(model);
        for (const ExportedModel& model : objects_.shape_models()) add(model);
        return text;
    }

    /// Kernels make structs as GLSL does, Reflected(a, b).
    static std::string constructors(const std::string& kernels) {
        static const std::regex k_struct(R"(struct\s+(\w+)\s*\{)");
        std::string text;
        for (auto m = std::sregex_iterator(kernels.begin(), kernels.end(), k_struct);
             m != std::sregex_iterator(); ++m) {
            const std::string name = (*m)[1];
            if (!std::regex_search(kernels, std::regex("\\b" + name + "\\s*\\("))) continue;
            text += fmt::format("#define {0}(...) {0}{{__VA_ARGS__}}\n", name);
        }
        return text.empty() ? "" : "// GLSL makes a struct by a call, C++17 by braces.\n" + text;
    }

    static bool is_spoken_of(const char* word, const std::string& code) {
        return std::regex_search(code, std::regex(fmt::format("\\b{}\\b", word)));
    }

    /// The declarations at the top of the program.
    std::string table_numbers() const {
        const float none[] = {0};
        const std::span<const float> numbers = scene_.tables.empty() ? std::span(none) : scene_.tables;
        std::string text;
        std::string line = "   ";
        for (const float x : numbers) {
            const std::string next = " " + float_text(x) + ",";
            if (line.size() + next.size() > 120) {
                text += line + "\n";
                line = "   ";
            }
            line += next;
        }
        return "\n// ---- The numbers of the models' tables, one table after the other ----\n\nnamespace "
               "scene {\n\n"
               "const float k_table_numbers[] = {\n" +
               text + line + "\n};\n\n}  // namespace scene\n";
    }

    std::string samples() const {
        std::vector<std::string> positions;
        for (const ExportedSample& s : scene_.image.samples)
            positions.push_back(fmt::format("vec2({}, {})", float_text(s.x), float_text(s.y)));
        return fmt::format("{}", fmt::join(positions, ", "));
    }

    static std::string enum_text(const char* type, const std::vector<std::string>& names) {
        return names.size() < 2 ? "" : fmt::format("enum class {} {{ {} }};\n", type, fmt::join(names, ", "));
    }
    std::string enums() const {
        const std::string text = enum_text("Shading", shading_enumerators(scene_)) +
                                 enum_text("Reflection", reflection_enumerators(scene_));
        return text.empty() ? "" : text + "\n";
    }

    std::string members() const {
        std::string text;
        if (scene_.shadings.size() > 1) text += "    Shading shading{};\n";
        if (objects_.textured_materials().empty())
            text += materials();
        else
            text +=
                "    int textured = -1;  // the number of its material in material_at(), if that has "
                "textures\n";
        if (has_normal_maps(scene_)) text += "    NormalMap normal_map;\n";
        for (const auto& model : scene_.shadings) text += member(model, shading_member(model));
        return text;
    }
    std::string materials() const {
        std::string text = "    vec3 color;\n";
        if (scene_.reflections.size() > 1) text += "    Reflection reflection{};\n";
        for (const auto& model : scene_.reflections) text += member(model, material_member(model));
        if (has_emission(scene_))
            text += "    vec3 emission = vec3(0.0f);  // added to the light that it reflects\n";
        if (has_occlusion(scene_))
            text += "    float occlusion = 1.0f;  // of ambient light: a factor of what it reflects of it\n";
        return text;
    }
    static std::string member(const ExportedModel& model, const std::string& name) {
        return has_parameters(model) ? fmt::format("    {} {}{{}};\n", constants_type(model), name) : "";
    }

    /// The body of a function that calls one of several models, one line each.
    template <class Model, class Line>
    static std::string choice(const char* type, const char* member, std::span<const Model> models,
                              const std::vector<std::string>& names, Line line) {
        if (models.empty()) return "    return {};\n";
        if (models.size() == 1) return fmt::format("    return {};\n", line(models.front()));
        std::string text;
        for (std::size_t i = 0; i + 1 < models.size(); ++i) {
            text +=
                fmt::format("    if (o.{} == {}::{}) return {};\n", member, type, names[i], line(models[i]));
        }
        return text + fmt::format("    return {};\n", line(models.back()));
    }
    template <class Line>
    std::string reflection_choice(Line line) const {
        return choice("Reflection", "reflection", scene_.reflections, reflection_enumerators(scene_), line);
    }
    template <class Line>
    std::string shading_choice(Line line) const {
        return choice("Shading", "shading", scene_.shadings, shading_enumerators(scene_), line);
    }

    /// "const Object& o" if the text uses `o`.
    static std::string parameter(const char* type, const char* name, const std::string& body) {
        const bool is_used = std::regex_search(body, std::regex(fmt::format("\\b{}\\b", name)));
        return is_used ? fmt::format("{} {}", type, name) : type;
    }
    static std::string function(const char* result, const char* name,
                                const std::vector<std::pair<const char*, const char*>>& parameters,
                                const std::string& body) {
        std::vector<std::string> all;
        for (const auto& [type, parameter_name] : parameters)
            all.push_back(parameter(type, parameter_name, body));
        return fmt::format("{} {}({}) {{\n{}}}\n", result, name, fmt::join(all, ", "), body);
    }

    std::string reflection() const {
        const auto call_of = [](const char* suffix, const char* arguments) {
            return [=](const ExportedReflection& m) {
                return call(m, suffix, "o." + material_member(m), arguments);
            };
        };
        const std::string object = "const " + lit_type() + "&";
        return "// The light that an object reflects of light from one direction, and of light from "
               "everywhere.\n" +
               function("Reflected", "reflected",
                        {{object.c_str(), "o"}, {"const Surface&", "s"}, {"vec3", "to_light"}},
                        reflection_choice(call_of("reflect", "s, to_light"))) +
               function("vec3", "reflected_ambient", {{object.c_str(), "o"}, {"const Surface&", "s"}},
                        reflection_choice(call_of("reflect_ambient", "s"))) +
               (has_mirror_images(scene_)
                    ? "// The width of a highlight; 0 for a model that does not say it.\n" +
                          function("float", "highlight_width", {{object.c_str(), "o"}},
                                   reflection_choice([&](const ExportedReflection& m) {
                                       return m.is_glossy ? fmt::format("clamp({}, 1e-4f, 1.0f)",
                                                                        call_of("highlight_width", "")(m))
                                                          : std::string("0.0f");
                                   }))
                    : "");
    }

    std::string shading() const {
        std::vector<std::pair<const char*, const char*>> of_normal = {{"const Object&", "o"},
                                                                      {"const ShadingPoint&", "p"}};
        if (!if_triangles("t").empty()) of_normal.emplace_back("const Triangle&", "t");
        constexpr const char* k_rates[] = {"Rate::face", "Rate::vertex", "Rate::pixel"};
        return "// Where an object is lit, its normal there, and a face's weight in the normal of its "
               "corner.\n" +
               function("Rate", "rate_of", {{"const Object&", "o"}},
                        shading_choice([&](const ExportedShading& m) {
                            return std::string(k_rates[static_cast<int>(m.rate)]);
                        })) +
               function("vec3", "shading_normal", of_normal, shading_choice([](const ExportedShading& m) {
                            return call(m, "normal", "o." + shading_member(m),
                                        m.needs.triangle ? "p, t" : "p");
                        })) +
               function("float", "corner_weight", {{"const Object&", "o"}, {"const FaceCorner&", "c"}},
                        shading_choice([](const ExportedShading& m) {
                            return !has_function(m, "corner_weight")
                                       ? std::string("1.0f")
                                       : call(m, "corner_weight", "o." + shading_member(m), "c");
                        }));
    }

    /// Fills the members of a surface's point that only some models read.
    std::string tangent() const {
        const auto line = [&](bool SurfaceNeeds::* needs, const char* text) {
            const auto reads = [&](const ExportedReflection& model) { return model.needs.*needs; };
            return std::ranges::any_of(scene_.reflections, reads) ? text : "";
        };
        return std::string(line(&SurfaceNeeds::tangent,
                                "    s.tangent = normalize(point.dpdu - s.normal * dot(s.normal, "
                                "point.dpdu));\n")) +
               line(&SurfaceNeeds::position, "    s.position = place;\n") +
               line(&SurfaceNeeds::uv, "    s.uv = point.uv;\n");
    }

    const ExportedScene& scene_;
    LightTexts lights_;
    CppObjects objects_;
    TextureTexts textures_;
    Values shadows_;
};

class CppTarget final : public Target {
  public:
    explicit CppTarget(const sdk::NoParams&) {}

    TargetAbilities abilities() const noexcept override {
        return {.triangle = true,
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
    void write(const ExportedScene& scene, FileSink& files) const override {
        target::write(files, main_file(), CppWriter(scene).run());
        write_textures(scene, files);
        write_radiance(scene, files);
        target::write(files, "CMakeLists.txt", candela_cpp_cmake);
        target::write(
            files, "README.md",
            filled(candela_cpp_readme, {{"TITLE", ascii_identifier(scene.title)},
                                        {"VERSION", CANDELA_PLUGIN_VERSION},
                                        {"TEXTURES", scene.textures.empty() ? "" : readme_of_textures()}}));
    }
    const char* main_file() const noexcept override { return "scene.cpp"; }
    bool can_draw() const noexcept override { return true; }

    void build(const char* directory, ProgramRunner& programs) const override {
        build_with_cmake(programs, directory, CANDELA_PLUGIN_NAME);
    }
    void draw(const char* directory, const char* picture, ProgramRunner& programs) const override {
        run(programs, {program_in(directory), picture}, "the " CANDELA_PLUGIN_NAME " program does not run");
    }
    int show(const char* directory, ProgramRunner& programs) const override {
        return target::show(programs, {program_in(directory), std::string(directory) + "/scene.png"});
    }

  private:
    static std::string program_in(const char* directory) { return std::string(directory) + "/build/scene"; }
};

}  // namespace

}  // namespace candela::cpp_target

using candela::cpp_target::CppTarget;

CANDELA_PLUGIN(target, CppTarget, candela::sdk::k_no_fields,
               {.title = "C++",
                .summary = "one C++17 file without dependencies: a small software renderer to read"})
