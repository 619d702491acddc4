#include "patches.h"

namespace teapot {

namespace {

using candela::Vec3;

/// A ring of a surface of revolution: radius and height, and the positions of the inner control points of a
/// quarter turn (0.56 of the radius, Newell's circle; the knob has a rounder one).
struct Ring {
    float radius;
    float height;
    float inner = 0.56f * radius;
};
using Profile = std::array<Ring, 4>;

constexpr std::array<Profile, 6> k_profiles = {{
    {{{0, 3.15f}, {0.8f, 3.15f, 0.45f}, {0, 2.85f}, {0.2f, 2.7f}}},            // knob
    {{{0.2f, 2.7f}, {0.4f, 2.55f}, {1.3f, 2.55f}, {1.3f, 2.4f}}},              // lid
    {{{1.4f, 2.4f}, {1.3375f, 2.53125f}, {1.4375f, 2.53125f}, {1.5f, 2.4f}}},  // rim
    {{{1.5f, 2.4f}, {1.75f, 1.875f}, {2, 1.35f}, {2, 0.9f}}},                  // upper body
    {{{2, 0.9f}, {2, 0.45f}, {1.5f, 0.225f}, {1.5f, 0.15f}}},                  // lower body
    {{{1.5f, 0.15f}, {1.5f, 0.075f}, {1.425f, 0}, {0, 0}}},                    // bottom
}};

/// One half of a handle or spout, z >= 0: x, y (up) and z of the original's control net.
constexpr std::array<Patch, 4> k_halves = {{
    // handle, from the rim outwards and down
    {{{{{-1.6f, 2.025f, 0}, {-1.6f, 2.025f, 0.3f}, {-1.5f, 2.25f, 0.3f}, {-1.5f, 2.25f, 0}}},
      {{{-2.3f, 2.025f, 0}, {-2.3f, 2.025f, 0.3f}, {-2.5f, 2.25f, 0.3f}, {-2.5f, 2.25f, 0}}},
      {{{-2.7f, 2.025f, 0}, {-2.7f, 2.025f, 0.3f}, {-3, 2.25f, 0.3f}, {-3, 2.25f, 0}}},
      {{{-2.7f, 1.8f, 0}, {-2.7f, 1.8f, 0.3f}, {-3, 1.8f, 0.3f}, {-3, 1.8f, 0}}}}},
    {{{{{-2.7f, 1.8f, 0}, {-2.7f, 1.8f, 0.3f}, {-3, 1.8f, 0.3f}, {-3, 1.8f, 0}}},
      {{{-2.7f, 1.575f, 0}, {-2.7f, 1.575f, 0.3f}, {-3, 1.35f, 0.3f}, {-3, 1.35f, 0}}},
      {{{-2.5f, 1.125f, 0}, {-2.5f, 1.125f, 0.3f}, {-2.65f, 0.9375f, 0.3f}, {-2.65f, 0.9375f, 0}}},
      {{{-2, 0.9f, 0}, {-2, 0.9f, 0.3f}, {-1.9f, 0.6f, 0.3f}, {-1.9f, 0.6f, 0}}}}},
    // spout, from the body outwards and up
    {{{{{1.7f, 1.425f, 0}, {1.7f, 1.425f, 0.66f}, {1.7f, 0.6f, 0.66f}, {1.7f, 0.6f, 0}}},
      {{{2.6f, 1.425f, 0}, {2.6f, 1.425f, 0.66f}, {3.1f, 0.825f, 0.66f}, {3.1f, 0.825f, 0}}},
      {{{2.3f, 2.1f, 0}, {2.3f, 2.1f, 0.25f}, {2.4f, 2.025f, 0.25f}, {2.4f, 2.025f, 0}}},
      {{{2.7f, 2.4f, 0}, {2.7f, 2.4f, 0.25f}, {3.3f, 2.4f, 0.25f}, {3.3f, 2.4f, 0}}}}},
    {{{{{2.7f, 2.4f, 0}, {2.7f, 2.4f, 0.25f}, {3.3f, 2.4f, 0.25f}, {3.3f, 2.4f, 0}}},
      {{{2.8f, 2.475f, 0}, {2.8f, 2.475f, 0.25f}, {3.525f, 2.49375f, 0.25f}, {3.525f, 2.49375f, 0}}},
      {{{2.9f, 2.475f, 0}, {2.9f, 2.475f, 0.15f}, {3.45f, 2.5125f, 0.15f}, {3.45f, 2.5125f, 0}}},
      {{{2.8f, 2.4f, 0}, {2.8f, 2.4f, 0.15f}, {3.2f, 2.4f, 0.15f}, {3.2f, 2.4f, 0}}}}},
}};

/// The first quarter, from +x to +z.
Patch quarter_turn(const Profile& profile) {
    Patch patch;
    for (std::size_t row = 0; row < 4; ++row) {
        const auto [radius, height, inner] = profile[row];
        patch[row] = {
            {{radius, height, 0}, {radius, height, inner}, {inner, height, radius}, {0, height, radius}}};
    }
    return patch;
}

/// Rotates by a right angle about y, +x to +z: exact, so that neighbours still share their boundary.
Patch turned(const Patch& patch) {
    Patch result;
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
            const Vec3 p = patch[row][column];
            result[row][column] = {-p.z, p.y, p.x};
        }
    }
    return result;
}

/// Mirrors in the plane z = 0, with u reversed so that dpdu x dpdv still points outwards.
Patch mirrored(const Patch& patch) {
    Patch result;
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
            const Vec3 p = patch[row][3 - column];
            result[row][column] = {p.x, p.y, -p.z};
        }
    }
    return result;
}

}  // namespace

std::vector<Patch> patches() {
    std::vector<Patch> all;
    for (const Profile& profile : k_profiles) {
        Patch patch = quarter_turn(profile);
        for (int quarter = 0; quarter < 4; ++quarter) {
            all.push_back(patch);
            patch = turned(patch);
        }
    }
    for (const Patch& half : k_halves) {
        all.push_back(half);
        all.push_back(mirrored(half));
    }
    return all;
}

}  // namespace teapot
