// Pictures on objects, and files that cannot be used as such.
#include <sys/resource.h>
#include <sys/stat.h>

#include <catch2/catch_test_macros.hpp>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"

namespace {

/// Four pixels of any colour.
const std::string k_image = "P6\n2 2\n255\nabcdefghijkl";

CommandResult render(const std::string& texture, const Folder& directory, const char* shape = "torus") {
    directory.write("scene.toml",
                    std::string("version = 1\nimage = { width = 16, height = 8 }\n"
                                "observer = { position = [0, 0, 4], look_at = [0, 0, 0] }\n"
                                "shading = { model = \"phong\" }\nreflection = { model = \"phong\" }\n"
                                "[[light]]\ntype = \"ambient\"\n[[object]]\nname = \"ring\"\ntype = \"") +
                        shape + "\"\n" + texture + "\n");
    return directory.run("render scene.toml -o out.ppm");
}

}  // namespace

TEST_CASE("mistakes in a texture are reported at its place") {
    const Folder d({{"wood.ppm", k_image}});
    REQUIRE(::mkfifo((d / "pipe.ppm").c_str(), 0600) == 0);
    expect(render("color = { texture = \"wool.ppm\" }", d), 3,
           {"scene.toml:11:21: error: 'wool.ppm' does not exist", "did you mean 'wood.ppm'?"});
    expect(render("color = { texture = \"\" }", d), 3, {"scene.toml:11:21: error: 'texture' is empty"});
    expect(render("color = { texture = \".\" }", d), 3,
           {"scene.toml:11:21: error: '.' is a directory, not a file"});
    expect(render("color = { texture = \"pipe.ppm\" }", d), 3,
           {"scene.toml:11:21: error: 'pipe.ppm' is not a regular file"});
    expect(render("color = { texture = 3 }", d), 3, {"scene.toml:11:21: error: 'texture' is the integer 3"});
    expect(render("color = {}", d), 3,
           {"scene.toml:11:9: error: 'color' in [[object]] 'ring' has no 'texture'"});
    expect(render("color = \"wood.ppm\"", d), 3,
           {"scene.toml:11:9: error: 'color' is a string, \"wood.ppm\""});
    expect(render("color_texture = \"wood.ppm\"", d), 3,
           {"scene.toml:11:1: error: unknown key 'color_texture'", "write color = { texture = \"a.png\" }"});
    expect(render("color = { texture = \"wood.ppm\", wrap = \"miror\" }", d), 3,
           {"scene.toml:11:40: error: 'wrap': \"miror\" is not one of 'repeat', 'clamp', 'mirror'"});
    expect(render("color = { texture = \"wood.ppm\", wrap_v = \"both\" }", d), 3,
           {"scene.toml:11:42: error: 'wrap_v': \"both\" is not one of 'same', 'repeat', 'clamp', 'mirror'"});
    expect(render("color = { texture = \"wood.ppm\", uv = 2 }", d), 3,
           {"scene.toml:11:38: error: 'uv': 2 is outside its range: 0 to 1"});
    expect(render("color = { texture = \"wood.ppm\", uv = 1 }", d), 1,
           {"scene.toml:8:", "object 'ring'", "uv1"});
    expect(render("color = { texture = \"wood.ppm\" }", d, "cube"), 0, {});
    CHECK(d.has("out.ppm"));
}

