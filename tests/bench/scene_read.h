// Reads the file of scene_dump.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "scene_dump.h"

namespace bench {

struct Scene {
    DumpHeader header;
    std::vector<DumpLight> lights;
    struct Object {
        DumpObject head;
        std::vector<float> position, normal;
        std::vector<std::uint32_t> indices;
    };
    std::vector<Object> objects;
};

template <class T>
void get(std::ifstream& in, T* values, std::size_t count) {
    in.read(reinterpret_cast<char*>(values), static_cast<std::streamsize>(count * sizeof(T)));
    if (!in) throw std::runtime_error("the scene's file ends too early");
}

inline Scene read_scene(const char* path) {
    std::ifstream in(path, std::ios::binary);
    Scene scene;
    get(in, &scene.header, 1);
    scene.lights.resize(scene.header.lights);
    get(in, scene.lights.data(), scene.lights.size());
    scene.objects.resize(scene.header.objects);
    for (Scene::Object& o : scene.objects) {
        get(in, &o.head, 1);
        o.position.resize(3 * std::size_t{o.head.vertices});
        o.normal.resize(3 * std::size_t{o.head.vertices});
        o.indices.resize(3 * std::size_t{o.head.triangles});
        get(in, o.position.data(), o.position.size());
        get(in, o.normal.data(), o.normal.size());
        get(in, o.indices.data(), o.indices.size());
    }
    return scene;
}

}  // namespace bench
