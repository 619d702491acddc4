// C++ with OpenGL: a template, the shaders as text, and the scene as uniform variables and arrays.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "candela/color.h"
#include "candela/embed.h"
#include "candela/target/arrays.h"
#include "candela/target/building.h"
#include "candela/target/files.h"
#include "candela/target/glsl.h"
#include "candela/target/literals.h"
#include "candela/target/mirror.h"
#include "candela/target/text_template.h"
#include "candela/target/textures.h"
#include "candela/target_plugin.h"
#include "layers.h"
#include "literals.h"
#include "shadows.h"
#include "textures.h"

CANDELA_EMBED(candela_opengl_scene, CANDELA_SOURCE_DIR "/templates/scene.cpp");
CANDELA_EMBED(candela_opengl_tables, CANDELA_SOURCE_DIR "/templates/tables.cpp");
CANDELA_EMBED(candela_opengl_meshes, CANDELA_SOURCE_DIR "/templates/meshes.h");
CANDELA_EMBED(candela_opengl_cmake, CANDELA_SOURCE_DIR "/templates/CMakeLists.txt");
CANDELA_EMBED(candela_opengl_readme, CANDELA_SOURCE_DIR "/templates/README.md");

namespace candela::opengl_target {

using namespace target;

namespace {

std::string braces(Vec3 v) {
    return fmt::format("{{{}, {}, {}}}", float_text(v.x), float_text(v.y), float_text(v.z));
}
std::string braces(Rgb c) { return braces(Vec3{c.r, c.g, c.b}); }

class OpenGlWriter {
  public:
    explicit OpenGlWriter(const ExportedScene& scene)
        : scene_(scene), encoding_(scene.image.color_management) {}

    void run(FileSink& files) {
        std::string objects;
        for (std::size_t i = 0; i < scene_.objects.size(); ++i) objects += object_text(i);
        const GlslParts glsl = glsl_of(scene_);
        const ExportedImage& image = scene_.image;
        const Values about = {{"TITLE", ascii_identifier(scene_.title)}, {"VERSION", CANDELA_PLUGIN_VERSION}};
        Values values = {
            {"PRELUDE", raw(glsl.prelude)},
            {"LIGHTS", raw(glsl.lights)},
            {"VERTEX", raw(glsl.vertex)},
            {"FRAGMENT", raw(glsl.fragment)},
            {"SCREEN", raw(glsl.screen)},
            {"ACCUMULATE", raw(glsl.accumulate)},
            {"ENCODE", raw(glsl.encode)},
            {"SHADINGS",
             models(scene_.shadings, glsl.shadings, [](const auto& m) { return rate_name(m.rate); })},
            {"REFLECTIONS",
             models(scene_.reflections, glsl.reflections, [](const auto&) { return "fragment"; })},
            {"WIDTH", fmt::format("{}", image.width)},
            {"HEIGHT", fmt::format("{}", image.height)},
            {"IS_SRGB", encoding_ == ColorEncoding::srgb ? "true" : "false"},
            {"EXPOSURE", float_text(image.exposure)},
            {"TONE", fmt::format("{}", static_cast<int>(image.tone))},
            // Shown as it is written, whatever the exposure.
            {"BACKGROUND", braces(1 / image.exposure * decoded(image.background, encoding_))},
            {"SAMPLES", samples()},
            {"OBSERVER", observer()},
            {"LIGHT_COUNTS", light_counts()},
            {"LIGHT_VALUES", light_values()},
            {"LIGHT_TABLE_WIDTH", fmt::format("{}", k_light_table_width)},
            {"TABLES", tables()},
            {"BIND_TABLES", if_tables("        glActiveTexture(GL_TEXTURE3);\n        table_numbers();\n")},
            {"SET_TABLES",
             if_tables("        set(program, {\"table_numbers\", Uniform::whole, {3, 0, 0}});\n")},
            {"ATTRIBUTES", is_textured()            ? "16"
                           : sees_triangles(scene_) ? "15"
                                                    : "9"},
            {"TRIANGLE_COMMENT", if_triangles(", and the triangle's vertices and normals")},
            {"TRIANGLE_SIZES", needs_channels(scene_) ? ", 3, 3, 3, 4, 4, 4, 4"
                               : is_textured()        ? ", 3, 3, 3, 3, 3, 3, 4"
                                                      : if_triangles(", 3, 3, 3, 3, 3, 3")},
            {"PUT_TRIANGLE", if_triangles(k_put_triangle)},
            {"OBJECTS", objects},
            {"COMMON_MEMBERS", common_members()},
            {"SET_COMMON", set_common()},
            {"PICTURE_FILE", std::string(image_file_source())},
            {"RADIANCE", if_mirrors(radiance_text())},
            {"FIND_RADIANCE", if_mirrors("        look_for_radiance_at(argv[0]);\n")},
            {"BIND_RADIANCE",
             if_mirrors("        glActiveTexture(GL_TEXTURE4);\n        radiance_texture();\n")},
            {"SET_RADIANCE",
             if_mirrors("        set(program, {\"radiance_texels\", Uniform::whole, {4, 0, 0}});\n")}};
        const Values shadows = shadow_values(scene_);
        for (const Values& more : {about, texture_values(scene_, glsl), shadows, layer_values(scene_)})
            values.insert(values.end(), more.begin(), more.end());
        write(files, "scene.cpp", filled(candela_opengl_scene, views_of(values)));
        values.emplace_back("ARRAYS", arrays_);
        values.emplace_back(
            "CHANNELS", needs_channels(scene_)
                            ? std::string("    std::size_t channel_count;\n    const float* const* "
                                          "channels;  // further numbers, an array each\n") +
                                  (has_opacity_of_channels(scene_)
                                       ? "    std::size_t opacity_channel;    // the first of two that the "
                                         "opacity reads\n"
                                       : "")
                            : "");
        write(files, "meshes.h", filled(candela_opengl_meshes, views_of(values)));
        write(files, "CMakeLists.txt", candela_opengl_cmake);
        write(files, "README.md", filled(candela_opengl_readme, views_of(values)));
        write_textures(scene_, files);
        write_radiance(scene_, files);
    }

