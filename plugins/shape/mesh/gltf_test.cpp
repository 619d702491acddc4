// Features of glTF files that change triangles: skins, morph targets, instances, compression; and invalid
// files.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <fmt/format.h>
#include <meshoptimizer.h>

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
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

constexpr int k_float = GltfFile::k_float, k_ubyte = GltfFile::k_ubyte, k_uint = GltfFile::k_uint;

class File : public GltfFile {
  public:
    File()
        : GltfFile({{"scenes", {{{"nodes", {0}}}}}, {"nodes", {{{"mesh", 0}}}}, {"meshes", Json::array()}}) {}

    void mesh(Json primitive) { json["meshes"].push_back({{"primitives", {std::move(primitive)}}}); }
};

const std::vector<float> k_tetrahedron = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
const std::vector<std::uint32_t> k_faces = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

/// A tetrahedron, with further members of its primitive.
File tetrahedron(const Json& attributes = Json::object(), const Json& more = Json::object()) {
    File file;
    Json primitive = {{"attributes", {{"POSITION", file.accessor(k_float, "VEC3", 4, k_tetrahedron)}}},
                      {"indices", file.accessor(k_uint, "SCALAR", 12, k_faces)}};
    primitive["attributes"].update(attributes);
    primitive.update(more);
    file.mesh(primitive);
    return file;
}

bool is_near(Vec3 a, Vec3 b, double most = 1e-5) {
    return std::abs(a.x - b.x) < most && std::abs(a.y - b.y) < most && std::abs(a.z - b.z) < most;
}

struct Read {
    Mesh mesh;
    std::vector<std::string> warnings;
    std::string refusal;

    bool has(Vec3 vertex) const {
        for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
            if (is_near(mesh.position.span()[i], vertex)) return true;
        return false;
    }
    Vec3 highest() const {
        Vec3 result = mesh.position.span()[0];
        for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
            const Vec3 p = mesh.position.span()[i];
            result = {std::max(result.x, p.x), std::max(result.y, p.y), std::max(result.z, p.z)};
        }
        return result;
    }
};

Read read(const std::string& content, const char* name = "a.glb") {
    const auto path = write_file(scratch_directory() / name, content);
    Read result;
    try {
        candela::PlacedShape placed = candela::place(*instance<Shape>("mesh", {{"file", path.string()}}),
                                                     {.uv = true, .color = true}, {});
        result.warnings = placed.warnings;
        result.mesh = candela::with_normals(std::move(placed), *instance<candela::ShadingModel>("phong"));
    } catch (const std::exception& problem) {
        result.refusal = problem.what();
    }
    return result;
}

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();

/// A compressed mesh: a strip of `cells` squares.
std::vector<char> compressed_by_draco(int cells, bool is_sequential) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2 * cells);
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const auto corner = [](int x, int y) {
        return std::array<float, 3>{static_cast<float>(x), static_cast<float>(y), 0};
    };
    for (int i = 0; i < cells; ++i) {
        const auto a = corner(i, 0), b = corner(i + 1, 0), c = corner(i + 1, 1), d = corner(i, 1);
        builder.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<std::uint32_t>(2 * i)),
                                          a.data(), b.data(), c.data());
        builder.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<std::uint32_t>(2 * i + 1)),
                                          a.data(), c.data(), d.data());
    }
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(is_sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                            : draco::MESH_EDGEBREAKER_ENCODING);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    draco::EncoderBuffer buffer;
    REQUIRE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

File of_draco(const std::vector<char>& bytes, std::size_t points, std::size_t corners) {
    File file;
    const std::size_t view = file.view(bytes);
    const Json none = Json::object();
    const std::size_t position = file.accessor(k_float, "VEC3", points, none),
                      indices = file.accessor(k_uint, "SCALAR", corners, none);
    file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    file.mesh(
        {{"attributes", {{"POSITION", position}}},
         {"indices", indices},
         {"extensions",
          {{"KHR_draco_mesh_compression", {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}}}}}});
    return file;
}

