#include "exported_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <utility>
#include <variant>

using candela::Error;
using candela::ErrorCategory;
using candela::ParamSet;
using candela::PluginFile;
using candela::PluginKind;

namespace generate {

namespace {

constexpr const char* k_no_kernel =
    "has no kernel, the text that its mathematics is generated from; a program can only be generated with "
    "models that have one";

/// Labels are for messages: 'lamp', in quotes, or number 2.
std::string name_in(const std::string& label) {
    const bool is_quoted = label.size() > 2 && label.front() == '\'' && label.back() == '\'';
    return is_quoted ? label.substr(1, label.size() - 2) : label;
}

/// Puts the models of one kind into a list, each once.
template <class Exported>
std::size_t put(std::vector<Exported>& list, Exported model) {
    const auto found =
        std::ranges::find_if(list, [&](const Exported& m) { return m.manifest == model.manifest; });
    if (found != list.end()) return static_cast<std::size_t>(found - list.begin());
    list.push_back(std::move(model));
    return list.size() - 1;
}

class Exporter {
  public:
    Exporter(const candela::Scene& scene, const WithModel& with_model, candela::Registry& registry)
        : scene_(scene), with_model_(with_model), registry_(registry) {}

    ExportedScene run(const std::string& title, const ExtraModels& extra) {
        result_.title = title;
        result_.observer = scene_.observer;
        result_.image = scene_.image;
        if (!scene_.image.environment.empty()) {
            throw Error(ErrorCategory::failure,
                        "[image] environment: a generated program has a background of one colour, not a "
                        "picture all around");
        }
        for (const candela::LightSource& light : scene_.lights) add(light);
        for (const candela::Object& object : scene_.objects) add_models(object);
        for (const std::string& name : extra) add_extra(name);
        for (std::size_t i = 0; i < scene_.objects.size(); ++i) add(i);
        check_names();
        return std::move(result_);
    }

  private:
    candela::ColorEncoding encoding() const { return scene_.image.color_management; }

    template <class Interface>
    std::unique_ptr<Interface> made(const std::string& name, const ParamSet& values) {
        return registry_.create<Interface>(name, values, encoding());
    }

    /// The plugin, which has been loaded.
    template <class Exported>
    Exported model_of(PluginKind kind, const std::string& name) {
        const PluginFile& file = registry_.require(kind, name);
        const candela::KernelText& kernel = file.descriptor->kernel;
        if (kernel.text == nullptr)
            throw Error(ErrorCategory::failure,
                        fmt::format("{}/{} {}", candela::name_of(kind), name, k_no_kernel));
        Exported model;
        model.manifest = &file.manifest;
        model.kernel = KernelSource(kernel.text, kernel.prefix, kernel.parameters);
        return model;
    }

    static void require_function(const ExportedModel& model, const char* suffix) {
        if (model.kernel.function(suffix) != nullptr) return;
        throw Error(ErrorCategory::failure, fmt::format("{}: its kernel has no function {}_{}",
                                                        model.manifest->id(), model.kernel.prefix(), suffix));
    }

    void add(const candela::LightSource& light) {
        const auto made_light = made<candela::Light>(light.model.name, light.model.parameters);
        auto model = model_of<ExportedModel>(PluginKind::light, light.model.name);
        if (made_light->sample_count() > 0) require_function(model, "illuminate");
        if (made_light->has_ambient()) require_function(model, "illuminate_ambient");
        result_.lights.push_back(
            {light.label, put(result_.light_models, std::move(model)), light.model.parameters});
    }

    std::size_t add_shading(const std::string& name, const ParamSet& values) {
        const auto instance = made<candela::ShadingModel>(name, values);
        auto model = model_of<ExportedShading>(PluginKind::shading, name);
        require_function(model, "normal");
        model.rate = instance->shading_rate();
        model.needs = instance->needs();
        return put(result_.shadings, std::move(model));
    }