  private:
    static constexpr const char* k_put_triangle =
        "            for (std::size_t corner = 0; corner < 3; ++corner) {\n"
        "                put(9 + corner, vector(mesh.position, v[corner]));\n"
        "                put(12 + corner, vector(mesh.normals[normals], v[corner]));\n"
        "            }\n";
    const char* if_triangles(const char* text) const { return sees_triangles(scene_) ? text : ""; }
    std::string if_mirrors(std::string text) const {
        return has_mirror_images(scene_) ? std::move(text) : "";
    }
    static std::string radiance_text() {
        return std::string(radiance_file_source()) +
               fmt::format(
                   "\n// The texels as a texture, in rows of this width.\nGLuint radiance_texture() {{\n"
                   "    const std::size_t width = {};\n"
                   "    return data_texture(GL_RGB32F, width, radiance_texels().size() / (3 * width), "
                   "GL_RGB, "
                   "GL_FLOAT, radiance_texels().data());\n}}\n\n",
                   k_radiance_width);
    }
    bool is_textured() const { return has_textured_materials(scene_); }

    template <class Model, class RateOf>
    static std::string models(std::span<const Model> all, const std::vector<std::string>& glsl,
                              RateOf rate_of) {
        std::string text;
        for (std::size_t i = 0; i < all.size(); ++i)
            text += fmt::format("    {{\"{}\", Rate::{}, {}}},\n", all[i].plugin->name, rate_of(all[i]),
                                raw(glsl[i]));
        return text;
    }

    std::string samples() const {
        std::vector<std::string> positions;
        for (const ExportedSample& s : scene_.image.samples)
            positions.push_back(fmt::format("{{{}, {}}}", float_text(s.x), float_text(s.y)));
        return fmt::format("{{{}}}", fmt::join(positions, ", "));
    }

    std::string observer() const {
        const ExportedObserver& o = scene_.observer;
        const bool is_perspective = o.projection == Projection::perspective;
        return fmt::format("{}, {}, {}, {}, {}", braces(o.position), braces(o.look_at), braces(o.up),
                           is_perspective, float_text(is_perspective ? o.fov : o.height));
    }

    static std::string whole(const std::string& name, std::size_t first, std::size_t second = 0) {
        return fmt::format("{{\"{}\", Uniform::whole, {{{}, {}, 0}}}}", name, first, second);
    }
    static std::string vector(const char* name, Vec3 v) {
        return fmt::format("{{\"{}\", Uniform::vector, {}}}", name, braces(v));
    }

    static std::string uniform(const ParamSpec& p, const ParamValue& value) {
        switch (p.type) {
            case ParamType::matrix: {
                const auto columns = columns_of(value);
                return fmt::format("{{\"{}\", Uniform::matrix, {}, {{{{{}, {}}}}}}}", p.name,
                                   braces(columns[0]), braces(columns[1]), braces(columns[2]));
            }
            case ParamType::real:
                return fmt::format("{{\"{}\", Uniform::real, {{{}, 0, 0}}}}", p.name,
                                   float_text(value.number[0]));
            case ParamType::integer:
            case ParamType::boolean:
            case ParamType::choice:
                return fmt::format("{{\"{}\", Uniform::whole, {{{}, 0, 0}}}}", p.name, value.integer);
            default:
                return vector(p.name, {value.number[0], value.number[1], value.number[2]});
        }
    }

