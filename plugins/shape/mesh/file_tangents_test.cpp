// Tangents that a glTF file has, as normal maps were baked for them.
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/gltf_file.h"
#include "support/plugins.h"
#include "support/text.h"

using candela::Mesh;
using candela::Shape;
using candela::Vec3;

namespace {

using Json = nlohmann::json;

/// A square of two metres in the plane z = 0 with texture coordinates from 0 to 1, u to the right.
class Square : public GltfFile {
  public:
    Square()
        : GltfFile({{"scenes", {{{"nodes", {0}}}}},
                    {"nodes", {{{"mesh", 0}}}},
                    {"meshes", {{{"primitives", {Json::object()}}}}}}) {
        const std::vector<float> normals{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
        primitive() = {{"attributes",
                        {{"POSITION", floats("VEC3", {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0})},
                         {"NORMAL", floats("VEC3", normals)},
                         {"TEXCOORD_0", floats("VEC2", {0, 1, 1, 1, 1, 0, 0, 0})}}},
                       {"indices", integers({0, 1, 2, 0, 2, 3})}};
    }
    Json& primitive() { return json["meshes"][0]["primitives"][0]; }
    /// The same tangent at all four corners.
    void tangent(const std::array<float, 4>& t) {
        std::vector<float> all;
        for (int i = 0; i < 4; ++i) all.insert(all.end(), t.begin(), t.end());
        primitive()["attributes"]["TANGENT"] = floats("VEC4", all);
    }
};

struct Read {
    Mesh mesh;
    std::vector<std::string> warnings;

