// candela exercise new: creates a fill-in-the-formula exercise.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "candela/target/arrays.h"
#include "candela/target/glsl.h"
#include "candela/target/kernels.h"
#include "candela/target/literals.h"
#include "cli/command_line.h"
#include "cli/outputs.h"
#include "commands/exercise.h"
#include "console/reporting.h"
#include "exercise/exercise_page.h"
#include "exercise/exercises.h"
#include "plot/model_argument.h"
#include "scene_export/scene_export.h"

import candela.api;
import candela.plugins;
import candela.render;
import candela.util;

namespace po = boost::program_options;
using candela::Error;
using candela::ErrorCategory;
using candela::ParamType;
using candela::Vec3;

namespace {

constexpr std::size_t k_size = 80;    // of the picture, in pixels
constexpr double k_edge = 0.98;       // of the ball, in radii, squared: beyond it the view is too grazing
constexpr std::size_t k_batch = 256;  // points evaluated at once
constexpr Vec3 k_color{0.8f, 0.5f, 0.2f};  // C_o

/// The points of a ball seen from far away along z, as in the kernel's Surface.
struct Ball {
    std::vector<std::size_t> pixels;
    std::vector<float> nx, ny, nz, tx, ty, tz;

    Ball() {
        for (std::size_t row = 0; row < k_size; ++row) {
            for (std::size_t column = 0; column < k_size; ++column) {
                const auto at = [](std::size_t i) {
                    return (2 * (static_cast<double>(i) + 0.5) / k_size) - 1;
                };
                const double x = at(column), y = -at(row), square = x * x + y * y;
                if (square > k_edge) continue;
                const double z = std::sqrt(1 - square), along = std::hypot(x, z);  // T = dp/du: around y
                pixels.push_back(row * k_size + column);
                put(nx, x), put(ny, y), put(nz, z);
                put(tx, z / along), put(ty, 0), put(tz, -x / along);
            }
        }
    }

  private:
    static void put(std::vector<float>& to, double value) { to.push_back(static_cast<float>(value)); }
};

std::vector<float> interleaved(const std::vector<float>& x, const std::vector<float>& y,
                               const std::vector<float>& z) {
    return candela::target::interleaved(candela::ConstVec3Span{x.data(), y.data(), z.data()}, x.size());
}

/// The model's results for light from one direction: three numbers per point and term, for light of intensity
/// 1.
void evaluate(const candela::ReflectionModel& model, const Ball& ball, exercise::Case& to) {
    for (std::size_t first = 0; first < ball.pixels.size(); first += k_batch) {
        const std::size_t count = std::min(k_batch, ball.pixels.size() - first);
        const std::vector<float> zeros(count, 0), ones(count, 1);
        std::array<std::vector<float>, 3> light;
        for (std::size_t c = 0; c < 3; ++c) light[c].assign(count, to.to_light[c]);
        const candela::ConstVec3Span normal{ball.nx.data() + first, ball.ny.data() + first,
                                            ball.nz.data() + first};
        const candela::ConstVec3Span one{ones.data(), ones.data(), ones.data()};
        std::array<std::vector<float>, 9> out;
        for (std::vector<float>& array : out) array.assign(count, 0);
        const auto span = [&](std::size_t i) {
            return candela::Vec3Span{out[i].data(), out[i + 1].data(), out[i + 2].data()};
        };
        const candela::SurfaceBatch surface{
            .count = count,
            .normal = normal,
            .to_observer = {zeros.data(), zeros.data(), ones.data()},
            .tangent = {ball.tx.data() + first, ball.ty.data() + first, ball.tz.data() + first},
            .color = {k_color.x, k_color.y, k_color.z},
            .position = normal,
            .uv = {zeros.data(), zeros.data()}};
        const candela::ReflectedBatch reflected{.ambient = span(0), .diffuse = span(3), .specular = span(6)};
        model.reflect_ambient(surface, one, reflected);
        model.reflect(surface,
                      {.to_light = {light[0].data(), light[1].data(), light[2].data()},
                       .diffuse = one,
                       .specular = one},
                      reflected);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                to.ambient.push_back(out[c][i]);
                to.diffuse.push_back(out[3 + c][i]);
                to.specular.push_back(out[6 + c][i]);
            }
        }
    }
}

