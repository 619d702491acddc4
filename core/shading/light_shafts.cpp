// Which points of a batch need rays to a light that is data: shafts from their bounds to the light's show
// most others, sixteen at a time.
module;

#include "candela/kernel/simd_dispatch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

module candela.shading;

import :light_visibility;
import candela.api;
import candela.geometry;
import candela.raster;
import candela.util;

namespace candela {

namespace {

constexpr std::size_t k_packet = OcclusionTree::k_packet;

/// The boxes around sixteen vectors each.
struct PacketBoxesLoop {
    CANDELA_BATCH_LOOP static void run(ConstVec3Span v, std::size_t count, Box* boxes) {
        for (std::size_t first = 0; first < count; first += k_packet) {
            Box& box = boxes[first / k_packet];
            bound(v.x + first, box.low.x, box.high.x);
            bound(v.y + first, box.low.y, box.high.y);
            bound(v.z + first, box.low.z, box.high.z);
        }
    }

  private:
    [[gnu::always_inline]] static void bound(const float* values, float& low, float& high) {
        constexpr std::size_t k_half = k_packet / 2;
        float least[k_half], most[k_half];
        for (std::size_t i = 0; i < k_half; ++i) {
            const float a = values[i], b = values[i + k_half];
            least[i] = a < b ? a : b;
            most[i] = a > b ? a : b;
        }
        for (std::size_t step = k_half / 2; step > 0; step /= 2) {
            for (std::size_t i = 0; i < step; ++i) {
                least[i] = least[i] < least[i + step] ? least[i] : least[i + step];
                most[i] = most[i] > most[i + step] ? most[i] : most[i + step];
            }
        }
        low = least[0];
        high = most[0];
    }
};

/// Whether no normal in a box faces any of the directions in another, except for rounding.
bool faces_away(const Box& normal, const Box& towards) {
    float most = 0, magnitude = 0;
    for (float Vec3::* const axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        const float a = normal.low.*axis, b = normal.high.*axis, low = towards.low.*axis,
                    high = towards.high.*axis;
        most += std::max({a * low, a * high, b * low, b * high});
        magnitude += std::max(std::abs(low), std::abs(high));
    }
    return most < -0x1p-18f * magnitude;
}

/// Where a light is, or its direction if it is distant.
Box place_of(const PunctualLight& light) {
    const auto reach = [](float u, float v) { return 0.5f * (std::abs(u) + std::abs(v)); };
    const Vec3 extent{reach(light.extent_u.x, light.extent_v.x), reach(light.extent_u.y, light.extent_v.y),
                      reach(light.extent_u.z, light.extent_v.z)};
    return {light.position - extent, light.position + extent};
}

}  // namespace

template <class Visit>
void LightVisibility::each_place(Visit visit) {
    visit(points_->position.span());
    if (pattern_.size() == 1) return;
    // Samples are within the corners of their pixels. The light does not matter.
    const LightSample any{normal_, points_->coverage.data()};
    for (const float right : {-0.5f, 0.5f}) {
        for (const float below : {-0.5f, 0.5f}) {
            move_in_pixels(any, right, below);
            visit(std::as_const(position_).span());
        }
    }
}

void LightVisibility::find_region() {
    bool is_first = true;
    each_place([&](const ConstVec3Span& position) {
        const Box box = box_around(position, points_->count);
        region_.position = is_first ? box : united(region_.position, box);
        is_first = false;
    });
    if (tree_->is_dense()) region_.normal = box_around(normal_, points_->count);
    has_region_ = true;
}

void LightVisibility::find_packets() {
    std::array<Box, k_packets> boxes;
    Box* const to = boxes.data();
    bool is_first = true;
    each_place([&](const ConstVec3Span& position) {
        multiversion<PacketBoxesLoop>(position, count_, to);
        for (std::size_t i = 0; i < count_ / k_packet; ++i)
            packets_[i].position = is_first ? boxes[i] : united(packets_[i].position, boxes[i]);
        is_first = false;
    });
    multiversion<PacketBoxesLoop>(normal_, count_, to);
    for (std::size_t i = 0; i < count_ / k_packet; ++i) packets_[i].normal = boxes[i];
    has_packets_ = true;
}

bool LightVisibility::may_be_blocked(const PunctualLight& light, const Bounds& points) const {
    const Box place = place_of(light);
    const bool is_distant = light.w == 0;
    const Box towards =
        is_distant ? place : Box{place.low - points.position.high, place.high - points.position.low};
    if (tree_->is_dense() && !lights_below_horizon_ && faces_away(points.normal, towards)) return false;
    return is_distant ? tree_->may_block(points.position, light.position, object_)
                      : tree_->may_block(points.position, place, object_);
}

std::uint32_t LightVisibility::packets_to_trace(const PunctualLight& light) {
    if (!has_region_) find_region();
    if (!may_be_blocked(light, region_)) return 0;
    if (!tree_->is_dense()) return ~0u;
    if (!has_packets_) find_packets();
    std::uint32_t traced = 0;
    for (std::size_t i = 0; i < count_ / k_packet; ++i)
        traced |= may_be_blocked(light, packets_[i]) ? 1u << i : 0u;
    return traced;
}

}  // namespace candela
