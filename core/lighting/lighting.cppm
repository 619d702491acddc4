// Light on points of a surface: normals from the shading plugin, light from the light plugins, colour from
// the reflection plugin.
module;

#include "candela/api.h"

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <vector>

export module candela.lighting;

import candela.fragments;
import candela.light;
import candela.math;
import candela.mesh;
import candela.raster;
import candela.reflection;
import candela.shading;

export namespace candela {

/// A light that shines, and the plugin that it comes from.
struct LitSource {
    std::string plugin;
    std::unique_ptr<Light> light;
};

/// How an object's surface looks.
struct SurfaceModels {
    Rgb color;
    std::string shading_plugin;
    std::unique_ptr<ShadingModel> shading;
    std::string reflection_plugin;
    std::unique_ptr<ReflectionModel> reflection;

    PointNeeds needs() const;
};

/// Evaluates light, batch by batch. Holds the batch's arrays: one for each thread.
class CANDELA_API Lighting {
  public:
    Lighting(std::span<const LitSource> lights, const Camera& camera);

    /// Writes the intensity that `points` send to the observer: I_a + sum of I_d + I_s over the lights (CA
    /// DD6). Returns the largest of them. Throws Error, naming the plugin, where one throws, gives what is no
    /// finite number, or writes beyond its batch.
    float light(const SurfaceModels& surface, const SurfacePoints& points, const Vec3Span& intensity);

  private:
    /// Looks at what each plugin gave right after its turn, instead of once at the end.
    enum class Scrutiny : bool { none, each_step };
    void add_up(const SurfaceModels& surface, const SurfacePoints& points, Scrutiny scrutiny);
    void find_normals(const SurfaceModels& surface, const SurfacePoints& points);
    std::vector<Vec3Arrays*> written_by_plugins();
    void mark_ends();
    bool are_ends_intact();
    void require_sound(PluginKind kind, const std::string& plugin, std::size_t count,
                       std::initializer_list<const Vec3Arrays*> results);

    std::span<const LitSource> lights_;
    Camera camera_;
    Vec3Arrays normal_, to_observer_, tangent_;
    Vec3Arrays to_light_, light_diffuse_, light_specular_;
    Vec3Arrays ambient_, diffuse_, specular_;
};

}  // namespace candela
