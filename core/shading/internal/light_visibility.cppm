// Which part of a light's intensity reaches each point of a batch: the stage between lights and reflection.
module;

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

module candela.shading:light_visibility;

import :surface;
import candela.api;
import candela.geometry;
import candela.raster;
import candela.util;

namespace candela {

/// One sample of a light at each point of a batch.
struct LightSample {
    ConstVec3Span to_light;             // unit
    const float* distance = nullptr;    // metres; infinite for a distant light
    const float* brightness = nullptr;  // zero where the light does not shine; null: it shines everywhere
    int varied = -1;                    // its number, if the light has others, whose positions vary as well
    std::uint32_t packets = ~0u;        // a bit for each sixteen points at which it may be blocked
};

/// Traces rays from the points of a batch. Owns the batch's arrays: use one per thread.
class LightVisibility {
  public:
    LightVisibility();

    /// Sets the scene for the following calls.
    void begin(const LightingContext& scene);

    /// Sets the points for the following calls; `normal` is the shading model's. Returns whether any light
    /// may be blocked there.
    bool set_points(const SurfaceModels& surface, const ShadedObject& object, const SurfacePoints& points,
                    const ConstVec3Span& normal);

    /// The packets of points at which objects may block that light, which is data: a bit for each; nothing
    /// blocks it elsewhere.
    std::uint32_t packets_to_trace(const PunctualLight& light);

    /// Writes the fraction of the light, per channel, that reaches each point; 1 where it does not shine.
    /// Valid until the next call. Where a fragment covers its pixel, the mean over the pixel's samples; a
    /// light whose samples vary is seen by one of them each. The three arrays are the same one if no light
    /// is coloured on its way.
    ConstVec3Span find(const LightSample& light);

    /// Like find(), of what comes from everywhere above the points: the mean over rays distributed by the
    /// cosine around the shading normal, of which those that meet nothing within a distance are free.
    ConstVec3Span find_ambient(const AmbientOcclusion& occlusion);

    /// The triangle that blocks the light on its way to the first point, or to a sample of its pixel.
    std::optional<Blocker> find_blocker(const LightSample& light);

    /// Where within its extent, from -1/2 to 1/2 along both edges, a light's sample is seen from each point.
    ConstVec2Span sample_offsets(int sample);

  private:
    /// Like find(), from given positions of the points.
    ConstVec3Span trace(const LightSample& light, const ConstVec3Span& position);
    void aim(const LightSample& light, const ConstVec3Span& position);
    void find_inside();
    /// Writes to position_, direction_ and distance_ the points, and the light from there, that many pixels
    /// to the right of and below the middle of their pixels.
    void move_in_pixels(const LightSample& light, float right, float below);
    /// Of some points: of the places from which rays start, and of the shading normals.
    struct Bounds {
        Box position, normal;
    };
    /// Passes on all arrays of places from which rays start, and of corners around these.
    template <class Visit>
    void each_place(Visit visit);
    void find_region();
    void find_packets();
    bool may_be_blocked(const PunctualLight& light, const Bounds& points) const;
    /// The light, and in position_ the points, from sample number `sample` of the pixels.
    LightSample from_sample(const LightSample& light, int sample);
    /// Traces from there, and adds the results to mean_.
    void add_sample(const LightSample& light, int sample);
    /// Starts rays above the surface where it is hollow, so that it blocks light that faces its normal but
    /// not its triangle: the surface rises towards the light.
    void lift_from_hollows(const LightSample& light, const ConstVec3Span& position);
    ConstVec3Span traced();
    /// Multiplies visible_ by what see-through surfaces let pass.
    void pass_through_surfaces();
    void pass_through(std::span<const Passage> passages);

    const OcclusionTree* tree_ = nullptr;
    std::span<const Transmitter> transmitters_;
    bool is_varied_ = false;
    std::span<const SamplePosition> pattern_;  // of the samples in a pixel
    Camera camera_;
    std::uint32_t object_ = 0;
    const Mesh* mesh_ = nullptr;  // of the object
    bool lights_below_horizon_ = false;
    const SurfacePoints* points_ = nullptr;
    ConstVec3Span normal_;
    std::size_t count_ = 0;  // in whole vectors

    Vec3Arrays inside_;                // of each point's triangle; filled if inward_ is not zero
    float inward_ = 0;                 // by how many margins rays start further inside
    Vec3Arrays origin_, towards_;      // of the rays
    Vec3Arrays position_, direction_;  // of a pixel's sample; directions of ambient light
    Vec3Arrays colored_, mean_, first_;
    AlignedVector<float> length_, visible_, offset_x_, offset_y_, distance_, brightness_;
    AlignedVector<std::uint32_t> flags_;
    std::vector<Crossing> crossings_;
    std::vector<Passage> passages_;
    std::unique_ptr<SurfacePoints> passed_;  // created for the first of them
    Vec3Arrays passed_at_;                   // in barycentric coordinates
    AlignedVector<float> opacity_;           // there
    static constexpr std::size_t k_packets = k_batch_size / OcclusionTree::k_packet;
    bool has_region_ = false, has_packets_ = false;  // found once asked for
    Bounds region_;                                  // of all points
    std::array<Bounds, k_packets> packets_;
};

}  // namespace candela