exercise::Uniform uniform_of(const candela::ParamSpec& parameter, const candela::ParamValue& value) {
    const std::string name = fmt::format("material.{}", parameter.name);
    switch (parameter.type) {
        case ParamType::real:
            return {name, "float", {value.number[0]}};
        case ParamType::integer:
        case ParamType::boolean:
        case ParamType::choice:
            return {name, "int", {static_cast<float>(value.integer)}};
        case ParamType::matrix: {
            exercise::Uniform uniform{name, "mat3", {}};
            for (const Vec3& column : candela::target::columns_of(value))
                uniform.value.insert(uniform.value.end(), {column.x, column.y, column.z});
            return uniform;
        }
        default:
            return {name, "vec3", {value.number[0], value.number[1], value.number[2]}};
    }
}

/// The model with values other than its defaults, so that every answer needs the parameters.
NamedModel varied(const NamedModel& model, const candela::Manifest& manifest) {
    constexpr double k_factor = 0.6;
    NamedModel result = model;
    for (const candela::Parameter& parameter : manifest.parameters) {
        double value = 0;
        if (!parameter.default_value) continue;
        if (const auto* const number = std::get_if<double>(&*parameter.default_value))
            value = *number;
        else if (const auto* const three = std::get_if<Vec3>(&*parameter.default_value);
                 three != nullptr && parameter.type == ParamType::rgb)
            value = static_cast<double>(three->x);
        else
            continue;
        value *= k_factor;
        const bool is_allowed =
            value > static_cast<double>(parameter.minimum) && value < static_cast<double>(parameter.maximum);
        if (is_allowed && value != 0)
            result.values.emplace_back(parameter.name, fmt::format("{:.4g}", value));
    }
    return result;
}

struct Setup {
    std::string label;
    Vec3 to_light;
    NamedModel model;
};

exercise::Case case_of(const Setup& setup, const Ball& ball, const candela::PluginDescriptor& plugin,
                       candela::Registry& registry) {
    const candela::Scene scene = scene_with(setup.model, registry);
    const candela::Model& reflection = scene.objects.front().reflection;
    const auto instance = registry.create<candela::ReflectionModel>(reflection.name, reflection.parameters,
                                                                    scene.image.color_management);
    const Vec3 l = candela::normalized(setup.to_light);
    exercise::Case result{.label = setup.label,
                          .to_light = {l.x, l.y, l.z},
                          .material = {},
                          .ambient = {},
                          .diffuse = {},
                          .specular = {}};
    const auto runtime = reflection.parameters.runtime(scene.image.color_management);
    for (const std::size_t i : plugin.kernel.members)
        result.material.push_back(uniform_of(plugin.parameters[i], runtime[i]));
    evaluate(*instance, ball, result);
    return result;
}

/// The shader of a scene with the model, without comments.
std::string shader_of(const NamedModel& model, candela::Registry& registry) {
    const candela::Scene scene = scene_with(model, registry);
    const candela::SceneExport exported(scene, {.title = "exercise", .abilities = {}}, registry);
    const candela::target::GlslParts parts = candela::target::glsl_of(exported.scene());
    return candela::target::without_comments(candela::target::whole_glsl_prelude() +
                                             parts.reflections.front());
}

void require_no_table(const Exercise& exercise) {
    for (const candela::ParamSpec& parameter : exercise.plugin->descriptor->parameters) {
        if (parameter.type == ParamType::numbers || parameter.type == ParamType::file)
            throw Error(ErrorCategory::bad_request,
                        fmt::format("{} reads a table ({}), which an exercise's page cannot provide",
                                    exercise.model, parameter.name));
    }
}