/// The tetrahedron, compressed by meshoptimizer.
struct Meshopt {
    std::vector<unsigned char> positions = std::vector<unsigned char>(meshopt_encodeVertexBufferBound(4, 12));
    std::vector<unsigned char> indices = std::vector<unsigned char>(meshopt_encodeIndexBufferBound(12, 4));
    std::size_t count = 4;

    Meshopt() {
        positions.resize(
            meshopt_encodeVertexBuffer(positions.data(), positions.size(), k_tetrahedron.data(), 4, 12));
        indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), k_faces.data(), 12));
    }

    std::string glb(const char* extension = "EXT_meshopt_compression") const {
        File file;
        const std::array<std::size_t, 2> hidden = {file.view(positions), file.view(indices)};
        Json& views = file.json["bufferViews"];
        const Json compressed = views;
        for (std::size_t i = 0; i < hidden.size(); ++i) {
            Json meshopt = compressed[i];
            meshopt.update({{"count", i == 0 ? count : 12},
                            {"byteStride", i == 0 ? 12 : 4},
                            {"mode", i == 0 ? "ATTRIBUTES" : "TRIANGLES"}});
            views[i] = {{"buffer", 1},
                        {"byteOffset", i == 0 ? std::size_t{0} : 12 * count},
                        {"byteLength", i == 0 ? 12 * count : std::size_t{48}},
                        {"extensions", {{extension, meshopt}}}};
        }
        file.json["extensionsRequired"] = {extension};
        file.mesh({{"attributes", {{"POSITION", file.accessor(k_float, "VEC3", count, {{"bufferView", 0}})}}},
                   {"indices", file.accessor(k_uint, "SCALAR", 12, {{"bufferView", 1}})}});
        return file.glb();
    }
};

}  // namespace

TEST_CASE("shape/mesh: vertices are placed by the rest pose of the skin's joints, not by the mesh's node") {
    File file = tetrahedron();
    // Both joints turn z up to y up, the second is ten times as large; their weights need not add up to 1.
    Json& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = file.accessor(
        k_ubyte, "VEC4", 4, std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    attributes["WEIGHTS_0"] = file.accessor(
        k_float, "VEC4", 4, std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, 0});
    std::vector<float> unit(16), moved(16);
    for (std::size_t i = 0; i < 16; i += 5) unit[i] = moved[i] = 1;
    moved[14] = 1;  // before its joint, this one moves along z
    std::vector<float> both = unit;
    both.insert(both.end(), moved.begin(), moved.end());
    const std::size_t matrices = file.accessor(k_float, "MAT4", 2, both);
    const double half = std::sqrt(0.5);
    file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 100, 100}}},
                          {{"rotation", {-half, 0, 0, half}}, {"children", {2}}},
                          {{"scale", {10, 10, 10}}}};
    file.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", matrices}}};
    const Read result = read(file.glb());
    REQUIRE(result.refusal.empty());
    CHECK(result.has({1, 0, 0}));
    CHECK(result.has({0, 0, -1}));
    CHECK(result.has({0, 20, 0}));
    CHECK(result.warnings.empty());

    file.json["skins"][0].erase("inverseBindMatrices");
    CHECK(read(file.glb()).has({0, 10, 0}));
    file.json["skins"][0]["joints"] = {1};
    CHECK(holds(read(file.glb()).refusal, "has a vertex 3 of joint 1 of 1"));
    file.json["skins"] = Json::array();
    CHECK(read(file.glb()).has({101, 100, 100}));
}

