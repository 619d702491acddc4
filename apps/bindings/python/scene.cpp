#include "scene.h"

#include "images.h"
#include "module.h"
#include "scene_edit/text_edits.h"
#include "values.h"

import candela.api;
import candela.render;

namespace candela::python {

namespace {

/// The source of a scene: files, or one text with a name.
struct Source {
    std::vector<std::filesystem::path> files;
    std::optional<std::pair<std::string, std::string>> text;  // its name and the text
};

SceneRequest request_of(const Source& source, const Settings& settings,
                        const std::optional<std::string>& shading,
                        const std::optional<std::string>& reflection, int frame, bool defaults) {
    SceneRequest request;
    request.files = source.files;
    if (source.text) {
        request.files = {source.text->first};
        request.streams.emplace(*source.text);
    }
    if (shading) request.shading = {*shading, "shading="};
    if (reflection) request.reflection = {*reflection, "reflection="};
    request.frame = frame;
    request.use_defaults = defaults;
    return with_settings(std::move(request), settings);
}

ScenePointer loaded(const RegistryPointer& registry, std::vector<std::filesystem::path> files,
                    const Settings& settings, const std::optional<std::string>& shading,
                    const std::optional<std::string>& reflection, int frame, bool defaults, int threads) {
    return std::make_shared<ReadScene>(
        registry, request_of({std::move(files), {}}, settings, shading, reflection, frame, defaults),
        threads);
}

ScenePointer parsed(const RegistryPointer& registry, std::string text, std::string name,
                    const Settings& settings, const std::optional<std::string>& shading,
                    const std::optional<std::string>& reflection, int frame, bool defaults, int threads) {
    const Source source{{}, std::pair(std::move(name), std::move(text))};
    return std::make_shared<ReadScene>(
        registry, request_of(source, settings, shading, reflection, frame, defaults), threads);
}

ScenePointer changed(const ReadScene& scene, const Settings& settings) {
    return std::make_shared<ReadScene>(scene.registry(), with_settings(scene.request(), settings),
                                       scene.threads());
}

ScenePointer frame_of(const ReadScene& scene, int frame) {
    SceneRequest request = scene.request();
    request.frame = frame;
    return std::make_shared<ReadScene>(scene.registry(), std::move(request), scene.threads());
}

py::array rendered(const ReadScene& scene, bool floats) {
    std::optional<Film> film;
    {
        const py::gil_scoped_release unlocked;
        const ImageSettings& image = scene.compiled().image;
        film.emplace(image.width, image.height, floats ? PixelType::real : PixelType::byte,
                     display_of(scene.compiled()));
        render(scene.compiled(), *film, {.threads = scene.threads()});
    }
    return array_of(*std::move(film));
}

std::vector<std::pair<std::string, std::string>> labels_of(const ReadScene& scene) {
    std::vector<std::pair<std::string, std::string>> labels;
    for (const LightSource& light : scene.scene().lights) labels.emplace_back("light", light.label.text());
    for (const Object& object : scene.scene().objects) labels.emplace_back("object", object.label.text());
    return labels;
}

int frame_count(const ReadScene& scene) {
    return scene.scene().animation ? scene.scene().animation->frames : 1;
}

}  // namespace

SceneRequest with_settings(SceneRequest request, const Settings& settings) {
    for (const auto& [path, value] : settings) {
        std::erase_if(request.settings, [&](const Setting& setting) { return setting.path == path; });
        request.settings.push_back({fmt::format("'{}'", path), path, value});
    }
    return request;
}

SceneDraft valid_draft(const SceneRequest& request, Registry& registry, Diagnostics& diagnostics) {
    auto draft = draft_scene(request, registry, diagnostics);
    if (!draft) throw InvalidInput(InvalidInput::What::scene, diagnostics);
    return *std::move(draft);
}

ReadScene::ReadScene(RegistryPointer registry, SceneRequest request, int threads)
    : registry_(std::move(registry)), request_(std::move(request)), threads_(threads) {
    Diagnostics diagnostics;
    SceneDraft draft = valid_draft(request_, registry_->registry(), diagnostics);
    auto compiled = build(draft, registry_->registry(), diagnostics, threads_);
    if (!compiled) throw InvalidInput(InvalidInput::What::scene, diagnostics);
    scene_ = std::move(draft.scene);
    compiled_ = *std::move(compiled);
    warnings_ = problems_of(diagnostics);
}

void add_scene(py::module_& module) {
    using Unlocked = py::call_guard<py::gil_scoped_release>;
    py::class_<ReadScene, std::shared_ptr<ReadScene>>(module, "Scene",
                                                      "A scene, read and checked; immutable.")
        .def_static("load", &loaded, py::arg("registry"), py::arg("files"), py::arg("settings"),
                    py::arg("shading"), py::arg("reflection"), py::arg("frame"), py::arg("defaults"),
                    py::arg("threads"), Unlocked())
        .def_static("parse", &parsed, py::arg("registry"), py::arg("text"), py::arg("name"),
                    py::arg("settings"), py::arg("shading"), py::arg("reflection"), py::arg("frame"),
                    py::arg("defaults"), py::arg("threads"), Unlocked())
        .def("changed", &changed, py::arg("settings"), Unlocked())
        .def("frame", &frame_of, py::arg("frame"), Unlocked())
        .def("render", &rendered, py::arg("floats"))
        .def(
            "text", [](const ReadScene& scene) { return scene_text(scene.scene()); }, Unlocked())
        .def_property_readonly("width", [](const ReadScene& scene) { return scene.compiled().image.width; })
        .def_property_readonly("height", [](const ReadScene& scene) { return scene.compiled().image.height; })
        .def_property_readonly("frame_count", &frame_count)
        .def_property_readonly("labels", &labels_of)
        .def_property_readonly("is_srgb",
                               [](const ReadScene& scene) {
                                   return scene.compiled().image.color_management == ColorEncoding::srgb;
                               })
        .def_property_readonly("warnings", &ReadScene::warnings);
    module.def("document_text", &document_text, py::arg("scene"),
               "A dictionary as the text of a scene file.");
    module.def(
        "value_text", [](py::handle value) { return toml_text(node_of(value, "")); }, py::arg("value"),
        "A value as written in a scene file.");
}

}  // namespace candela::python