    std::size_t add_reflection(const std::string& name, const ParamSet& values) {
        const auto instance = made<candela::ReflectionModel>(name, values);
        if (instance->shows_surroundings()) {
            throw Error(
                ErrorCategory::failure,
                fmt::format(
                    "reflection/{} shows what is behind and around an object, for which rays are followed "
                    "through it; generated programs do not do that",
                    name));
        }
        auto model = model_of<ExportedReflection>(PluginKind::reflection, name);
        require_function(model, "reflect");
        require_function(model, "reflect_ambient");
        model.needs_tangent = instance->needs_tangent();
        return put(result_.reflections, std::move(model));
    }

    void add_models(const candela::Object& object) {
        try {
            add_shading(object.shading.name, object.shading.parameters);
            add_reflection(object.reflection.name, object.reflection.parameters);
        } catch (const Error& problem) {
            throw Error(problem.category(), fmt::format("object {}: {}", object.label, problem.what()));
        }
    }

    void add_default(PluginKind kind, const std::string& name) {
        const ParamSet values = registry_.parameters(kind, name);
        kind == PluginKind::shading ? add_shading(name, values) : add_reflection(name, values);
    }

    void add_extra(const std::string& name) {
        constexpr PluginKind k_kinds[] = {PluginKind::shading, PluginKind::reflection};
        if (name == "all") {
            for (const PluginKind kind : k_kinds) {
                for (const std::string& each : registry_.names(kind)) {
                    try {
                        add_default(kind, each);
                    } catch (const Error&) {
                        continue;  // "all" are those that can be exported
                    }
                }
            }
            return;
        }
        bool is_known = false;
        std::vector<std::string> names;
        for (const PluginKind kind : k_kinds) {
            for (const std::string& each : registry_.names(kind)) {
                names.push_back(each);
                if (each != name && fmt::format("{}/{}", candela::name_of(kind), each) != name) continue;
                add_default(kind, each);
                is_known = true;
            }
        }
        if (is_known) return;
        const auto near = candela::closest(name, names);
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--models: no reflection or shading model is called '{}'{}", name,
                                near ? fmt::format("; did you mean '{}'?", *near)
                                     : " (candela list reflection, candela list shading)"));
    }

    /// The scene with that model for all objects, or nothing where it is not valid so. Each model is asked
    /// for once.
    const std::optional<candela::Scene>& with(PluginKind kind, const std::string& name) {
        const auto at = with_.find({kind, name});
        if (at != with_.end()) return at->second;
        auto scene = with_model_(kind, name);
        if (scene && scene->objects.size() != scene_.objects.size()) scene.reset();
        return with_.emplace(std::pair(kind, name), std::move(scene)).first->second;
    }

    /// An object's values for a model that is not its own: what `--shading` and `--reflection` would give it.
    /// Where the scene is not valid with them, because a word of its own model means nothing to the other:
    /// the defaults.
    ParamSet values_for(PluginKind kind, const std::string& name, std::size_t index) {
        const auto& scene = with(kind, name);
        if (!scene) return registry_.parameters(kind, name);
        const candela::Object& object = scene->objects[index];
        return kind == PluginKind::shading ? object.shading.parameters : object.reflection.parameters;
    }

