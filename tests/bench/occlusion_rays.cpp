// candela_occlusion_rays SCENE [ROUNDS]: how many rays per second Candela's occlusion tree follows, and a
// bare loop over Embree's packets of the same rays: those from a scene's visible points to its lights. One
// line per round: both, in millions.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>
#include <vector>

import candela.core;

namespace {

using candela::OcclusionTree;
using candela::ShadowRays;
using candela::Vec3;

constexpr int k_tile = 64;
constexpr std::size_t k_batch = 256;

/// The rays of up to k_batch points of one object to one sample of a light.
struct Batch {
    std::uint32_t object = 0;
    std::size_t count = 0;
    candela::Vec3Arrays origin, direction;
    candela::AlignedVector<float> length;
    candela::AlignedVector<std::uint32_t> flags;

    Batch() {
        origin.resize(k_batch);
        direction.resize(k_batch);
        length.resize(k_batch);
        flags.resize(k_batch);
    }
};

std::vector<Vec3> picture(const candela::RenderScene& scene, candela::Term term) {
    candela::Film film(scene.image.width, scene.image.height, candela::PixelType::real,
                       candela::ColorEncoding::none);
    candela::render(scene, film, {.term = term});
    const auto reals = film.view().reals;
    std::vector<Vec3> pixels;
    for (std::size_t i = 0; i < reals.size(); i += 3)
        pixels.push_back({reals[i], reals[i + 1], reals[i + 2]});
    return pixels;
}

/// Tile by tile, object by object, light by light, as they are shaded.
std::vector<Batch> rays_of(const candela::RenderScene& scene) {
    const std::vector<Vec3> position = picture(scene, candela::Term::position),
                            normal = picture(scene, candela::Term::face_normal),
                            object = picture(scene, candela::Term::object);
    std::vector<Batch> batches;
    const int width = scene.image.width, height = scene.image.height;
    const auto add = [&](std::uint32_t of, const std::vector<std::size_t>& pixels) {
        for (const candela::RenderLight& light : scene.lights) {
            if (!light.data) continue;
            for (const candela::PunctualLight& sample : light.data->samples) {
                for (std::size_t first = 0; first < pixels.size(); first += k_batch) {
                    Batch& batch = batches.emplace_back();
                    batch.object = of;
                    batch.count = std::min(k_batch, pixels.size() - first);
                    for (std::size_t i = 0; i < batch.count; ++i) {
                        const Vec3 p = position[pixels[first + i]], n = normal[pixels[first + i]];
                        const Vec3 way = sample.w == 0 ? sample.position : sample.position - p;
                        const Vec3 l = normalized(way);
                        const bool is_lit = dot(n, l) > 0;
                        batch.origin.span().set(i, p + 1e-5f * n);
                        batch.direction.span().set(i, l);
                        batch.length[i] = sample.w == 0 ? INFINITY : 0.99999f * length(way);
                        batch.flags[i] = is_lit ? ShadowRays::k_traced : 0u;
                    }
                }
            }
        }
    };
    for (int top = 0; top < height; top += k_tile) {
        for (int left = 0; left < width; left += k_tile) {
            std::map<std::uint32_t, std::vector<std::size_t>> of_object;
            for (int y = top; y < std::min(top + k_tile, height); ++y) {
                for (int x = left; x < std::min(left + k_tile, width); ++x) {
                    const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                   static_cast<std::size_t>(x);
                    if (object[i].x >= 0) of_object[static_cast<std::uint32_t>(object[i].x)].push_back(i);
                }
            }
            for (const auto& [number, pixels] : of_object) add(number, pixels);
        }
    }
    return batches;
}

/// Embree's packets, ready to be traced.
struct Packets {
    std::vector<RTCRay16> rays;
    std::vector<std::array<int, 16>> valid;

