// Renders one scene repeatedly, with changes between the pictures.

#include "images.h"
#include "module.h"
#include "scene.h"

import candela.api;
import candela.render;
import candela.util;

namespace candela::python {

namespace {

/// Keeps what a change does not affect: triangles and visibility. Any thread, one at a time.
class KeepingRenderer {
  public:
    KeepingRenderer(const ReadScene& scene, int threads)
        : registry_(scene.registry()),
          request_(scene.request()),
          threads_(threads),
          builder_(registry_->registry()) {
        build(request_);
    }

    void set(const Settings& settings) {
        const std::lock_guard lock(mutex_);
        SceneRequest changed = with_settings(request_, settings);
        build(changed);
        request_ = std::move(changed);
    }

    Film render(bool floats) {
        const std::lock_guard lock(mutex_);
        if (compiled_ == nullptr) build(request_);  // the latest change was rejected
        const ImageSettings& image = compiled_->image;
        Film film(image.width, image.height, floats ? PixelType::real : PixelType::byte,
                  display_of(*compiled_));
        renderer_.render(*compiled_, film, {.threads = threads_});
        return film;
    }

    std::vector<Problem> warnings() {
        const std::lock_guard lock(mutex_);
        return warnings_;
    }

  private:
    void build(const SceneRequest& request) {
        Diagnostics diagnostics;
        const SceneDraft draft = valid_draft(request, registry_->registry(), diagnostics);
        // Invalidates what it returned before.
        compiled_ = nullptr;
        const RenderScene* const compiled = builder_.build(draft, diagnostics, threads_);
        if (compiled == nullptr || !builder_.has_kept_triangles()) renderer_.forget();
        if (compiled == nullptr) throw InvalidInput(InvalidInput::What::scene, diagnostics);
        compiled_ = compiled;
        warnings_ = problems_of(diagnostics);
    }

    std::mutex mutex_;
    RegistryPointer registry_;
    SceneRequest request_;
    int threads_;
    FrameBuilder builder_;
    candela::Renderer renderer_{candela::Renderer::Keep::visibility};
    const RenderScene* compiled_ = nullptr;
    std::vector<Problem> warnings_;
};

py::array rendered(KeepingRenderer& renderer, bool floats) {
    std::optional<Film> film;
    {
        const py::gil_scoped_release unlocked;
        film.emplace(renderer.render(floats));
    }
    return array_of(*std::move(film));
}

}  // namespace

void add_renderer(py::module_& module) {
    using Unlocked = py::call_guard<py::gil_scoped_release>;
    py::class_<KeepingRenderer>(module, "Renderer", "Renders a scene again and again.")
        .def(py::init<const ReadScene&, int>(), py::arg("scene"), py::arg("threads"), Unlocked())
        .def("set", &KeepingRenderer::set, py::arg("settings"), Unlocked())
        .def("render", &rendered, py::arg("floats"))
        .def_property_readonly("warnings", &KeepingRenderer::warnings, Unlocked());
}

}  // namespace candela::python