TEST_CASE("a texture that cannot be read as a picture is one failure that names the file") {
    const Folder d;
    d.write("wood.txt", "brown");
    d.write("wood.png", "brown");
    d.write("plain.ppm", "P3\n1 1\n255\n1 2 3\n");
    d.write("short.ppm", k_image.substr(0, k_image.size() - 1));
    d.write("none.pfm",
            std::string("PF\n1 1\n-1.0\n") + std::string("\0\0\xc0\x7f", 4) + std::string(8, '\0'));
    succeeded(run_candela({"render", "--width=16", "--height=8", "-o", (d / "whole.png").string()}));
    const std::string png = d.read("whole.png");
    const auto refused = [&](const std::string& file, const std::string& reason) {
        const CommandResult result = render("color = { texture = \"" + file + "\" }", d);
        expect(result, 1, {"scene.toml:11:21: error: 'color' of object 'ring': ", file + "' " + reason});
        CHECK(result.err.find("error:") == result.err.rfind("error:"));
    };
    refused("wood.txt", "has a format that no image plugin reads");
    refused("wood.png", "cannot be read as a picture");
    refused("plain.ppm", "cannot be read as a picture: it is neither a binary PPM (P6) nor a PFM (PF)");
    refused("short.ppm", "cannot be read as a picture: it ends before its last pixel");
    refused("none.pfm", "cannot be read as a picture: a pixel is non-finite");
    // Truncated within the header, the pixels and the last chunk, and before that one.
    for (const std::size_t length : {std::size_t{20}, png.size() / 2, png.size() - 1, png.size() - 12}) {
        d.write("cut.png", png.substr(0, length));
        refused("cut.png", "cannot be read as a picture: it is cut off");
    }
    CHECK_FALSE(d.has("out.ppm"));
    expect(render("color = { texture = \"whole.png\" }", d), 0, {});
}

TEST_CASE("a picture of a few bytes that claims 400 million pixels does not take memory for them") {
    const Folder d;
    d.write("large.ppm", "P6\n20000 20000\n255\nabc");
    d.write("large.pfm", "PF\n20000 20000\n-1.0\nabc");
    // A header of TGA, then of BMP: true colour, 20000 x 20000 (0x4e20), uncompressed.
    const std::string side("\x20\x4e", 2), zero(2, '\0');
    d.write("large.tga",
            std::string("\0\0\2", 3) + std::string(9, '\0') + side + side + std::string("\x18\0abc", 5));
    d.write("large.bmp", "BM" + std::string("\x64\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0", 16) + side + zero +
                             side + zero + std::string("\1\0\x18\0", 4) + std::string(24, '\0') + "abc");
    for (const char* const file : {"large.ppm", "large.pfm", "large.tga", "large.bmp"}) {
        INFO(file);
        expect(render("color = { texture = \"" + std::string(file) + "\" }", d), 1,
               {"cannot be read as a picture: it "});
    }
    rusage usage{};
    REQUIRE(::getrusage(RUSAGE_CHILDREN, &usage) == 0);
    CHECK(usage.ru_maxrss < (1 << 20));  // in kilobytes, of the largest child so far
}

namespace {

/// A torus whose material has the given line.
CommandResult with_material(const std::string& line, const Folder& directory, const char* model = "phong",
                            const char* command = "check scene.toml") {
    directory.write("scene.toml", std::string("version = 1\nimage = { width = 16, height = 8 }\n"
                                              "observer = { position = [0, 0, 4], look_at = [0, 0, 0] }\n"
                                              "shading = { model = \"phong\" }\nreflection = { model = \"") +
                                      model +
                                      "\" }\n[[light]]\ntype = \"ambient\"\n[[object]]\nname = \"ring\"\n"
                                      "type = \"torus\"\n[object.material]\n" +
                                      line + "\n");
    return directory.run(command);
}

}  // namespace

