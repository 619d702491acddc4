// One picture.
module;

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

module candela.render;

import candela.diagnostics;
import candela.film;
import candela.mesh;
import candela.parallel;
import candela.raster;
import candela.scene;

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
    explicit SeenScene(const CompiledScene& scene, const Film& film, int tile_size_)
        : observer(scene.observer),
          width(film.width()),
          height(film.height()),
          samples(scene.image.samples),
          tile_size(tile_size_) {
        for (const SolidObject& object : scene.objects)
            meshes.push_back(
                {object.mesh.position.x.data(), object.mesh.corners.data(), object.mesh.corners.size()});
    }

    struct MeshPlace {
        const float* position;
        const std::uint32_t* corners;
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
    TileWorker(const CompiledScene& scene, const ProjectedScene& projected)
        : viewer(projected), shader(scene, projected) {}
    TileViewer viewer;
    TileShader shader;
    SeenTile seen;
};

/// What is kept of a picture.
struct KeptTiles {
    ProjectedScene projected;
    std::vector<SeenTile> tiles;
    bool is_whole = false;
};

ProjectedScene projected_scene(const CompiledScene& scene, const Film& film, int tile_size) {
    std::vector<const Mesh*> meshes;
    for (const SolidObject& object : scene.objects) meshes.push_back(&object.mesh);
    try {
        return project(meshes, camera_of(scene.observer, film.width(), film.height()), tile_size,
                       scene.image.samples);
    } catch (const std::length_error& problem) {
        throw Error(ExitCode::failure, problem.what());
    }
}

/// The stages from projection on. `kept`: what is seen already, or is to be kept; null: neither.
RenderStatistics render_stages(const CompiledScene& scene, Film& film, const RenderOptions& options,
                               int tile_size, KeptTiles* kept) {
    RenderStatistics statistics;
    with_threads(options.threads, [&] {
        const auto begin = Clock::now();
        ProjectedScene of_this_picture;
        const bool is_seen = kept != nullptr && kept->is_whole;
        ProjectedScene& projected = kept != nullptr ? kept->projected : of_this_picture;
        if (!is_seen) projected = projected_scene(scene, film, tile_size);
        const auto tiles = static_cast<std::size_t>(projected.tile_count());
        if (kept != nullptr) kept->tiles.resize(tiles);
        statistics.seconds_projecting = seconds_since(begin);
        statistics.triangles = projected.first_triangle.back();

        const auto tiles_begin = Clock::now();
        Pool<TileWorker> workers;
        std::atomic<std::size_t> tiles_done{0};
        const std::size_t grain = std::clamp<std::size_t>(tiles / 64, 1, 4);
        parallel_for(tiles, grain, [&](std::size_t first, std::size_t last) {
            const auto make = [&] { return std::make_unique<TileWorker>(scene, projected); };
            workers.with(make, [&](TileWorker& worker) {
                for (std::size_t tile = first; tile < last; ++tile) {
                    SeenTile& seen = kept != nullptr ? kept->tiles[tile] : worker.seen;
                    if (!is_seen) worker.viewer.look(static_cast<int>(tile), seen);
                    worker.shader.run(seen, film);
                    if (options.progress) options.progress(++tiles_done, tiles);
                }
            });
        });
        workers.each([&](const TileWorker& worker) {
            statistics.pixels_shaded += worker.shader.pixels_shaded();
            statistics.points_lit += worker.shader.points_lit();
            statistics.brightest = std::max(statistics.brightest, worker.shader.brightest());
        });
        statistics.seconds_on_tiles = seconds_since(tiles_begin);
    });
    return statistics;
}

int tile_size_of(const CompiledScene& scene, const RenderOptions& options) {
    return options.tile_size > 0 ? options.tile_size : tile_size_for(scene.image.samples);
}

}  // namespace

RenderStatistics render(const CompiledScene& scene, Film& film, const RenderOptions& options) {
    return render_stages(scene, film, options, tile_size_of(scene, options), nullptr);
}

struct Visibility::Kept {
    SeenScene seen;
    KeptTiles tiles{};
};

Visibility::Visibility() = default;
Visibility::Visibility(Visibility&&) noexcept = default;
Visibility& Visibility::operator=(Visibility&&) noexcept = default;
Visibility::~Visibility() = default;

void Visibility::clear() noexcept { kept_.reset(); }

RenderStatistics Visibility::render(const CompiledScene& scene, Film& film, const RenderOptions& options) {
    const int tile_size = tile_size_of(scene, options);
    SeenScene seen(scene, film, tile_size);
    // What was begun and not ended, because something threw, is no use.
    if (kept_ == nullptr || !kept_->tiles.is_whole || !(kept_->seen == seen))
        kept_ = std::make_unique<Kept>(Kept{.seen = std::move(seen)});
    const RenderStatistics statistics = render_stages(scene, film, options, tile_size, &kept_->tiles);
    kept_->tiles.is_whole = true;
    return statistics;
}

}  // namespace candela
