// Light on points of a surface: normals from the shading plugin, light from the light plugins, colour from
// the reflection plugin.
module;

#include "candela/api.h"

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
    /// DD6). Throws Error where a plugin throws.
    void light(const SurfaceModels& surface, const SurfacePoints& points, const Vec3Span& intensity);

  private:
    void find_normals(const SurfaceModels& surface, const SurfacePoints& points);

    std::span<const LitSource> lights_;
    Camera camera_;
    Vec3Arrays normal_, to_observer_, tangent_;
    Vec3Arrays to_light_, light_diffuse_, light_specular_;
    Vec3Arrays ambient_, diffuse_, specular_;
};

}  // namespace candela
