#include "candela/embedding.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

import candela.api;
import candela.plugins;
import candela.render;
import candela.scene;
import candela.util;

namespace candela::embedding {

namespace {

std::vector<Problem> problems_of(const Diagnostics& diagnostics) {
    std::vector<Problem> problems;
    for (Diagnostic& found : diagnostics.sorted()) {
        problems.push_back({.is_error = found.severity == Severity::error,
                            .file = std::move(found.place.file),
                            .line = found.place.line,
                            .column = found.place.column,
                            .message = std::move(found.message),
                            .hint = std::move(found.hint)});
    }
    return problems;
}

std::string text_of(const std::vector<Problem>& problems) {
    std::string text;
    for (const Problem& problem : problems) {
        if (!text.empty()) text += '\n';
        if (!problem.file.empty()) {
            text += problem.file;
            if (problem.line > 0) text += fmt::format(":{}:{}", problem.line, problem.column);
            text += ": ";
        }
        text += fmt::format("{}: {}", problem.is_error ? "error" : "warning", problem.message);
        if (!problem.hint.empty()) text += fmt::format(" ({})", problem.hint);
    }
    return text;
}

Problem warning_of(const Refusal& refusal) {
    return {.is_error = false,
            .file = refusal.file.string(),
            .message = refusal.reason,
            .hint = fmt::format("using '{}' instead", refusal.used_instead.string())};
}

/// Calls a function, and translates the core's exceptions to those that this interface documents.
template <typename Function>
auto translated(const Function& function) {
    try {
        return function();
    } catch (const candela::Error& problem) {
        throw Error(problem.what());
    }
}

}  // namespace

Error::Error(const std::string& message, std::vector<Problem> problems)
    : std::runtime_error(message), problems_(std::move(problems)) {}
Error::~Error() = default;

struct Scene::Parts {
    Parts(SceneRequest wanted, Options given)
        : options(std::move(given)),
          registry(plugin_search_path(options.plugin_folders), PluginTrust::own_and_system,
                   options.plugin_folders.size(),
                   [this](const Refusal& refusal) { replaced.push_back(warning_of(refusal)); }),
          request(std::move(wanted)),
          renderer(candela::Renderer::Keep::visibility) {
        build(request);
    }

    /// Keeps the previous scene if the new one has errors.
    void build(const SceneRequest& wanted) {
        Diagnostics diagnostics;
        const auto draft = draft_scene(wanted, registry, diagnostics);
        auto compiled = draft ? candela::build(*draft, registry, diagnostics, options.threads) : std::nullopt;
        std::vector<Problem> problems = problems_of(diagnostics);
        if (!compiled) {
            const std::string text = text_of(problems);
            throw Error(text, std::move(problems));
        }
        // Triangles of another compilation differ, even at the same address.
        renderer.forget();
        scene = std::move(compiled);
        warnings = std::move(problems);
        warnings.insert(warnings.end(), replaced.begin(), replaced.end());
    }

    template <typename Image, typename Value>
    Image render(PixelType pixels, std::span<const Value> ImageView::* values) {
        const ImageSettings& image = scene->image;
        Film film(image.width, image.height, pixels, display_of(*scene));
        renderer.render(*scene, film, {.threads = options.threads, .progress = options.progress});
        const ImageView view = film.view();
        const std::span<const Value> all = view.*values;
        return {.width = film.width(), .height = film.height(), .rgb = {all.begin(), all.end()}};
    }

    Options options;
    std::vector<Problem> replaced;  // plugins, which the registry reports once
    Registry registry;              // outlives what its plugins created
    SceneRequest request;
    std::optional<RenderScene> scene;
    std::vector<Problem> warnings;
    candela::Renderer renderer;
};

Scene::Scene(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Scene::Scene(const std::vector<std::filesystem::path>& files, Options options)
    : parts_(translated([&] {
          SceneRequest request;
          request.files = files;
          return std::make_unique<Parts>(std::move(request), std::move(options));
      })) {}

Scene Scene::from_text(std::string text, std::string_view name, Options options) {
    return translated([&] {
        SceneRequest request;
        request.files.emplace_back(name);
        request.streams.emplace(name, std::move(text));
        return Scene(std::make_unique<Parts>(std::move(request), std::move(options)));
    });
}

Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

void Scene::set(std::string_view path, std::string_view value) {
    translated([&] {
        SceneRequest changed = parts_->request;
        std::erase_if(changed.settings, [&](const Setting& setting) { return setting.path == path; });
        changed.settings.push_back({fmt::format("set {}", path), std::string(path), std::string(value)});
        parts_->build(changed);
        parts_->request = std::move(changed);
    });
}

const std::vector<Problem>& Scene::warnings() const noexcept { return parts_->warnings; }
int Scene::width() const noexcept { return parts_->scene->image.width; }
int Scene::height() const noexcept { return parts_->scene->image.height; }

ByteImage Scene::render() {
    return translated([&] { return parts_->render<ByteImage>(PixelType::byte, &ImageView::bytes); });
}

FloatImage Scene::render_floats() {
    return translated([&] { return parts_->render<FloatImage>(PixelType::real, &ImageView::reals); });
}

}  // namespace candela::embedding
