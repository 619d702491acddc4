// Makes a reflection model that shows the object's environment from five kernel functions:
//
//     Reflected x_reflect(XMaterial m, Surface s, vec3 to_light)
//     vec3 x_reflect_ambient(XMaterial m, Surface s)
//     Refracted x_enter(XMaterial m, Surface s)
//     Refracted x_leave(XMaterial m, vec3 direction, vec3 normal)
//     vec3 x_transmit(XMaterial m, vec3 color, float distance)
//
// The first two are those of reflection_plugin.h. The others define what happens where the line of sight
// enters, what happens where it meets the surface from inside, and how much light remains after a distance in
// the material.
//
// The material has a member `int internal_reflections`.
#pragma once

#include "candela/extensions.h"
#include "candela/reflection_plugin.h"

#include <cstdint>

namespace candela::sdk {

/// A ray is no longer followed if its remainder can change no channel of what it shows by more than this
/// fraction: less than a quarter of the smallest step of an 8-bit picture.
inline constexpr float k_negligible = 1.0f / 1024;

/// Lines of sight that are followed together. Those that have ended are removed.
struct Rays {
    static constexpr std::size_t k_size = k_pass_size;

    PassVectors origin{}, direction{}, weight{};  // `weight`: the fraction of what they meet that is visible
    PassVectors color{};                          // C_o where they enter
    PassVectors towards{}, share{}, seen{};       // their outward directions, and the visible fraction of
                                                  // what lies there
    PassVectors total{};                          // everything visible so far
    PassVectors exit_position{}, exit_normal{};
    alignas(64) float distance[k_size]{};
    std::uint32_t point[k_size];  // where they entered
    std::size_t count = 0;

    /// Their number in whole vectors, so that loops over them have no remainder; what ended rays have left
    /// there is harmless.
    std::size_t filled() const {
        constexpr std::size_t k_vector = 16;
        return (count + k_vector - 1) / k_vector * k_vector;
    }

    /// Removes the rays that have no weight left, or all of them, and adds what they have shown.
    void remove_ended(bool all, const Vec3Span& sum) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (all || (weight.x[i] == 0 && weight.y[i] == 0 && weight.z[i] == 0)) {
                store(sum, point[i], load(sum, point[i]) + load(total, i));
                continue;
            }
            if (kept < i) {
                for (PassVectors* const v : {&origin, &direction, &weight, &color, &total})
                    store(*v, kept, load(*v, i));
                point[kept] = point[i];
            }
            ++kept;
        }
        count = kept;
    }
};

/// At the surface: one part looks towards the mirror image, the rest enters.
template <class Material, auto enter, SurfaceReads reads>
struct EnterLoop {
    CANDELA_BATCH_LOOP static void run(Material material, SurfaceBatch surface, Rays* rays) {
        const std::size_t count = surface.count;
        Rays& r = *rays;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const kernel::Surface s = surface_at<reads>(surface, i);
            const kernel::Refracted refracted = call<enter>(material, s);
            const vec3 mirrored = kernel::reflect(-s.to_observer, s.normal);
            store(r.towards, i, mirrored);
            store(r.share, i, vec3(refracted.mirrored));
            store(r.direction, i, refracted.direction);
            store(r.weight, i, vec3(1.0f - refracted.mirrored));
            store(r.origin, i, load(surface.position, i));
            store(r.color, i, s.color);
            r.point[i] = static_cast<std::uint32_t>(i);
        }
    }
};