    /// A member of a light's struct, as the texels that hold it.
    static std::vector<std::string> texels(const ParamSpec& p, const ParamValue& value) {
        switch (p.type) {
            case ParamType::matrix: {
                std::vector<std::string> columns;
                for (const Vec3& column : columns_of(value)) columns.push_back(vector(p.name, column));
                return columns;
            }
            case ParamType::file:
            case ParamType::numbers:
                return {whole(p.name, static_cast<std::size_t>(value.integer), value.list.size())};
            default:
                return {uniform(p, value)};
        }
    }

    static std::vector<std::string> uniforms(const ExportedModel& model, const ExportedValues& values) {
        std::vector<std::string> all;
        for (std::size_t i = 0; i < values.runtime.size(); ++i) {
            const ParamSpec& p = model.plugin->parameters[i];
            const ParamValue& value = values.runtime[i];
            if (p.type == ParamType::file || p.type == ParamType::numbers) {
                all.push_back(whole(std::string(p.name) + ".first", static_cast<std::size_t>(value.integer)));
                all.push_back(whole(std::string(p.name) + ".count", value.list.size()));
            } else if (p.type != ParamType::text) {
                all.push_back(uniform(p, value));
            }
        }
        return all;
    }

    std::string light_counts() const {
        std::string text;
        for (const LightBlock& block : light_blocks(scene_))
            text += fmt::format("    {{\"{}\", Uniform::whole, {{{}, 0, 0}}}},\n", block.count, block.lights);
        return text;
    }

    std::string light_values() const {
        std::string text;
        for (std::size_t m = 0; m < scene_.light_models.size(); ++m) {
            const PluginDescriptor& plugin = *scene_.light_models[m].plugin;
            for (const ExportedLight& light : scene_.lights) {
                if (light.model != m) continue;
                text += fmt::format("    // {}\n", ascii_identifier(light.label));
                for (const std::size_t i : plugin.kernel.members) {
                    for (const std::string& texel : texels(plugin.parameters[i], light.values.runtime[i]))
                        text += fmt::format("    {},\n", texel);
                }
                if (has_mirror_images(scene_))
                    text += fmt::format(
                        "    {},\n",
                        vector("radiance", radiance_place(scene_, static_cast<std::size_t>(
                                                                      &light - scene_.lights.data()))));
                if (scene_.has_shadows)
                    text += fmt::format("    {},\n", vector("shadows", shadow_texel(light)));
            }
        }
        return text;
    }

    /// Empty in a program without tables.
    std::string if_tables(std::string text) const { return scene_.tables.empty() ? "" : std::move(text); }

    std::string tables() const {
        std::vector<std::string> numbers;
        for (const float x : scene_.tables) numbers.push_back(float_text(x));
        std::string text;
        for (std::size_t i = 0; i < numbers.size(); i += 10) {
            const auto row = std::span(numbers).subspan(i, std::min<std::size_t>(10, numbers.size() - i));
            text += fmt::format("    {},\n", fmt::join(row, ", "));
        }
        return if_tables(
            filled(candela_opengl_tables, {{"NUMBERS", text}, {"WIDTH", fmt::format("{}", k_table_width)}}));
    }

    template <class Model>
    static std::string all_uniforms(std::span<const Model> models, std::span<const ExportedValues> sets) {
        std::vector<std::string> all;
        for (std::size_t i = 0; i < sets.size(); ++i)
            all.push_back(fmt::format("{{{}}}", fmt::join(uniforms(models[i], sets[i]), ", ")));
        return fmt::format("{{{}}}", fmt::join(all, ",\n      "));
    }

    /// The keys of every material; empty in a scene without it.
    std::string common_members() const {
        return std::string(has_emission(scene_) ? "    vec3 emission;\n" : "") +
               (has_occlusion(scene_) ? "    float occlusion;  // of ambient light\n" : "") +
               (has_opacity(scene_)
                    ? "    float opacity, opacity_cutoff;  // with one above 0, opaque or absent\n"
                    : "");
    }
    std::string set_common() const {
        return std::string(has_emission(scene_) ? "            set(program, {\"object_emission\", "
                                                  "Uniform::vector, object.emission});\n"
                                                : "") +
               (has_occlusion(scene_) ? "            set(program, {\"object_occlusion\", Uniform::real, "
                                        "{object.occlusion, 0, 0}});\n"
                                      : "");
    }
    std::string common_values(const ExportedObject& object) const {
        return (has_emission(scene_) ? braces(emission_of(object, encoding_)) + ", " : "") +
               (has_occlusion(scene_) ? float_text(object.occlusion) + ", " : "") +
               (has_opacity(scene_)
                    ? fmt::format("{}, {}, ", float_text(object.opacity), float_text(object.opacity_cutoff))
                    : "");
    }