std::string page_for(const Exercise& exercise, candela::Registry& registry) {
    const candela::PluginDescriptor& plugin = *exercise.plugin->descriptor;
    const NamedModel model{.kind = candela::PluginKind::reflection,
                           .name = candela::is_kernel_file(exercise.model) ? exercise.model : plugin.name};
    const TextAroundBody shader = text_around_body(shader_of(model, registry), exercise.function);
    const Ball ball;
    const std::vector<float> normals = interleaved(ball.nx, ball.ny, ball.nz),
                             tangents = interleaved(ball.tx, ball.ty, ball.tz);
    exercise::Content content{.model = exercise.model,
                              .function = exercise.function,
                              .title = plugin.title,
                              .reference = plugin.reference,
                              .before = exercise.text.before,
                              .after = exercise.text.after,
                              .glsl_before = shader.before,
                              .glsl_after = shader.after,
                              .size = k_size,
                              .pixels = ball.pixels,
                              .normals = normals,
                              .tangents = tangents,
                              .color = {k_color.x, k_color.y, k_color.z},
                              .cases = {}};
    const std::array<Setup, 3> setups = {{{"lit from the upper left", {-0.5f, 0.6f, 0.65f}, model},
                                          {"lit from behind", {0.6f, -0.4f, -0.7f}, model},
                                          {"other values, lit from the right",
                                           {0.8f, 0.1f, 0.55f},
                                           varied(model, exercise.plugin->manifest)}}};
    for (const Setup& setup : setups) content.cases.push_back(case_of(setup, ball, plugin, registry));
    return exercise::page_of(content);
}

}  // namespace

int run_exercise_new(const std::vector<std::string>& arguments) {
    CommandLine line("candela exercise new MODEL|FILE.kernel --blank FUNCTION [options]",
                     "Create a page in which the body of one function of a reflection model's kernel is left "
                     "blank. While the reader writes it, the page shows how far off it is from the model, "
                     "where, and in which term. The page holds numbers from the model, not its formula, and "
                     "needs no other file. It saves answers for `candela exercise grade`.");
    line.positional("model", 1);
    line.options()("blank", po::value<std::string>()->value_name("FUNCTION"),
                   "the function of the kernel to leave blank: reflect, reflect_ambient, or any other")(
        "output,o", po::value<std::string>()->value_name("FILE"), "the page; default: MODEL-FUNCTION.html");
    add_no_clobber_option(line);
    add_plugin_options(line);
    if (!line.parse(arguments)) return 0;
    const std::vector<std::string> models = line.all("model");
    if (models.empty())
        throw Error(ErrorCategory::bad_request,
                    "candela exercise new needs a model, as in candela exercise new reflection/phong --blank "
                    "reflect");
    candela::Registry registry = registry_from(line);
    // The first request lists the functions that can be left blank.
    const Exercise exercise =
        exercise_about(models.front(), line.has("blank") ? line.get<std::string>("blank") : "", registry);
    require_no_table(exercise);
    const std::string output =
        line.has("output")
            ? line.get<std::string>("output")
            : fmt::format("{}-{}.html", exercise.plugin->manifest.name,
                          exercise.function.substr(
                              std::string(exercise.plugin->descriptor->kernel.prefix).size() + 1));
    // Protects a scene, say, if the name was completed too far.
    if (const std::string extension = candela::extension_of(output);
        output != "-" && extension != "html" && extension != "htm")
        throw Error(ErrorCategory::bad_request,
                    fmt::format("'{}' is not the name of a page; expected one that ends in .html", output));
    const candela::Existing existing = existing_from(line);
    require_free(output, existing);
    require_no_default_link(line, "output", output);
    const std::string page = page_for(exercise, registry);
    candela::write_text_file(output, page, existing);
    say_afterwards([&] { return fmt::format("{}: {}\n", output, candela::size_text(page.size())); });
    return 0;
}