TEST_CASE("mistakes in a parameter's texture are reported at their places") {
    const Folder d({{"wood.ppm", k_image}});
    expect(with_material("kd = { texture = \"wool.ppm\" }", d), 3,
           {"scene.toml:12:18: error: 'wool.ppm' does not exist", "did you mean 'wood.ppm'?"});
    expect(with_material("kd = { channel = \"r\" }", d), 3,
           {"scene.toml:12:6: error: 'kd' in [object.material] of 'ring'", "'texture'"});
    expect(with_material("kd = { texture = \"wood.ppm\", chanel = \"r\" }", d), 3,
           {"scene.toml:12:30: error:", "'chanel'", "channel"});
    expect(with_material("kd = { texture = \"wood.ppm\", channel = \"x\" }", d), 3,
           {"scene.toml:12:40: error: 'channel': \"x\" is not one of 'rgb', 'r', 'g', 'b', 'a'"});
    expect(with_material("shininess = { texture = \"wood.ppm\", scale = [1, 2, 3] }", d), 3,
           {"scene.toml:12:45: error: 'scale' of 'shininess' in [object.material] of 'ring' has three "
            "numbers; the parameter has one"});
    expect(with_material("kd = { texture = \"wood.ppm\", transform = 2 }", d), 3,
           {"scene.toml:12:42: error: 'transform' of 'kd'", "expected a table"});
    expect(with_material("kd = { texture = \"wood.ppm\", transform = { scale = [1, 2, 3] } }", d), 3,
           {"scene.toml:12:52: error: 'scale' has 3 numbers; expected two, along u and v"});
    expect(with_material("highlight = { texture = \"wood.ppm\" }", d, "toon"), 0, {});
    expect(with_material("bands = { texture = \"wood.ppm\" }", d, "toon"), 3,
           {"scene.toml:12:9: error: 'bands' in [object.material] of 'ring' cannot have a texture: its value "
            "is an integer"});
    expect(with_material("ior = { texture = \"wood.ppm\" }", d, "dielectric"), 3,
           {"scene.toml:12:7: error: 'ior' in [object.material] of 'ring' cannot have a texture: "
            "reflection/dielectric has the same parameters at every point"});
    expect(with_material("kd = { texture = \"wood.ppm\" }", d), 0, {});
}

TEST_CASE("a program that cannot have a parameter's texture is refused with its name") {
    const Folder d({{"wood.ppm", k_image}});
    expect(with_material("kd = { texture = \"wood.ppm\" }", d, "phong",
                         "generate scene.toml --target povray -o out"),
           1, {"can only approximate this scene", "the texture of 'kd' of object ring becomes its mean"});
    CHECK_FALSE(d.has("out"));
}

TEST_CASE("mistakes in an attribute of the vertices are reported at their places") {
    const Folder d({{"wood.ppm", k_image}});
    expect(with_material("kd = { attribute = \"\" }", d), 3,
           {"scene.toml:12:20: error: 'attribute' of 'kd' in [object.material] of 'ring' is empty"});
    expect(with_material("kd = { attribute = \"wear\", texture = \"wood.ppm\" }", d), 3,
           {"scene.toml:12:28: error: unknown key 'texture'", "attribute", "channel", "scale", "offset"});
    expect(with_material("kd = { attribute = \"wear\", wrap = \"clamp\" }", d), 3,
           {"scene.toml:12:28: error: unknown key 'wrap'"});
    expect(with_material("shininess = { attribute = \"wear\", scale = [1, 2, 3] }", d), 3,
           {"'scale' of 'shininess' in [object.material] of 'ring' has three numbers"});
    // A torus has none.
    expect(with_material("kd = { attribute = \"wear\" }", d, "phong", "render scene.toml -o out.ppm"), 1,
           {"scene.toml:", "'ring'", "wear"});
    CHECK_FALSE(d.has("out.ppm"));
    SECTION("also where a mesh lacks them") {
        d.write(
            "worn.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "property float wear\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
            "-1 -1 0 0\n1 -1 0 1\n1 1 0 1\n3 0 1 2\n");
        const auto mesh_with = [&](const char* material) {
            return render(std::string("file = \"worn.ply\"\n[object.material]\n") + material, d, "mesh");
        };
        expect(mesh_with("shininess = { attribute = \"ware\" }"), 1,
               {"'ring'", "worn.ply' has no vertex attribute 'ware'; it has 'wear'"});
        expect(
            mesh_with("kd = { attribute = \"wear\" }"), 1,
            {"has a vertex attribute 'wear' with 1 number, of which number 2 is needed", "channel = \"r\""});
        expect(mesh_with("kd = { attribute = \"wear\", channel = \"r\" }"), 0, {});
    }
}