    Vec3 dpdu(std::size_t i = 0) const { return mesh.dpdu.span()[i]; }
    Vec3 dpdv(std::size_t i = 0) const { return mesh.dpdv.span()[i]; }
};

Read read(GltfFile& file) {
    const auto path = write_file(scratch_directory() / "a.glb", file.glb());
    candela::PlacedShape placed = candela::place(*instance<Shape>("mesh", {{"file", path.string()}}),
                                                 {.uv = true, .derivatives = true}, {});
    std::vector<std::string> warnings = placed.warnings;
    return {candela::with_normals(std::move(placed), *instance<candela::ShadingModel>("phong")),
            std::move(warnings)};
}

void check_near(Vec3 a, Vec3 b) {
    INFO(a.x << ' ' << a.y << ' ' << a.z << ", expected " << b.x << ' ' << b.y << ' ' << b.z);
    CHECK(length(a - b) < 1e-5f);
}

}  // namespace

TEST_CASE("shape/mesh: tangents of a glTF file have their own direction, and the lengths of its texture") {
    Square file;
    // Two metres to the texture's width and height.
    const Read computed = read(file);
    check_near(computed.dpdu(), {2, 0, 0});
    check_near(computed.dpdv(), {0, 2, 0});
    file.tangent({0.6f, 0.8f, 0, 1});
    const Read turned = read(file);
    CHECK(turned.warnings.empty());
    CHECK(turned.mesh.vertex_count() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
        check_near(turned.dpdu(i), {1.2f, 1.6f, 0});
        // The bitangent is the cross product of the normal, +z, and the tangent.
        check_near(turned.dpdv(i), {-1.6f, 1.2f, 0});
    }
    file.tangent({0.6f, 0.8f, 0, -1});
    check_near(read(file).dpdv(), {1.6f, -1.2f, 0});
}

TEST_CASE("shape/mesh: a node turns, stretches and mirrors its mesh's tangents") {
    Square file;
    file.tangent({0.6f, 0.8f, 0, 1});
    const double r = std::numbers::sqrt2 / 2;
    // By 90 degrees about z: x becomes y, y becomes -x.
    file.json["nodes"][0] = {{"mesh", 0}, {"rotation", {0, 0, r, r}}};
    const Read turned = read(file);
    check_near(turned.dpdu(), {-1.6f, 1.2f, 0});
    check_near(turned.dpdv(), {-1.2f, -1.6f, 0});
    SECTION("mirrored, the bitangent is the mirror image of what it was") {
        file.json["nodes"][0] = {{"mesh", 0}, {"scale", {-1, 1, 1}}};
        const Read mirrored = read(file);
        check_near(mirrored.dpdu(), {-1.2f, 1.6f, 0});
        check_near(mirrored.dpdv(), {1.6f, 1.2f, 0});
    }
    SECTION("stretched, the tangent is along the stretched one") {
        file.json["nodes"][0] = {{"mesh", 0}, {"scale", {2, 1, 1}}};
        const Read stretched = read(file);
        const float size = std::sqrt(1.2f * 1.2f + 0.8f * 0.8f);
        // The texture is four metres wide now.
        check_near(stretched.dpdu(), (4 / size) * Vec3{1.2f, 0.8f, 0});
        check_near(stretched.dpdv(), (2 / size) * Vec3{-0.8f, 1.2f, 0});
    }
}

TEST_CASE("shape/mesh: morph targets move tangents, and parts keep theirs") {
    Square file;
    file.tangent({1, 0, 0, 1});
    file.primitive()["targets"] = {
        {{"TANGENT", file.floats("VEC3", {-1, 1, 0, -1, 1, 0, -1, 1, 0, -1, 1, 0})}}};
    file.json["meshes"][0]["weights"] = {1};
    check_near(read(file).dpdu(), {0, 2, 0});

    // The same square again, without tangents.
    Json plain = file.primitive();
    plain.erase("targets");
    plain["attributes"].erase("TANGENT");
    file.json["meshes"][0].erase("weights");
    file.json["meshes"][0]["primitives"].push_back(plain);
    const Read both = read(file);
    REQUIRE(both.mesh.vertex_count() == 8);
    check_near(both.dpdu(0), {2, 0, 0});
    check_near(both.dpdu(4), {2, 0, 0});
    file.tangent({0, -1, 0, 1});
    file.primitive().erase("targets");
    const Read two = read(file);
    check_near(two.dpdu(0), {0, -2, 0});
    check_near(two.dpdu(4), {2, 0, 0});
}

TEST_CASE("shape/mesh: unusable tangents are computed instead, with a note") {
    const auto noted = [](Square& file, const char* count) {
        const Read result = read(file);
        check_near(result.dpdu(3), {2, 0, 0});
        check_near(result.dpdv(3), {0, 2, 0});
        REQUIRE(result.warnings.size() == 1);
        INFO(result.warnings[0]);
        CHECK(holds(result.warnings[0], std::string("has ") + count));
        CHECK(holds(result.warnings[0], "unusable, which are computed from the triangles instead") !=
              (std::string(count) == "1 tangent "));
    };
    Square three;
    three.primitive()["attributes"]["TANGENT"] = three.floats("VEC3", {1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0});
    noted(three, "4 tangents ");
    Square few;
    few.primitive()["attributes"]["TANGENT"] = few.floats("VEC4", {0, 1, 0, 1});
    noted(few, "4 tangents ");
    Square none;
    none.primitive()["attributes"]["TANGENT"] = 77;
    noted(none, "4 tangents ");
    Square infinite;
    const float inf = std::numeric_limits<float>::infinity();
    infinite.primitive()["attributes"]["TANGENT"] =
        infinite.floats("VEC4", {0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, inf, 0, 0, 1});
    noted(infinite, "1 tangent ");

    SECTION("zeros, those along the normal, and those without normals are none, silently") {
        Square zero;
        zero.tangent({0, 0, 0, 1});
        check_near(read(zero).dpdu(), {2, 0, 0});
        Square along;
        along.tangent({0, 0, 1, 1});
        check_near(read(along).dpdu(), {2, 0, 0});
        Square bare;
        bare.tangent({0, 1, 0, 1});
        bare.primitive()["attributes"].erase("NORMAL");
        const Read result = read(bare);
        check_near(result.dpdu(), {2, 0, 0});
        CHECK(result.warnings.empty());
    }
}
