// The readers of mesh files where `candela import` uses them without triangles; tests of the shape `mesh`
// read whole files.
#include <catch2/catch_test_macros.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_io/bad_file.h"
#include "mesh_io/gltf/container.h"
#include "mesh_io/gltf/elements.h"
#include "mesh_io/gltf/values.h"
#include "mesh_io/mtl.h"
#include "mesh_io/obj_statements.h"
#include "mesh_io/ply_header.h"
#include "mesh_io/readers.h"
#include "support/gltf_file.h"
#include "support/text.h"

namespace gltf = mesh_io::gltf;

namespace {

/// The chunks of a file, and how many bytes were read to find them.
struct Found {
    gltf::Chunks chunks;
    std::size_t bytes_read = 0;
};

Found chunks_of(std::string_view file) {
    Found found;
    found.chunks = gltf::chunks_of(file.size(), [&](std::size_t begin, std::size_t count) {
        REQUIRE(begin + count <= file.size());
        found.bytes_read += count;
        return file.substr(begin, count);
    });
    return found;
}

std::string refusal_of(const std::string& file) {
    return message_of<mesh_io::BadFile>([&] { chunks_of(file); });
}

}  // namespace

TEST_CASE("mesh_io: a GLB file's chunks are found by their headers alone") {
    GltfFile written(nlohmann::json::object());
    written.floats("SCALAR", std::vector<float>(1000, 0.5f));
    const std::string glb = written.glb();
    const Found found = chunks_of(glb);
    CHECK(found.bytes_read < 64);
    const auto [begin, size] = found.chunks.json;
    CHECK(gltf::parsed(std::string_view(glb).substr(begin, size)) == written.json);
    CHECK(found.chunks.has_binary);
    CHECK(found.chunks.binary.size == 4000);
    CHECK(found.chunks.binary.begin + 4000 == glb.size());

    CHECK(refusal_of(glb.substr(0, glb.size() - 1)).starts_with("is cut off: it should have "));
    CHECK(refusal_of(glb.substr(0, 10)) == "ends within its chunks");
    const Found text = chunks_of("{}");
    CHECK(text.chunks.json.size == 2);
    CHECK_FALSE(text.chunks.has_binary);
}

TEST_CASE("mesh_io: percents and data: URIs are decoded, invalid ones left alone or refused") {
    CHECK(gltf::decoded_percents("a%20b%2Fc%2f%zz%2") == "a b/c/%zz%2");
    const auto bytes = gltf::bytes_of_data_uri("data:model/x;base64,aGVsbG8=");
    REQUIRE(bytes);
    CHECK(mesh_io::text_of(*bytes) == "hello");
    CHECK_FALSE(gltf::bytes_of_data_uri("data:,hello"));
    CHECK_FALSE(gltf::bytes_of_data_uri("data:model/x;base64,!!!!"));
}

TEST_CASE("mesh_io: elements of an accessor lie within their view, whatever its numbers") {
    const std::vector<std::int16_t> values = {32767, -32767, -32768, 0, 100, 200};
    const std::string_view view(reinterpret_cast<const char*>(values.data()), 12);
    constexpr int k_type = gltf::k_short;
    const auto elements = gltf::elements_in(view, 0, 4, k_type, 2, 3);
    REQUIRE(elements);
    CHECK(elements->number(0, 0, true) == 1);
    CHECK(elements->number(1, 0, true) == -1);
    CHECK(elements->number(2, 1, false) == 200);
    CHECK(gltf::elements_in(view, 4, std::nullopt, k_type, 2, 2));
    CHECK_FALSE(gltf::elements_in(view, 0, 4, k_type, 2, 4));
    CHECK_FALSE(gltf::elements_in(view, 2, 4, k_type, 2, 3));
    CHECK_FALSE(gltf::elements_in(view, 0, 2, k_type, 2, 1));
    CHECK_FALSE(gltf::elements_in(view, 0, 0, k_type, 2, 1));
    constexpr auto k_huge = static_cast<std::size_t>(-1);
    CHECK_FALSE(gltf::elements_in(view, k_huge, 4, k_type, 2, 1));
    CHECK_FALSE(gltf::elements_in(view, 0, k_huge, k_type, 2, 2));
    CHECK_FALSE(gltf::elements_in(view, 0, 4, k_type, 2, k_huge));
    CHECK_FALSE(gltf::elements_in(view, 0, std::nullopt, 5124, 2, 1));
}