TEST_CASE("shape/mesh: morph targets are added by their default weights, a node's before its mesh's") {
    File file = tetrahedron();
    const std::size_t up =
        file.accessor(k_float, "VEC3", 4, std::vector<float>{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 8});
    Json& mesh = file.json["meshes"][0];
    mesh["primitives"][0]["targets"] = {{{"POSITION", up}}};
    CHECK(read(file.glb()).highest().z == 1);
    mesh["weights"] = {0.25};
    CHECK(read(file.glb()).highest().z == 3);
    CHECK(read(file.glb()).warnings.empty());
    file.json["nodes"][0]["weights"] = {0.5};
    CHECK(read(file.glb()).highest().z == 5);
    file.json["accessors"][2]["count"] = 3;
    CHECK(holds(read(file.glb()).refusal, "has a primitive of 4 positions and a morph target of 3"));
}

TEST_CASE("shape/mesh: instances of a node are drawn; hidden nodes are not") {
    File file = tetrahedron();
    const std::size_t moves =
        file.accessor(k_float, "VEC3", 3, std::vector<float>{0, 0, 0, 5, 0, 0, 9, 0, 0});
    file.json["nodes"] = {
        {{"mesh", 0},
         {"scale", {2, 2, 2}},
         {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", moves}}}}}}}},
        {{"children", {2}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}},
        {{"mesh", 0}, {"translation", {100, 0, 0}}}};
    file.json["scenes"][0]["nodes"] = {0, 1};
    file.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing", "KHR_node_visibility"};
    const Read result = read(file.glb());
    REQUIRE(result.refusal.empty());
    CHECK(result.mesh.triangle_count() == 12);
    CHECK(is_near(result.highest(), {20, 2, 2}));
    CHECK(result.warnings.empty());
    file.json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = true;
    CHECK(read(file.glb()).mesh.triangle_count() == 16);
}

TEST_CASE(
    "shape/mesh: non-finite numbers are repaired and counted; non-finite positions are refused by name") {
    File file = tetrahedron();
    Json& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] =
        file.accessor(k_float, "VEC3", 4, std::vector<float>{0, 0, -1, k_nan, 0, 0, 0, INFINITY, 0, 0, 0, 1});
    attributes["TEXCOORD_0"] =
        file.accessor(k_float, "VEC2", 4, std::vector<float>{0, k_nan, 0, 0, 0.5f, 0.5f, 1, 1});
    const Read result = read(file.glb());
    REQUIRE(result.refusal.empty());
    REQUIRE(result.warnings.size() == 2);
    CHECK(holds(result.warnings[0], "has 2 normals that are not finite, which are computed"));
    CHECK(holds(result.warnings[1], "has 1 texture coordinate that is not finite, which is 0 instead"));
    CHECK(result.mesh.v[0] == 0);

    auto broken = k_tetrahedron;
    broken[7] = k_nan;
    file.json["meshes"][0]["primitives"][0]["attributes"] = {
        {"POSITION", file.accessor(k_float, "VEC3", 4, broken)}};
    CHECK(holds(read(file.glb()).refusal,
                "has a vertex that is not finite: number 2 of accessor 4, (0, nan, 0)"));
}

TEST_CASE("shape/mesh: a buffer may have more bytes than declared, but not fewer") {
    const std::string data =
        "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    const auto text = [&](int length, const std::string& uri) {
        return fmt::format(
            R"({{"asset": {{"version": "2.0"}}, "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}}],
"bufferViews": [{{"buffer": 0, "byteLength": 36}}], "buffers": [{{"byteLength": {}, "uri": "{}"}}]}})",
            length, uri);
    };
    CHECK(read(text(36, data), "a.gltf").mesh.triangle_count() == 1);
    CHECK(read(text(36, data + "AAAA"), "a.gltf").mesh.triangle_count() == 1);
    CHECK(read(text(36, "data:model/x;base64," + data.substr(data.find(',') + 1)), "a.gltf")
              .mesh.triangle_count() == 1);
    CHECK(holds(read(text(37, data), "a.gltf").refusal,
                "is cut off: its data: URI has 36 bytes, but buffer 0 declares 37"));
    const std::string refusal = read(text(36, "data:,hello"), "a.gltf").refusal;
    CHECK(holds(refusal, "has a data: URI for buffer 0 that is not valid base64"));
    CHECK_FALSE(holds(refusal, "hello"));
}

