#include <candela/plugin_test.h>

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace {

/// One triangle, for every object.
class Triangle final : public candela::ExportedGeometry {
  public:
    candela::ExportedMesh in_object_space(std::size_t object) override { return in_world_space(object); }
    candela::ExportedMesh in_world_space(std::size_t) override {
        candela::ExportedMesh mesh;
        mesh.vertex_count = 3;
        mesh.indices = indices_;
        mesh.position = {x_.data(), y_.data(), z_.data()};
        return mesh;
    }
    bool has_default_normals(std::size_t, std::size_t) override { return true; }

  private:
    std::array<std::uint32_t, 3> indices_{0, 1, 2};
    std::array<float, 3> x_{0, 1, 0}, y_{0, 0, 0.5f}, z_{2, 2, 2};
};

class Files final : public candela::FileSink {
  public:
    void write(const char* name, std::span<const std::byte> content) override {
        for (const std::byte b : content) text[name] += static_cast<char>(b);
    }
    std::map<std::string, std::string> text;
};

}  // namespace

TEST_CASE("two objects of one triangle each: the second one's vertices are 4, 5 and 6") {
    const auto target = candela::sdk::make<candela::Target>(CANDELA_PLUGIN_DIR, "@NAME@");
    Triangle triangle;
    std::array<candela::ExportedObject, 2> objects{};
    objects[0].label = "left";
    objects[1].label = "right";
    candela::ExportedScene scene;
    scene.objects = objects;
    scene.geometry = &triangle;
    Files files;
    target->write(scene, files);
    const std::string vertices = "v 0 0 2\nv 1 0 2\nv 0 0.5 2\n";
    CHECK(files.text[target->main_file()] == "o left\n" + vertices + "f 1 2 3\no right\n" + vertices + "f 4 5 6\n");
}
