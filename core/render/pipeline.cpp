// One picture.
module;

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

module candela.render;

import candela.diagnostics;
import candela.film;
import candela.mesh;
import candela.parallel;
import candela.pool;
import candela.raster;
import candela.scene;
import candela.transform;

namespace candela {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// All samples of a tile's visibility should fit the second-level cache.
int tile_size_for(int samples) { return samples <= 4 ? 64 : 32; }

}  // namespace

Camera camera_of(const Observer& observer, int width, int height) {
    const bool perspective = observer.projection == Projection::perspective;
    return Camera::looking(observer.position, observer.look_at, observer.up, observer.projection,
                           perspective ? observer.fov : observer.height, width, height);
}

namespace {

/// A scene as far as what is seen of it depends on it.
struct SeenScene {
    explicit SeenScene(const CompiledScene& scene, const Film& film, int size_of_tiles)
        : observer(scene.observer),
          width(film.width()),
          height(film.height()),
          samples(scene.image.samples),
          tile_size(size_of_tiles) {
        for (const SolidObject& object : scene.objects)
            meshes.push_back(
                {object.mesh.position.x.data(), object.mesh.indices.data(), object.mesh.indices.size()});
    }

    struct MeshPlace {
        const float* position;
        const std::uint32_t* indices;
        std::size_t corner_count;
        friend bool operator==(const MeshPlace&, const MeshPlace&) = default;
    };

    Observer observer;
    int width, height, samples, tile_size;
    std::vector<MeshPlace> meshes;

    friend bool operator==(const SeenScene&, const SeenScene&) = default;
};

/// What a thread needs to work on a tile.
struct TileWorker {
    TileViewer viewer;
    TileShader shader;
    SeenTile seen;
};

int tile_size_of(const CompiledScene& scene, const RenderOptions& options) {
    return options.tile_size > 0 ? options.tile_size : tile_size_for(scene.image.samples);
}

/// What one thread takes for a picture, if all of it is to be lit: what a point in one light and a triangle
/// take on the processors of 2020.
double rough_milliseconds(const CompiledScene& scene, const Film& film) {
    double triangles = 0;
    for (const SolidObject& object : scene.objects)
        triangles += static_cast<double>(object.mesh.triangle_count());
    const double points = 1.0 * film.width() * film.height() * scene.image.samples;
    return 5e-6 * points * static_cast<double>(std::max<std::size_t>(scene.lights.size(), 1)) +
           2e-5 * triangles;
}
/// Many pictures are worth more threads, however small each is.
constexpr double k_again_and_again = std::numeric_limits<double>::infinity();

void project_scene(const CompiledScene& scene, const Film& film, int tile_size, ProjectedScene& projected) {
    std::vector<const Mesh*> meshes;
    for (const SolidObject& object : scene.objects) meshes.push_back(&object.mesh);
    try {
        project(meshes, camera_of(scene.observer, film.width(), film.height()), tile_size,
                scene.image.samples, projected);
    } catch (const std::length_error& problem) {
        throw Error(ErrorCategory::failure, problem.what());
    }
}

}  // namespace

struct Renderer::Kept {
    explicit Kept(Keep keep) : what(keep) {}

    Keep what;
    ProjectedScene projected;
    Pool<TileWorker> workers;
    std::vector<SeenTile> tiles;    // where visibility is kept
    std::optional<SeenScene> seen;  // what the tiles are of, once they are whole
    bool is_first = true;           // picture

    /// The stages from projection on, or from light on.
    RenderStatistics render(const CompiledScene& scene, Film& film, const RenderOptions& options,
                            bool is_seen) {
        RenderStatistics statistics;
        const auto begin = Clock::now();
        if (!is_seen) project_scene(scene, film, tile_size_of(scene, options), projected);
        const auto tile_count = static_cast<std::size_t>(projected.tile_count());
        if (what == Keep::visibility) tiles.resize(tile_count);
        statistics.seconds_projecting = seconds_since(begin);
        statistics.triangles = projected.first_triangle.back();

        const auto tiles_begin = Clock::now();
        workers.each([&](TileWorker& worker) { worker.shader.begin(scene, projected); });
        const auto make = [&] {
            auto worker = std::make_unique<TileWorker>();
            worker->shader.begin(scene, projected);
            return worker;
        };
        std::atomic<std::size_t> tiles_done{0};
        const std::size_t grain = std::clamp<std::size_t>(tile_count / 64, 1, 4);
        parallel_for(tile_count, grain, [&](std::size_t first, std::size_t last) {
            workers.with(make, [&](TileWorker& worker) {
                for (std::size_t tile = first; tile < last; ++tile) {
                    SeenTile& seen_tile = what == Keep::visibility ? tiles[tile] : worker.seen;
                    if (!is_seen) worker.viewer.look(projected, static_cast<int>(tile), seen_tile);
                    worker.shader.run(seen_tile, film);
                    if (options.progress) options.progress(++tiles_done, tile_count);
                }
            });
        });
        workers.each([&](const TileWorker& worker) {
            statistics.pixels_shaded += worker.shader.pixels_shaded();
            statistics.points_lit += worker.shader.points_lit();
            statistics.brightest = std::max(statistics.brightest, worker.shader.brightest());
        });
        statistics.seconds_on_tiles = seconds_since(tiles_begin);
        return statistics;
    }
};

Renderer::Renderer(Keep keep) : kept_(std::make_unique<Kept>(keep)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

void Renderer::forget() noexcept { kept_->seen.reset(); }

RenderStatistics Renderer::render(const CompiledScene& scene, Film& film, const RenderOptions& options) {
    SeenScene to_see(scene, film, tile_size_of(scene, options));
    const bool is_seen = kept_->what == Keep::visibility && kept_->seen == to_see;
    // Until the tiles are whole, they are of nothing: something may throw.
    if (!is_seen) kept_->seen.reset();
    RenderStatistics statistics;
    with_threads(
        options.threads, [&] { statistics = kept_->render(scene, film, options, is_seen); },
        std::exchange(kept_->is_first, false) ? rough_milliseconds(scene, film) : k_again_and_again);
    if (!is_seen) kept_->seen = std::move(to_see);
    return statistics;
}

RenderStatistics render(const CompiledScene& scene, Film& film, const RenderOptions& options) {
    return Renderer().render(scene, film, options);
}

}  // namespace candela