TEST_CASE("explain shows the values that a material has at a pixel, and the texels they come from") {
    // One texel of 51 of 255: 0.2.
    const Folder d({{"dot.ppm", std::string("P6\n1 1\n255\n\x33\x66\xff", 14)}});
    const std::string material =
        "kd = { texture = \"dot.ppm\", encoding = \"linear\" }\nshininess = { texture = \"dot.ppm\", scale = "
        "10, offset = 3 }";
    const CommandResult result = with_material(material, d, "phong", "explain scene.toml --pixel 8,4");
    succeeded(result);
    CHECK(holds(result.out, "kd = [0.2, 0.4, 1]  texel (0, 0) of dot.ppm"));
    CHECK(holds(result.out, "shininess = 5  texel (0, 0) of dot.ppm"));
}

TEST_CASE("mistakes in a normal map or a bump map are reported at their place") {
    const Folder d({{"n.ppm", k_image}});
    expect(render("normal_map = \"n.ppm\"", d), 3,
           {"scene.toml:11:14: error: 'normal_map' of object 'ring' is a string, \"n.ppm\"; expected a "
            "table, such "
            "as { texture = \"normals.png\" }"});
    expect(render("bump_map = { texture = \"n.ppm\" }", d), 3, {"scene.toml:11:12: error: ", "'height'"});
    expect(render("normal_map = { texture = \"n.ppm\", height = 1 }", d), 3,
           {"scene.toml:11:35: error: unknown key 'height'", "texture", "scale", "wrap", "transform"});
    expect(render("normal_map = { texture = \"m.ppm\" }", d), 3,
           {"scene.toml:11:26: error: 'm.ppm' does not exist", "did you mean 'n.ppm'?"});
    expect(render("normal_map = { texture = \"n.ppm\", transform = { scale = [1, 2, 3] } }", d), 3,
           {"'scale' has 3 numbers; expected two, along u and v"});
    expect(
        render("normal_map = { texture = \"n.ppm\" }\nbump_map = { texture = \"n.ppm\", height = 1 }", d), 3,
        {"scene.toml:12:1: error: object 'ring' has a 'normal_map' and a 'bump_map'; expected one of them"});
    d.write("stl.stl",
            "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
            "endfacet\nendsolid s\n");
    expect(render("file = \"stl.stl\"\nnormal_map = { texture = \"n.ppm\" }", d, "mesh"), 3,
           {"scene.toml:12:26: error: object 'ring' has no texture coordinates, which a texture needs",
            "remove normal_map"});
}

TEST_CASE("a picture does not replace a texture of the scene that it shows") {
    for (const char* const key :
         {"normal_map = { texture = \"wood.ppm\" }", "bump_map = { texture = \"wood.ppm\", height = 1 }",
          "[object.material]\nks = { texture = \"wood.ppm\" }",
          "[object.material]\nemission = { texture = \"wood.ppm\" }",
          "[object.material]\nocclusion = { texture = \"wood.ppm\" }"}) {
        const Folder d({{"wood.ppm", k_image}});
        expect(render(key, d), 0, {});
        expect(d.run("render scene.toml -o wood.ppm"), 2,
               {"wood.ppm", "the files that the scene is made from"});
        CHECK(d.read("wood.ppm") == k_image);
    }
}

TEST_CASE("a normal map without effect draws a warning, and a target without bump maps refuses it") {
    const Folder d({{"n.ppm", k_image}});
    const std::string map = "bump_map = { texture = \"n.ppm\", height = 0.1 }";
    expect(render(map + "\nshading = \"gouraud\"", d), 0,
           {"scene.toml:11:24: warning: 'bump_map' of object 'ring' has no effect: shading/gouraud evaluates "
            "light once per vertex"});
    CHECK(render(map, d).err.find("warning") == std::string::npos);
    expect(d.run("generate scene.toml --target povray -o pov"), 1,
           {"can only approximate this scene", "the bump map of object ring is left out"});
    render(map, d, "sphere");
    const CommandResult explained = succeeded(d.run("explain scene.toml --pixel 8,4"));
    for (const char* const part : {"N_shading = [", "slopes = [", "of n.ppm", "N = ["})
        CHECK(explained.out.find(part) != std::string::npos);
    // Written again, it is the same scene.
    const CommandResult written = d.run("check scene.toml --print");
    succeeded(written);
    CHECK(written.out.find("height = 0.1") != std::string::npos);
}
