module;

#include "candela/plugin/export.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

export module candela.geometry:occlusion_tree;

import :mesh;
import candela.api;

export namespace candela {

/// An object's surface, as it meets light.
struct Occluder {
    const Mesh* mesh = nullptr;  // null: light passes
    /// Closed, and nothing is inside: light is blocked where it enters. Otherwise on either side.
    bool is_solid = false;
    bool is_transparent = false;  // light passes, and the lengths of its paths inside are found
    bool is_see_through = false;  // light passes in part: the places where it does are found
};

/// Rays from points of one object's surface towards a light. Arrays have `count` elements rounded up to whole
/// packets, OcclusionTree::k_packet.
struct ShadowRays {
    std::size_t count = 0;
    ConstVec3Span origin;
    ConstVec3Span direction;
    const float* length = nullptr;  // in multiples of the direction, infinity for distant lights
    /// 0: not traced, so the light is visible. Otherwise k_traced, joined by | with the other bits.
    const std::uint32_t* flags = nullptr;
    std::uint32_t object = 0;  // the index of the occluder on whose surface they start

    static constexpr std::uint32_t k_traced = 16;
    /// The ray starts below the surface, so that it may leave the object through its back.
    static constexpr std::uint32_t k_from_below = 32;
    /// The ray starts on the inner side of the surface.
    static constexpr std::uint32_t k_from_behind = 64;
};

/// The way of a ray through a transparent object.
struct Crossing {
    std::uint32_t ray = 0;
    std::uint32_t object = 0;
    float length = 0;  // inside, in multiples of the direction
};

/// Where a ray meets a surface that blocks only a part of the light.
struct Passage {
    std::uint32_t ray = 0;
    std::uint32_t object = 0;
    std::uint32_t triangle = 0;
    Vec3 barycentric{};
};

/// The triangle that blocks a ray.
struct Blocker {
    std::uint32_t object = 0;
    std::uint32_t triangle = 0;
    float distance = 0;  // in multiples of the direction
};

/// The surfaces of a scene, for rays that ask whether light is blocked. Refers to the meshes' arrays, which
/// must neither change nor move. Immutable; any thread.
///
/// A surface does not block light that leaves its own object: where the shading normal faces a light and the
/// triangle does not, the ray passes through the inside of the object. That smooths the terminator of coarse
/// meshes without moving the rays' origins (compare Hanika 2021, "Hacking the shadow terminator"). It is for
/// the caller to let such rays start below the surface only where it bulges; where it is hollow, light would
/// leak through it.
class CANDELA_EXPORT OcclusionTree {
  public:
    static constexpr std::size_t k_packet = 16;

    /// One occluder for each of the scene's objects. Throws Error (failure) if there is too little memory, or
    /// no Embree.
    explicit OcclusionTree(std::span<const Occluder> occluders);
    OcclusionTree(OcclusionTree&&) noexcept;
    OcclusionTree& operator=(OcclusionTree&&) noexcept;
    ~OcclusionTree();

    /// How far from a surface rays must start, and how far before a light end, so that rounding does not make
    /// a surface block its own light: the larger of this, and of k_relative_margin times the magnitude of
    /// the point's largest coordinate. Metres.
    float least_margin() const noexcept;
    static constexpr float k_relative_margin = 0x1p-20f;
    bool has_transparent() const noexcept;
    bool has_see_through() const noexcept;
    /// Whether light is blocked only where it enters that object.
    bool is_solid(std::uint32_t object) const noexcept;
    /// Whether there are so many triangles that sixteen rays take longer than may_block().
    bool is_dense() const noexcept;

    /// Whether anything may block light on its way from the points in a box, on the surface of `object`, to a
    /// light in another box, or in that direction; `false` is certain. Takes no more time than a few rays.
    bool may_block(const Box& points, const Box& light, std::uint32_t object) const noexcept;
    bool may_block(const Box& points, Vec3 towards, std::uint32_t object) const noexcept;

    /// Writes 1 for each ray that reaches its end, 0 for each that is blocked, and adds the ways through
    /// transparent objects to `crossings`, and those through see-through surfaces to `passages`, sorted by
    /// ray and object; if that is null, these block nothing. A ray's result does not depend on the others;
    /// rays that are close to each other are fast.
    void find_visible(const ShadowRays& rays, float* visible, std::vector<Crossing>& crossings,
                      std::vector<Passage>* passages = nullptr) const;

    /// The nearest triangle that blocks the ray of that index.
    std::optional<Blocker> find_blocker(const ShadowRays& rays, std::size_t ray) const;

  private:
    /// Where rays from points in the box start.
    Box starting(const Box& points) const noexcept;

    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace candela
