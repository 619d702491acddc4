// Shading of surface points: normals from the shading plugin, light from the light plugins, reflected light
// from the reflection plugin.
module;

#include "candela/plugin/export.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

export module candela.shading:surface_shader;

export import :surface;
export import :term;
export import :trace;
import candela.api;
import candela.raster;
import candela.util;

namespace candela {
class ObjectEnvironment;
class LightVisibility;
struct LightSample;
}  // namespace candela

export namespace candela {

/// Multiplies the points' colours by the surface's texture, and evaluates the textures of its material, if it
/// has any. The points must have been gathered with what the surface needs.
CANDELA_EXPORT void apply_textures(const SurfaceModels& surface, SurfacePoints& points);

/// Writes the fraction of what is behind that the surface covers at each of `points`: 0 or 1 with a cutoff.
/// The points must have been gathered with k_opacity_needs. Their `parameters` are overwritten.
CANDELA_EXPORT void find_opacity(const SurfaceModels& surface, SurfacePoints& points, float* opacity);
/// The same at all points, if no texture gives it.
CANDELA_EXPORT std::optional<float> uniform_opacity(const SurfaceModels& surface);
inline constexpr PointNeeds k_opacity_needs{.position = false,
                                            .face_normal = false,
                                            .vertex_normal = false,
                                            .barycentric = false,
                                            .color = false,
                                            .uv = true,
                                            .footprint = true,
                                            .channels = true};

/// Evaluates light, batch by batch. Owns the batch's arrays: use one per thread.
class CANDELA_EXPORT SurfaceShader {
  public:
    SurfaceShader();
    ~SurfaceShader();

    /// Sets the scene for the following calls.
    void begin(const LightingContext& scene);

    /// Writes the intensity that `points` send to the observer, I_a + the sum of I_d + I_s over the lights
    /// (CA DD6), into arrays with room for `points.filled`. Returns the largest intensity. Throws Error,
    /// naming the plugin, if one throws, yields a non-finite number, or writes past the end of its batch.
    float shade(const SurfaceModels& surface, const ShadedObject& object, const SurfacePoints& points,
                const Vec3Span& intensity);

    /// Shades the single point of `points` and records the steps: `intensity` and the three sums are those of
    /// shade(). Throws Error like shade().
    PointTrace trace(const SurfaceModels& surface, const ShadedObject& object, const SurfacePoints& points);

    /// Writes a non-geometric term of the intensity, or one of its inputs, instead of the intensity. Slower
    /// than shade(), which it calls. Throws Error like shade().
    void find_term(Term term, const ShownParameter& parameter, const SurfaceModels& surface,
                   const ShadedObject& object, const SurfacePoints& points, const Vec3Span& values);

  private:
    /// Whether each plugin's results are checked right after its call, instead of once at the end.
    enum class Checking : bool { none, each_step };
    using Lights = std::vector<const RenderLight*>;
    /// Adds up, part by part, what the reflection model reflects of each of `lights`.
    void add_up(const SurfaceModels& surface, const ShadedObject& object, const SurfacePoints& points,
                const Lights& lights, Checking checking);
    void set_varying(const SurfaceModels& surface, const SurfacePoints& points);
    void find_tangents(const SurfaceModels& surface, const SurfacePoints& points, std::size_t count);
    /// Writes to `reflected_` what the reflection model reflects of all lights that are data. Returns false
    /// if there are no such lights or the model does not evaluate them at once.
    bool reflect_all_lights(const SurfaceModels& surface, const SurfacePoints& points);
    struct LightsAtOnce;
    LightsAtOnce lights_at_once(bool is_glossy) const;
    /// Those that `surface` reflects all at once, and those that remain.
    const LightsAtOnce& at_once(const SurfaceModels& surface) const;
    bool mirrors(const SurfaceModels& surface, const RenderLight& source) const;
    /// Writes the widths of highlights.
    void find_widths(const SurfaceModels& surface, const SurfaceBatch& batch);
    /// Leaves to light_specular_ what a sample of a light causes itself, and its mirror image does not.
    void share_with_mirror(const RenderLight& source, std::size_t count);
    /// Adds the mirror image of a light to `reflected`.
    void add_mirrored(const RenderLight& source, const SurfaceModels& surface, const SurfacePoints& points,
                      const SurfaceBatch& batch, const ReflectedBatch& reflected);
    void find_n_dot_l(const SurfacePoints& points, const Vec3Span& values);
    void find_visibility(const SurfacePoints& points, const Vec3Span& values);
    void find_ambient_visibility(const SurfacePoints& points, const Vec3Span& values);
    /// Writes what a sample of a light sends to `count` points to to_light_, light_diffuse_ and
    /// light_specular_. Returns it as rays to trace, if objects may block it.
    std::optional<LightSample> illuminate(const RenderLight& source, int sample, const SurfacePoints& points,
                                          std::size_t count);
    /// Multiplies those intensities by the fractions that are not blocked.
    void block(const LightSample& light, std::size_t count);
    /// Like these, of a light's ambient part, in light_diffuse_.
    void illuminate_ambient(const RenderLight& source, const SurfacePoints& points, std::size_t count);
    bool block_ambient(const RenderLight& source, std::size_t count);
    /// Writes a light that is data to to_light_, distance_ and attenuation_.
    LightSample light_at(const PunctualLight& light, int sample, const SurfacePoints& points);
    /// The fractions of punctual_lights_ that reach the points.
    std::span<const float* const> visibility_of_data(const LightsAtOnce& lights, const SurfacePoints& points);
    void check_steps(const SurfaceModels& surface, const ShadedObject& object, const SurfacePoints& points);
    /// The reflection model's input; the arrays are this object's and the points'.
    SurfaceBatch lit_surface(const SurfaceModels& surface, const SurfacePoints& points,
                             std::size_t count) const;
    void find_normals(const SurfaceModels& surface, const SurfacePoints& points);
    std::array<Vec3Arrays*, 8> written_by_plugins();
    void mark_ends();
    static bool are_ends_intact(std::span<Vec3Arrays* const> written);
    void require_sound(PluginKind kind, const std::string& plugin, std::size_t count,
                       std::initializer_list<const Vec3Arrays*> results);

    LightingContext scene_;
    /// Lights that are evaluated at once, and the others, one by one.
    struct LightsAtOnce {
        Lights others;
        std::vector<PunctualLight> punctual;
        std::vector<bool> is_blocked;  // whether objects may block them
        PunctualLighting lighting;     // without them
    };
    Lights lights_;
    LightsAtOnce at_once_, glossy_at_once_;            // for surfaces that mirror no light, and some
    std::vector<VaryingParameter> varying_;            // of the points' material
    std::unique_ptr<ObjectEnvironment> surroundings_;  // created when a model asks
    Vec3Arrays normal_, to_observer_, tangent_;
    Vec3Arrays to_light_, light_diffuse_, light_specular_;
    Vec3Arrays ambient_, diffuse_, specular_;
    Vec3Arrays reflected_;                         // of the lights that are data
    bool has_shadows_ = false;                     // at the current points
    std::unique_ptr<LightVisibility> visibility_;  // created for the first scene with shadows
    AlignedVector<float> distance_, attenuation_, weights_, zeros_, widths_;
    std::vector<const float*> weight_pointers_;
};

}  // namespace candela
