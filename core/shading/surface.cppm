module;

#include "candela/plugin/export.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

export module candela.shading:surface;

import :environment_map;
import :radiance_map;
import :texture;
import candela.api;
import candela.geometry;
import candela.plugins;
import candela.raster;
import candela.scene;

export namespace candela {

/// A light as data.
struct LightData {
    std::vector<PunctualLight> samples;
    Rgb ambient{};
};

/// A light, and the plugin it comes from. See render_light().
struct RenderLight {
    std::string plugin;
    std::unique_ptr<Light> light;
    bool has_ambient = false;
    std::optional<LightData> data{};  // empty: only the light itself knows
    const SkySource* sky = nullptr;   // the light itself, if it can be seen
    /// The map that surfaces mirror, if there are such surfaces; see find_radiance().
    std::shared_ptr<const RadianceMap> radiance{};
    // Effective in a LightingContext with an OcclusionTree.
    bool casts_shadows = true;
    AmbientOcclusion ambient_occlusion{};

    /// Whether a sample is more than a point, so that its light has penumbras.
    CANDELA_EXPORT bool has_extent() const;
    /// Finds what surfaces mirror of it, unless that is known or it cannot be seen. Throws Error, naming the
    /// plugin.
    CANDELA_EXPORT void find_radiance();
};

/// Creates the light, and asks it once whether it is data. Throws Error, naming the plugin.
CANDELA_EXPORT RenderLight render_light(Registry& registry, const Model& model, ColorEncoding encoding);

/// The appearance of an object's surface.
struct CANDELA_EXPORT SurfaceModels {
    Rgb color;
    MaterialTextures material_textures{};
    Rgb emission{};       // added to the light that the points reflect; multiplies its texture, if it has one
    float occlusion = 1;  // multiplies what they reflect of ambient light, where no texture does
    float opacity = 1;    // of all points, where no texture gives it
    float opacity_cutoff = 0;             // above 0: points with less are absent, the others opaque
    MaterialTextures opacity_textures{};  // its factors, or none
    bool has_channels = false;            // these textures need channels of the vertices
    std::string shading_plugin;
    std::unique_ptr<ShadingModel> shading;
    ShadingNeeds shading_needs{};
    std::string reflection_plugin;
    std::unique_ptr<ReflectionModel> reflection;
    SurfaceNeeds reflection_needs{};
    bool lights_below_horizon = false;  // the model reflects light that the normal faces away from
    // The extensions that `reflection` offers.
    const AllLightsReflection* all_lights_reflection = nullptr;
    const EnvironmentReflection* environment_reflection = nullptr;
    const GlossyReflection* glossy_reflection = nullptr;

    /// Create the models, and ask them once what they need and offer. Throw Error, naming the plugin.
    void set_shading(Registry& registry, const Model& model, ColorEncoding encoding);
    void set_reflection(Registry& registry, const Model& model, ColorEncoding encoding);

    bool has_textures() const { return material_textures.arrays() > 0; }
    bool has_pictures() const { return material_textures.has_pictures() || opacity_textures.has_pictures(); }

    bool emits() const { return emission != Rgb{}; }
    bool is_occluded() const {
        return occlusion != 1 || material_textures.occlusion != MaterialTextures::k_none;
    }

    bool is_see_through() const {
        return opacity_textures.arrays() > 0 || (opacity_cutoff > 0 ? opacity < opacity_cutoff : opacity < 1);
    }

    PointNeeds needs() const;
};

/// The object whose surface is shaded.
struct ShadedObject {
    const Mesh* mesh = nullptr;
    /// Of that mesh, for a transparent model; null: light that enters does not meet the object again.
    const TriangleTree* tree = nullptr;
    std::uint32_t index = 0;  // among the scene's
    bool receives_shadows = true;
};

/// A surface that light passes through: a transparent model, and the object's colour; or one that covers only
/// a part of what is behind it.
struct Transmitter {
    const EnvironmentReflection* model = nullptr;
    Rgb color{};
    const SurfaceModels* surface = nullptr;
    const Mesh* mesh = nullptr;
};

/// The lights of a scene, and the view of it.
struct LightingContext {
    std::span<const RenderLight> lights;
    /// Null: only what `lights` cause is found, without what transparent objects show of their surroundings
    /// and what surfaces emit.
    const EnvironmentMap* environment = nullptr;
    Camera camera;
    // Shadows.
    const OcclusionTree* occlusion = nullptr;  // of all objects; null: light is not blocked
    ShadowPattern pattern = ShadowPattern::varied;
    int samples = 1;                              // per pixel, which the edges of shadows are smoothed with
    std::span<const Transmitter> transmitters{};  // by object, if light passes through any
};

}  // namespace candela