TEST_CASE("mesh_io: an OBJ file's materials have the same numbers with and without its triangles") {
    const std::string text =
        "\xef\xbb\xbfmtllib a.mtl b.mtl # both\n# usemtl comment\nusemtl unused\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
        "usemtl  Paint\t#2 \nf 1 2 3\r\nusemtl\nf 3 2 1\rusemtl wood\\\nf 1 \\\n2 3\nusemtl Paint #2\nf 1 2 "
        "3\n";
    mesh_io::ObjMaterials materials = mesh_io::materials_of_obj(text);
    CHECK(materials.libraries == std::vector<std::string>{"a.mtl b.mtl # both"});
    CHECK(materials.used == std::vector<std::string>{"Paint #2", "(none)", "wood\\"});
    CHECK(materials.numbers.of("wood\\") == 3);
    CHECK(materials.numbers.names() == mesh_io::read_obj(text, {}, {}).materials);
}

TEST_CASE(
    "mesh_io: an MTL file's materials are in its own terms, and the last description of a name counts") {
    const mesh_io::MaterialLibrary library = mesh_io::read_mtl(
        "Kd 1 1 1\nnewmtl a\nKd 1 0 0\nNs 9\nnewmtl b # blue\nkd 0.5\nmap_Kd -s 1 2 -o -.5 -clamp on my "
        "wood.png\n"
        "newmtl a\nKs +0.5 .25 1e-400\nKd nan 0 0\nd 0.5\nd 0.5\n");
    REQUIRE(library.materials.size() == 2);
    const mesh_io::MtlMaterial &a = library.materials[0], &b = library.materials[1];
    CHECK(a.name == "a");
    CHECK(a.kd.empty());
    CHECK(a.ks == std::vector<double>{0.5, 0.25, 0});
    CHECK(a.shininess == 0);
    CHECK(b.name == "b # blue");
    CHECK(b.kd == std::vector<double>{0.5, 0.5, 0.5});
    CHECK(b.color_map.file == "my wood.png");
    CHECK(b.color_map.clamps);
    CHECK(b.color_map.scale == std::array<double, 2>{1, 2});
    CHECK(b.color_map.offset == std::array<double, 2>{-0.5, 0});
    CHECK(library.notes == std::vector<std::string>{"material colours that are not numbers are left out"});
    CHECK(a.opacity == 0.5);
    CHECK(b.opacity == 1);
    CHECK_THROWS_AS(mesh_io::read_mtl("\xff\xfen"), mesh_io::BadFile);
}

TEST_CASE("mesh_io: an MTL file's opacity is d, or 1 - Tr without it") {
    const mesh_io::MaterialLibrary library = mesh_io::read_mtl(
        "newmtl a\nTr 0.25\nnewmtl b\nTr 1\nd 0.5\nmap_d -clamp on leaf.png\nnewmtl c\nd 0.5\nTr 0\n"
        "newmtl d\nd 7\nnewmtl e\nd -halo 0.5\n");
    REQUIRE(library.materials.size() == 5);
    CHECK(library.materials[0].opacity == 0.75);
    CHECK(library.materials[1].opacity == 0.5);
    CHECK(library.materials[1].opacity_map.file == "leaf.png");
    CHECK(library.materials[1].opacity_map.clamps);
    CHECK(library.materials[2].opacity == 0.5);
    CHECK(library.materials[3].opacity == 1);
    CHECK(library.materials[4].opacity == 1);
    CHECK(library.notes == std::vector<std::string>{"an opacity that depends on the angle is left out"});
}

TEST_CASE("mesh_io: an MTL file's physically based values are there if the file has them") {
    const mesh_io::MaterialLibrary library = mesh_io::read_mtl(
        "newmtl a\nKd 1 0 0\nnewmtl b\nPr 0.25\nPM 1\nPc 0.5\nPcr\naniso x\nanisor 0.125\n");
    const mesh_io::MtlMaterial &a = library.materials[0], &b = library.materials[1];
    CHECK_FALSE(a.roughness);
    CHECK_FALSE(a.metallic);
    CHECK(b.roughness == 0.25);
    CHECK(b.metallic == 1);
    CHECK(b.coat == 0.5);
    CHECK_FALSE(b.coat_roughness);
    CHECK_FALSE(b.anisotropy);
    CHECK(b.rotation == 0.125);
    CHECK(library.notes.empty());
}

TEST_CASE(
    "mesh_io: the textures of a PLY file are in its header's comments, which a part of the file contains") {
    const std::string header =
        "ply\r\nformat ascii 1.0\r\ncomment TextureFile  my wood.png \r\ncomment by hand\r\n"
        "element vertex 9\r\nproperty float x\r\nend_header\r\n";
    const mesh_io::ply::Header read = mesh_io::ply::read_header(header, 1000);
    CHECK(read.comments == std::vector<std::string>{"TextureFile  my wood.png", "by hand"});
    CHECK(mesh_io::ply::texture_files(read) == std::vector<std::string>{"my wood.png"});
    CHECK_THROWS_AS(mesh_io::ply::read_header(header), mesh_io::BadFile);
}