    explicit Packets(const std::vector<Batch>& batches) {
        for (const Batch& batch : batches) {
            for (std::size_t first = 0; first < batch.count; first += 16) {
                RTCRay16& packet = rays.emplace_back();
                std::array<int, 16>& mask = valid.emplace_back();
                bool is_any = false;
                for (std::size_t i = 0; i < 16; ++i) {
                    const Vec3 o = batch.origin.span()[first + i], d = batch.direction.span()[first + i];
                    packet.org_x[i] = o.x;
                    packet.org_y[i] = o.y;
                    packet.org_z[i] = o.z;
                    packet.dir_x[i] = d.x;
                    packet.dir_y[i] = d.y;
                    packet.dir_z[i] = d.z;
                    packet.tnear[i] = 0;
                    packet.tfar[i] = batch.length[first + i];
                    packet.mask[i] = ~0u;
                    mask[i] = batch.flags[first + i] != 0 ? -1 : 0;
                    is_any = is_any || mask[i] != 0;
                }
                if (is_any) continue;
                rays.pop_back();
                valid.pop_back();
            }
        }
    }
};

RTCScene embree_scene(RTCDevice device, const candela::RenderScene& scene) {
    RTCScene made = rtcNewScene(device);
    for (const candela::RenderObject& object : scene.objects) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   object.mesh.vertices.data(), 0, sizeof(candela::MeshVertex),
                                   object.mesh.vertices.size());
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   object.mesh.indices.data(), 0, 3 * sizeof(std::uint32_t),
                                   object.mesh.triangle_count());
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(made, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcSetSceneFlags(made, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(made);
    return made;
}

template <class Work>
double seconds(const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) return 2;
    candela::Registry registry(candela::plugin_search_path({}));
    candela::Diagnostics diagnostics;
    candela::SceneRequest request;
    request.files = {argv[1]};
    request.settings = {{"--shadows", "shadows.enabled", "true"}};
    const auto source = candela::read_scene(request, registry, diagnostics);
    if (!source) return 1;
    const auto scene = candela::build(*source, registry, diagnostics, 0);
    if (!scene || !scene->occlusion) return 1;
    const std::vector<Batch> batches = rays_of(*scene);
    std::size_t count = 0;
    for (const Batch& batch : batches) {
        for (std::size_t i = 0; i < batch.count; ++i) count += batch.flags[i] != 0 ? 1 : 0;
    }
    RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
    RTCScene rival = embree_scene(device, *scene);
    const Packets packets(batches);
    std::vector<float> visible(k_batch);
    std::vector<candela::Crossing> crossings;
    for (int round = argc > 2 ? std::atoi(argv[2]) : 7; round > 0; --round) {
        std::size_t ours_blocked = 0, theirs_blocked = 0;
        const double ours = seconds([&] {
            for (const Batch& batch : batches) {
                scene->occlusion->find_visible({.count = batch.count,
                                                .origin = batch.origin.span(),
                                                .direction = batch.direction.span(),
                                                .length = batch.length.data(),
                                                .flags = batch.flags.data(),
                                                .object = batch.object},
                                               visible.data(), crossings);
                for (std::size_t i = 0; i < batch.count; ++i) ours_blocked += visible[i] == 0 ? 1 : 0;
            }
        });
        const double theirs = seconds([&] {
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            for (std::size_t k = 0; k < packets.rays.size(); ++k) {
                RTCRay16 packet = packets.rays[k];
                alignas(64) const std::array<int, 16> valid = packets.valid[k];
                rtcOccluded16(valid.data(), rival, &context, &packet);
                for (std::size_t i = 0; i < 16; ++i)
                    theirs_blocked += valid[i] != 0 && packet.tfar[i] < 0 ? 1 : 0;
            }
        });
        const double millions = static_cast<double>(count) / 1e6;
        fmt::print("{:.2f} M rays: {:.2f} M/s, Embree {:.2f} M/s, ratio {:.3f}; blocked {} and {}\n",
                   millions, millions / ours, millions / theirs, theirs / ours, ours_blocked, theirs_blocked);
    }
    rtcReleaseScene(rival);
    rtcReleaseDevice(device);
}