TEST_CASE("shape/mesh: a glTF file with only points and lines is refused as such") {
    File file;
    const std::size_t corners = file.accessor(k_float, "VEC3", 3, std::vector<float>(9));
    for (const int mode : {0, 1, 3}) file.mesh({{"attributes", {{"POSITION", corners}}}, {"mode", mode}});
    CHECK(holds(read(file.glb()).refusal,
                "has 1 set of points and 2 sets of lines and no triangles; Candela draws"));
}

TEST_CASE("shape/mesh: glTF 1 is refused with the command that converts it") {
    CHECK(holds(read(R"({"asset": {"version": "1.0"}})", "a.gltf").refusal, "npx gltf-pipeline -i"));
    CHECK(holds(read(R"({"meshes": {"a": {}}})", "a.gltf").refusal, "npx gltf-pipeline -i"));
    CHECK(holds(read(std::string("glTF\1\0\0\0\x14\0\0\0", 12), "a.glb").refusal, "npx gltf-pipeline -i"));
    CHECK_FALSE(holds(read(R"({"asset": {"version": "3.0"}})", "a.gltf").refusal, "npx"));
}

TEST_CASE("shape/mesh: Draco-compressed primitives decompress to the originals") {
    for (const bool is_sequential : {false, true}) {
        const Read result = read(of_draco(compressed_by_draco(9, is_sequential), 20, 54).glb());
        INFO(result.refusal);
        REQUIRE(result.refusal.empty());
        CHECK(result.mesh.triangle_count() == 18);
        CHECK(result.mesh.vertex_count() == 20);
        CHECK(is_near(result.highest(), {9, 1, 0}, 1e-3));
        CHECK(is_near(result.mesh.face_normal.span()[0], {0, 0, 1}));
    }
}

TEST_CASE("shape/mesh: Draco streams that are damaged or declare more than they hold are refused") {
    for (const bool is_sequential : {false, true}) {
        const std::vector<char> whole = compressed_by_draco(40, is_sequential);
        for (std::size_t size = 0; size < whole.size(); size += 7) {
            const std::vector<char> part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
            CHECK_FALSE(read(of_draco(part, 82, 240).glb()).refusal.empty());
        }
        for (std::size_t at = 0; at < whole.size(); at += 3) {
            std::vector<char> bytes = whole;
            bytes[at] = static_cast<char>(bytes[at] ^ 0x55);
            read(of_draco(bytes, 82, 240).glb());  // whatever the outcome, it terminates
        }
    }
    // Sequential, version 2.2: 2^28 faces and as many points.
    const std::vector<char> endless = {'D',    'R',    'A',    'C',    'O',    2,      2,      1,
                                       0,      0,      0,      '\x80', '\x80', '\x80', '\x80', 1,
                                       '\x80', '\x80', '\x80', '\x80', 1,      0};
    CHECK(holds(read(of_draco(endless, 82, 240).glb()).refusal, "declares more than its 22 bytes can hold"));
    CHECK(holds(read(of_draco({'n', 'o'}, 82, 240).glb()).refusal, "are not a mesh compressed by Draco"));
}

TEST_CASE("shape/mesh: buffer views compressed by meshoptimizer decompress to the originals") {
    for (const char* const extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        const Read result = read(Meshopt().glb(extension));
        INFO(result.refusal);
        REQUIRE(result.refusal.empty());
        CHECK(result.mesh.triangle_count() == 4);
        CHECK(is_near(result.highest(), {1, 1, 1}));
        CHECK(result.mesh.closed);
        CHECK(result.warnings.empty());
    }
    Meshopt cut;
    cut.positions.pop_back();
    CHECK(holds(read(cut.glb()).refusal, "compressed by meshoptimizer whose bytes are damaged"));
    Meshopt endless;
    endless.count = 1u << 30;
    CHECK(holds(read(endless.glb()).refusal, "more than a file of this size can hold"));
}
