// Explains pixels, and provides the terms of a picture.
#include "binding.h"

#include "aov/terms.h"
#include "images.h"
#include "inspect/explanation.h"
#include "module.h"
#include "scene.h"

namespace candela::python {

namespace {

/// Explains pixels of a scene and compiles its kernels once. Any thread, one pixel at a time.
class SceneExplainer {
  public:
    explicit SceneExplainer(ScenePointer scene)
        : scene_(std::move(scene)),
          kernels_(plugins_explained_in(scene_->scene(), scene_->registry()->registry()), {}) {}

    /// As JSON, and as text.
    std::pair<std::string, std::string> explain(int x, int y) {
        const ImageSettings& image = scene_->compiled().image;
        if (x < 0 || y < 0 || x >= image.width || y >= image.height)
            throw py::index_error(fmt::format("the pixel is {}, {}; expected 0, 0 to {}, {}", x, y,
                                              image.width - 1, image.height - 1));
        const std::lock_guard lock(mutex_);
        const Explanation explanation(scene_->scene(), scene_->compiled(), scene_->registry()->registry(), x,
                                      y, kernels_);
        return {explanation_json(explanation, JsonLayout::one_line), explanation_text(explanation)};
    }

  private:
    ScenePointer scene_;
    std::mutex mutex_;
    KernelRunner kernels_;
};

/// The named terms, or all of them.
py::dict terms_of(const ReadScene& scene, const std::vector<std::string>& names) {
    std::vector<NamedTerm> terms;
    std::vector<Film> films;
    {
        const py::gil_scoped_release unlocked;
        terms = terms_from(names, scene.scene(), "terms");
        TermRenderer renderer(scene.compiled(), scene.threads());
        for (const NamedTerm& term : terms) films.push_back(renderer.values(term));
    }
    py::dict all;
    for (std::size_t i = 0; i < terms.size(); ++i)
        all[py::str(terms[i].name)] = array_of(std::move(films[i]), channel_count(terms[i]));
    return all;
}

}  // namespace

void add_explaining(py::module_& module) {
    using Unlocked = py::call_guard<py::gil_scoped_release>;
    py::class_<SceneExplainer>(module, "Explainer", "Explains pixels of a scene.")
        .def(py::init([](std::shared_ptr<ReadScene> scene) {
                 return std::make_unique<SceneExplainer>(std::move(scene));
             }),
             py::arg("scene"), Unlocked())
        .def("explain", &SceneExplainer::explain, py::arg("x"), py::arg("y"), Unlocked());
    module.def("terms", &terms_of, py::arg("scene"), py::arg("names"), "Arrays by the names of terms.");
}

}  // namespace candela::python