/// At the surface, from inside: one part leaves and looks outwards, the rest stays.
template <class Material, auto leave, auto transmit>
struct LeaveLoop {
    CANDELA_BATCH_LOOP static void run(Material material, Rays* rays, bool is_last, float max_intensity) {
        Rays& r = *rays;
        const std::size_t count = r.filled();
        const float last = is_last ? 1.0f : 0.0f;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 direction = load(r.direction, i);
            const vec3 normal = load(r.exit_normal, i);
            const kernel::Refracted refracted = call<leave>(material, direction, normal);
            const bool is_lost = r.distance[i] < 0.0f;  // the surface is open there
            const bool is_free = refracted.mirrored < 1.0f;
            const vec3 kept = call<transmit>(material, load(r.color, i), is_lost ? 0.0f : r.distance[i]);
            const vec3 weight = load(r.weight, i) * kept;
            const vec3 change =
                weight * (refracted.mirrored * max_intensity) - k_negligible * load(r.total, i);
            const bool is_negligible = kernel::max(kernel::max(change.x, change.y), change.z) <= 0.0f;
            // At the end, everything that is left exits, so that no light is lost; straight on if it cannot
            // be refracted.
            const float out = is_lost || is_negligible ? 1.0f : kernel::max(1.0f - refracted.mirrored, last);
            const float refracts = !is_lost && is_free ? 1.0f : 0.0f;
            const vec3 towards = refracts * refracted.direction + (1.0f - refracts) * direction;
            store(r.towards, i, towards);
            store(r.share, i, weight * out);
            store(r.weight, i, weight * (1.0f - out));
            const vec3 inwards = kernel::reflect(direction, normal);
            store(r.direction, i, inwards);
            store(r.origin, i, load(r.exit_position, i));
        }
    }
};

struct AddSeenLoop {
    CANDELA_BATCH_LOOP static void run(Rays* rays) {
        Rays& r = *rays;
        const std::size_t count = r.filled();
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            add_product(r.total, i, load(r.share, i), load(r.seen, i));
        }
    }
};

template <class Material, auto reflect_, auto reflect_ambient_, auto enter_, auto leave_, auto transmit_,
          SurfaceReads reads = reads_no_more>
class KernelRefraction : public ReflectionModel, public EnvironmentReflection {
    using Surface = KernelReflection<Material, reflect_, reflect_ambient_, reads>;

  public:
    static constexpr SurfaceNeeds k_needs = Surface::k_needs;
    static constexpr KernelFunction k_kernel_functions[] = {
        kernel_function<Material, reflect_>("reflect"),
        kernel_function<Material, reflect_ambient_>("reflect_ambient"),
        kernel_function<Material, enter_>("enter"), kernel_function<Material, leave_>("leave"),
        kernel_function<Material, transmit_>("transmit")};

    explicit KernelRefraction(const Material& material) : surface_(material), material_(material) {}

    void reflect(const SurfaceBatch& surface, const LightingBatch& light,
                 const ReflectedBatch& reflected) const override {
        surface_.reflect(surface, light, reflected);
    }
    void reflect_ambient(const SurfaceBatch& surface, const ConstVec3Span& ambient,
                         const ReflectedBatch& reflected) const override {
        surface_.reflect_ambient(surface, ambient, reflected);
    }
    void show_environment(const SurfaceBatch& surface, Environment& environment,
                          const ReflectedBatch& reflected) const override {
        const SurfacePasses passes(surface);
        for (std::size_t first = 0; first < surface.count; first += Rays::k_size)
            follow(passes.from(first), environment, reflected.specular.from(first));
    }

    Rgb transmittance(const Rgb& color, float distance) const override {
        const vec3 left = call<transmit_>(material_, kernel_vector(color), distance);
        return {left.x, left.y, left.z};
    }

  private:
    /// The mirrored part, then the part that leaves at the far side, then the part that leaves after another
    /// internal reflection …
    void follow(const SurfaceBatch& surface, Environment& environment, const Vec3Span& sum) const {
        Rays rays;
        rays.count = surface.count;
        multiversion<EnterLoop<Material, enter_, reads>>(material_, surface, &rays);
        look(rays, environment);
        for (int within = 0; rays.count > 0; ++within) {
            const bool is_last = within == material_.internal_reflections;
            environment.trace_exit(rays.count, rays.origin.span(), rays.direction.span(),
                                   {rays.exit_position.span(), rays.exit_normal.span(), rays.distance});
            multiversion<LeaveLoop<Material, leave_, transmit_>>(material_, &rays, is_last,
                                                                 environment.max_intensity());
            look(rays, environment);
            rays.remove_ended(is_last, sum);
        }
    }

    static void look(Rays& rays, Environment& environment) {
        environment.look(rays.filled(), rays.towards.span(), rays.seen.span());
        multiversion<AddSeenLoop>(&rays);
    }

    Surface surface_;
    Material material_;
};

}  // namespace candela::sdk
