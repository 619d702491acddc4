// Shading of surface points: normals from the shading plugin, light from the light plugins, reflected light
// from the reflection plugin.
module;

#include "candela/api.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <vector>

export module candela.shade;

import candela.color;
import candela.environment;
import candela.fragments;
import candela.geometry;
import candela.light;
import candela.math;
import candela.mesh;
import candela.raster;
import candela.reflection;
import candela.shading;

export namespace candela {

/// A light, and the plugin it comes from.
struct LitSource {
    std::string plugin;
    std::unique_ptr<Light> light;
};

/// The look of an object's surface.
struct SurfaceModels {
    Rgb color;
    std::string shading_plugin;
    std::unique_ptr<ShadingModel> shading;
    std::string reflection_plugin;
    std::unique_ptr<ReflectionModel> reflection;

    PointNeeds needs() const;
};

/// The inside of an object, for a transparent model.
struct Interior {
    const Mesh* mesh = nullptr;
    const TriangleTree* tree =
        nullptr;  // of that mesh; null: light that enters does not meet the object again
};

class ObjectSurroundings;

/// The lights of a scene, and the view of it.
struct LitScene {
    std::span<const LitSource> lights;
    const Environment* environment = nullptr;
    Camera camera;
};

/// Evaluates light, batch by batch. Owns the batch's arrays: use one per thread.
class CANDELA_API Lighting {
  public:
    Lighting();
    ~Lighting();

    /// Sets the scene for the following calls.
    void begin(const LitScene& scene);

    /// Writes the intensity that `points` send to the observer, I_a + the sum of I_d + I_s over the lights
    /// (CA DD6), into arrays with room for `points.filled`. Returns the largest intensity. Throws Error,
    /// naming the plugin, if one throws, yields a non-finite number, or writes beyond its batch.
    float light(const SurfaceModels& surface, const Interior& interior, const SurfacePoints& points,
                const Vec3Span& intensity);

  private:
    /// Checks the results of each plugin right after its turn, instead of once at the end.
    enum class Scrutiny : bool { none, each_step };
    void add_up(const SurfaceModels& surface, const Interior& interior, const SurfacePoints& points,
                Scrutiny scrutiny);
    void find_normals(const SurfaceModels& surface, const SurfacePoints& points);
    std::array<Vec3Arrays*, 7> written_by_plugins();
    void mark_ends();
    bool are_ends_intact();
    void require_sound(PluginKind kind, const std::string& plugin, std::size_t count,
                       std::initializer_list<const Vec3Arrays*> results);

    LitScene scene_;
    std::unique_ptr<ObjectSurroundings> surroundings_;  // created when a model asks
    Vec3Arrays normal_, to_observer_, tangent_;
    Vec3Arrays to_light_, light_diffuse_, light_specular_;
    Vec3Arrays ambient_, diffuse_, specular_;
};

}  // namespace candela

namespace candela {

/// The normals from an object's shading model, on the side from which triangles are seen from the front.
void shading_normals(const SurfaceModels& surface, const SurfacePoints& points, const Vec3Span& normal);

/// What the models of one object see of the world around it.
class ObjectSurroundings final : public Surroundings {
  public:
    explicit ObjectSurroundings(const Environment& environment) : environment_(environment) {}

    /// Sets the object for the following calls.
    void set_object(const SurfaceModels& surface, const Interior& interior) {
        surface_ = &surface;
        interior_ = interior;
    }

    void look(std::size_t count, const ConstVec3Span& towards, const Vec3Span& intensity) override;
    void leave(std::size_t count, const ConstVec3Span& origin, const ConstVec3Span& direction,
               const ExitBatch& exit) override;

  private:
    void leave_batch(std::size_t count, const ConstVec3Span& origin, const ConstVec3Span& direction,
                     const ExitBatch& exit);

    const Environment& environment_;
    const SurfaceModels* surface_ = nullptr;
    Interior interior_;
    SurfacePoints points_;  // where rays left
    Vec3Arrays barycentric_, normal_;
    std::vector<std::uint32_t> triangles_, rays_;
};

}  // namespace candela
