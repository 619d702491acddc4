#include <candela/target/files.h>
#include <candela/target/literals.h>
#include <candela/target_plugin.h>

#include <cstddef>
#include <cstdint>
#include <sstream>

using namespace candela;

namespace {

/// The triangles of a scene as a Wavefront OBJ, in metres. This is a starting point: write your own format
/// here.
class @TYPE@Target final : public Target {
  public:
    explicit @TYPE@Target(const sdk::NoParams&) {}

    // It needs no model's formula. The host refuses, with a message, what a target cannot express.
    TargetAbilities abilities() const noexcept override { return {.models_without_kernel = true, .surroundings = true}; }
    const char* main_file() const noexcept override { return "scene.obj"; }

    void write(const ExportedScene& scene, FileSink& files) const override {
        std::ostringstream text;
        std::size_t before = 1;  // vertices are counted from 1, across all objects
        for (std::size_t o = 0; o < scene.objects.size(); ++o) {
            const ExportedMesh mesh = scene.geometry->in_world_space(o);
            text << "o " << target::ascii_identifier(scene.objects[o].label) << '\n';
            for (std::size_t v = 0; v < mesh.vertex_count; ++v) {
                const Vec3 p = mesh.position[v];
                text << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
            }
            for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
                text << 'f';
                for (const std::uint32_t vertex : mesh.indices.subspan(t, 3)) text << ' ' << before + vertex;
                text << '\n';
            }
            before += mesh.vertex_count;
        }
        target::write(files, main_file(), text.str());
    }
};

}  // namespace

CANDELA_PLUGIN(target, @TYPE@Target, sdk::k_no_fields, {.title = "@TITLE@", .summary = "One sentence about it."})