    void add(std::size_t index) {
        const candela::Object& object = scene_.objects[index];
        ExportedObject& to = result_.objects.emplace_back();
        to.label = name_in(object.label);
        to.color = object.color;
        to.transform = object.transform;
        to.shape = object.shape.name;
        to.shape_values = object.shape.parameters;
        to.tessellator = made<candela::Shape>(object.shape.name, object.shape.parameters);
        const PluginFile& shape = registry_.require(PluginKind::shape, object.shape.name);
        if (shape.descriptor->kernel.text != nullptr)
            to.shape_model = model_of<ExportedModel>(PluginKind::shape, object.shape.name);
        for (std::size_t i = 0; i < result_.shadings.size(); ++i) {
            const std::string& name = result_.shadings[i].name();
            const bool is_own = name == object.shading.name;
            if (is_own) to.shading = i;
            to.shadings.push_back(is_own ? object.shading.parameters
                                         : values_for(PluginKind::shading, name, index));
        }
        for (std::size_t i = 0; i < result_.reflections.size(); ++i) {
            const std::string& name = result_.reflections[i].name();
            const bool is_own = name == object.reflection.name;
            if (is_own) to.reflection = i;
            to.materials.push_back(is_own ? object.reflection.parameters
                                          : values_for(PluginKind::reflection, name, index));
        }
        to.closed = candela::place(*to.tessellator, {}, to.transform).mesh.closed;
    }

    /// One program holds all kernels, and neither C++ nor GLSL would tell two things of one name apart.
    void check_names() {
        std::map<std::string, std::string> whose;
        std::vector<const ExportedModel*> all = result_.models();
        for (const ExportedObject& object : result_.objects) {
            if (object.shape_model) all.push_back(&*object.shape_model);
        }
        for (const ExportedModel* model : all) {
            for (const std::string& name : model->kernel.names()) {
                const auto [at, is_new] = whose.try_emplace(name, model->manifest->id());
                if (is_new || at->second == model->manifest->id()) continue;
                throw Error(ErrorCategory::failure,
                            fmt::format("the kernels of {} and {} both declare '{}', so "
                                        "that they cannot stand in one program; a "
                                        "name that begins with the model's own would do",
                                        at->second, model->manifest->id(), name));
            }
        }
    }

    const candela::Scene& scene_;
    const WithModel& with_model_;
    candela::Registry& registry_;
    std::map<std::pair<PluginKind, std::string>, std::optional<candela::Scene>> with_;
    ExportedScene result_;
};

bool are_equal(const candela::Vec3Arrays& a, const candela::Vec3Arrays& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

}  // namespace

bool ExportedScene::needs_derivatives() const {
    return std::ranges::any_of(reflections, &ExportedReflection::needs_tangent) ||
           std::ranges::any_of(shadings, [](const ExportedShading& s) { return s.needs.derivatives; });
}

bool ExportedScene::needs_uv() const {
    return std::ranges::any_of(shadings, [](const ExportedShading& s) { return s.needs.uv; });
}

std::vector<const ExportedModel*> ExportedScene::models() const {
    std::vector<const ExportedModel*> all;
    for (const auto& model : light_models) all.push_back(&model);
    for (const auto& model : reflections) all.push_back(&model);
    for (const auto& model : shadings) all.push_back(&model);
    return all;
}

ExportedScene exported(const candela::Scene& scene, const std::string& title, const ExtraModels& extra,
                       const WithModel& with_model, candela::Registry& registry) {
    return Exporter(scene, with_model, registry).run(title, extra);
}

WorldMesh world_mesh(const ExportedScene& scene, const ExportedObject& object, candela::Registry& registry) {
    WorldMesh result;
    const candela::MeshRequest request{.uv = scene.needs_uv(), .derivatives = scene.needs_derivatives()};
    for (std::size_t i = 0; i < scene.shadings.size(); ++i) {
        const auto shading = registry.create<candela::ShadingModel>(
            scene.shadings[i].name(), object.shadings[i], scene.image.color_management);
        candela::Mesh mesh = candela::build_mesh(*object.tessellator, request, object.transform, *shading);
        candela::Vec3Arrays normals = mesh.vertex_normals();
        const auto same = std::ranges::find_if(
            result.normals, [&](const candela::Vec3Arrays& n) { return are_equal(n, normals); });
        result.normals_of.push_back(static_cast<std::size_t>(same - result.normals.begin()));
        if (same == result.normals.end()) result.normals.push_back(std::move(normals));
        if (i == 0) result.mesh = std::move(mesh);
    }
    return result;
}

}  // namespace generate