    std::string object_text(std::size_t index) {
        const ExportedObject& object = scene_.objects[index];
        const ExportedMesh mesh = scene_.geometry->in_world_space(index);
        add_arrays(index, mesh);
        return fmt::format("    {{\"{}\", {}, {}{}, {},\n     {},\n     {},\n     {}, object_{}(){}}},\n",
                           ascii_identifier(object.label), braces(decoded(object.color, encoding_)),
                           common_values(object), object.shading, object.reflection,
                           all_uniforms(scene_.reflections, object.materials),
                           all_uniforms(scene_.shadings, object.shadings), mesh.closed, index,
                           texture_members(scene_, index) + shadow_members(scene_, object, mesh));
    }

    void add_arrays(std::size_t index, const ExportedMesh& mesh) {
        const std::size_t count = mesh.vertex_count;
        std::string body = number_array("unsigned", "corners", mesh.indices) +
                           number_array("float", "position", interleaved(mesh.position, count));
        std::vector<std::string> sets;
        for (const ConstVec3Span& normals : mesh.normals) {
            sets.push_back(fmt::format("normals_{}", sets.size()));
            body += number_array("float", sets.back().c_str(), interleaved(normals, count));
        }
        const auto optional = [&](const char* name, const std::vector<float>& numbers) {
            if (numbers.empty()) return "nullptr";
            body += number_array("float", name, numbers);
            return name;
        };
        const char* const uv =
            optional("uv", scene_.needs_uv ? interleaved(mesh.uv, count) : std::vector<float>());
        const bool needs_derivatives = scene_.needs_derivatives;
        const char* const dpdu =
            optional("dpdu", needs_derivatives ? interleaved(mesh.dpdu, count) : std::vector<float>());
        const char* const dpdv =
            optional("dpdv", needs_derivatives ? interleaved(mesh.dpdv, count) : std::vector<float>());
        const char* const color = optional("color", interleaved(mesh.color, count));
        std::string channels = needs_channels(scene_) ? add_channels(mesh, body) : "";
        if (has_opacity_of_channels(scene_))
            channels += fmt::format(", {}", opacity_channel(scene_.objects[index]).value_or(0));
        arrays_ += fmt::format(
            "\n// {}\ninline MeshArrays object_{}() {{\n{}    static const float* const normals[] = {{{}}};\n"
            "    static const std::size_t normals_of[] = {{{}}};\n    return {{{}, {}, corners, position, "
            "normals, normals_of, {}, {}, "
            "{}, {}{}}};\n}}\n",
            ascii_identifier(scene_.objects[index].label), index, body, fmt::join(sets, ", "),
            fmt::join(mesh.normals_of, ", "), count, mesh.triangle_count(), uv, dpdu, dpdv, color, channels);
    }

    /// Adds the numbers of the vertices to `body`; returns what the arrays' members are set to.
    static std::string add_channels(const ExportedMesh& mesh, std::string& body) {
        if (mesh.channels.empty()) return ", 0, nullptr";
        std::vector<std::string> names;
        for (const std::span<const float> channel : mesh.channels) {
            names.push_back(fmt::format("channel_{}", names.size()));
            body += number_array("float", names.back().c_str(),
                                 std::vector<float>(channel.begin(), channel.end()));
        }
        body += fmt::format("    static const float* const channels[] = {{{}}};\n", fmt::join(names, ", "));
        return fmt::format(", {}, channels", names.size());
    }

    const ExportedScene& scene_;
    ColorEncoding encoding_;
    std::string arrays_;
};

class OpenGlTarget final : public Target {
  public:
    explicit OpenGlTarget(const sdk::NoParams&) {}

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
    void write(const ExportedScene& scene, FileSink& files) const override { OpenGlWriter(scene).run(files); }
    const char* main_file() const noexcept override { return "scene.cpp"; }
    bool can_draw() const noexcept override { return true; }

    void build(const char* directory, ProgramRunner& programs) const override {
        build_with_cmake(programs, directory, CANDELA_PLUGIN_NAME);
    }
    void draw(const char* directory, const char* picture, ProgramRunner& programs) const override {
        run(programs, {program_in(directory), "--headless", "--output", picture},
            "the " CANDELA_PLUGIN_NAME " program does not run");
    }
    int show(const char* directory, ProgramRunner& programs) const override {
        return target::show(programs, {program_in(directory)});
    }

  private:
    static std::string program_in(const char* directory) { return std::string(directory) + "/build/scene"; }
};

}  // namespace

}  // namespace candela::opengl_target

using candela::opengl_target::OpenGlTarget;

CANDELA_PLUGIN(target, OpenGlTarget, candela::sdk::k_no_fields,
               {.title = "OpenGL",
                .summary = "C++ with OpenGL 3.3: an interactive window, or a picture without a display"})
