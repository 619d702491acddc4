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

export import :surface;
export import :term;
export import :trace;
import candela.arrays;
import candela.descriptor;
import candela.fragments;
import candela.math;
import candela.punctual;
import candela.reflection;

namespace candela {
class ObjectSurroundings;
}

export namespace candela {

/// Where the surface has a texture, multiplies the points' colours with it; they have been gathered with what
/// the surface needs.
CANDELA_API void apply_texture(const SurfaceModels& surface, SurfacePoints& points);

/// Evaluates light, batch by batch. Owns the batch's arrays: use one per thread.
class CANDELA_API SurfaceShader {
  public:
    SurfaceShader();
    ~SurfaceShader();

    /// Sets the scene for the following calls.
    void begin(const LitScene& scene);

    /// Writes the intensity that `points` send to the observer, I_a + the sum of I_d + I_s over the lights
    /// (CA DD6), into arrays with room for `points.filled`. Returns the largest intensity. Throws Error,
    /// naming the plugin, if one throws, yields a non-finite number, or writes beyond its batch.
    float shade(const SurfaceModels& surface, const Interior& interior, const SurfacePoints& points,
                const Vec3Span& intensity);

    /// Shades `points`, which is a single one, and tells the steps: `intensity` and the three sums are what
    /// shade() computes. Throws Error like shade().
    PointTrace trace(const SurfaceModels& surface, const Interior& interior, const SurfacePoints& points);

    /// Writes, instead of the intensity, a term of it that is not geometric, or what it was computed from.
    /// Slower than shade(), which it calls, so that it throws like that.
    void find_term(Term term, const SurfaceModels& surface, const Interior& interior,
                   const SurfacePoints& points, const Vec3Span& values);

  private:
    /// Checks the results of each plugin right after its turn, instead of once at the end.
    enum class Scrutiny : bool { none, each_step };
    using Lights = std::vector<const LitSource*>;
    /// Adds up what the reflection model makes of `lights`, each asked in turn, part by part.
    void add_up(const SurfaceModels& surface, const Interior& interior, const SurfacePoints& points,
                const Lights& lights, Scrutiny scrutiny);
    /// Adds the light to those that are data, or returns false if it cannot describe itself as such.
    bool describe(const LitSource& source);
    void find_tangents(const SurfaceModels& surface, const SurfacePoints& points, std::size_t count);
    /// Writes to `reflected_` what the reflection model reflects of all lights that are data. Returns false
    /// if there are no such lights or the model cannot evaluate them.
    bool reflect_punctual(const SurfaceModels& surface, const SurfacePoints& points);
    void find_n_dot_l(const SurfacePoints& points, const Vec3Span& values);
    void scrutinize(const SurfaceModels& surface, const Interior& interior, const SurfacePoints& points);
    /// What the reflection model is given; the arrays are this object's and the points'.
    SurfaceBatch lit_surface(const SurfaceModels& surface, const SurfacePoints& points,
                             std::size_t count) const;
    void find_normals(const SurfaceModels& surface, const SurfacePoints& points);
    std::array<Vec3Arrays*, 8> written_by_plugins();
    void mark_ends();
    static bool are_ends_intact(std::span<Vec3Arrays* const> written);
    void require_sound(PluginKind kind, const std::string& plugin, std::size_t count,
                       std::initializer_list<const Vec3Arrays*> results);

    LitScene scene_;
    Lights lights_, other_lights_;  // all, and those that are not data
    std::vector<PunctualLight> punctual_lights_;
    PunctualLighting lighting_;                         // refers to them
    std::unique_ptr<ObjectSurroundings> surroundings_;  // created when a model asks
    Vec3Arrays normal_, to_observer_, tangent_;
    Vec3Arrays to_light_, light_diffuse_, light_specular_;
    Vec3Arrays ambient_, diffuse_, specular_;
    Vec3Arrays reflected_;  // of the lights that are data
};

}  // namespace candela
