// dump_scene SCENE.toml OUT: a scene of point lights and of Phong's models as plain numbers (scene_dump.h).
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "console/diagnostics_text.h"
#include "scene_dump.h"

import candela.core;

namespace {

template <class T>
void put(std::ofstream& out, const T* values, std::size_t count) {
    out.write(reinterpret_cast<const char*>(values), static_cast<std::streamsize>(count * sizeof(T)));
}

void put_vectors(std::ofstream& out, const candela::Vec3Arrays& arrays) {
    std::vector<float> all;
    for (std::size_t i = 0; i < arrays.size(); ++i)
        all.insert(all.end(), {arrays.x[i], arrays.y[i], arrays.z[i]});
    put(out, all.data(), all.size());
}

void set(float (&to)[3], candela::Vec3 from) {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

candela::ParamValue value_of(const candela::ParamSet& set, const char* name,
                             candela::ColorEncoding encoding) {
    return set.runtime(encoding).at(set.index_of(name));
}

int run(const std::string& scene_file, const std::string& out_file) {
    candela::Registry registry(candela::plugin_search_path({}));
    candela::Diagnostics diagnostics;
    candela::SceneRequest request;
    if (scene_file != "-") request.files = {scene_file};
    const auto scene = candela::read_scene(request, registry, diagnostics);
    const auto compiled = scene ? candela::build(*scene, registry, diagnostics) : std::nullopt;
    std::cerr << diagnostics_text(diagnostics, false);
    if (!compiled) return 1;
    const candela::ColorEncoding encoding = scene->image.color_management;

    std::ofstream out(out_file, std::ios::binary);
    bench::DumpHeader header;
    header.lights = static_cast<std::uint32_t>(scene->lights.size());
    header.objects = static_cast<std::uint32_t>(scene->objects.size());
    set(header.eye, scene->observer.position);
    set(header.look_at, scene->observer.look_at);
    set(header.up, scene->observer.up);
    header.fov = scene->observer.fov;
    const candela::Rgb background = candela::decoded(scene->image.background, encoding);
    set(header.background, {background.r, background.g, background.b});
    put(out, &header, 1);
    for (const candela::LightSource& light : scene->lights) {
        bench::DumpLight dump;
        const auto color = value_of(light.model.parameters, "color", encoding);
        const float intensity = value_of(light.model.parameters, "intensity", encoding).number[0];
        const auto position = value_of(light.model.parameters, "position", encoding);
        for (int c = 0; c < 3; ++c) {
            dump.position[c] = position.number[c];
            dump.color[c] = color.number[c] * intensity;
        }
        put(out, &dump, 1);
    }
    for (std::size_t i = 0; i < scene->objects.size(); ++i) {
        const candela::Mesh& mesh = compiled->objects[i].mesh;
        const candela::ParamSet& material = scene->objects[i].reflection.parameters;
        const candela::Rgb color = compiled->objects[i].surface.color;
        bench::DumpObject dump;
        dump.vertices = static_cast<std::uint32_t>(mesh.vertex_count());
        dump.triangles = static_cast<std::uint32_t>(mesh.triangle_count());
        dump.closed = mesh.closed ? 1 : 0;
        const auto kd = value_of(material, "kd", encoding), ks = value_of(material, "ks", encoding);
        set(dump.diffuse, {kd.number[0] * color.r, kd.number[1] * color.g, kd.number[2] * color.b});
        set(dump.specular, {ks.number[0], ks.number[1], ks.number[2]});
        dump.shininess = value_of(material, "shininess", encoding).number[0];
        put(out, &dump, 1);
        put_vectors(out, mesh.position);
        put_vectors(out, mesh.vertex_normals());
        put(out, mesh.indices.data(), mesh.indices.size());
    }
    return out.flush() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "dump_scene SCENE.toml|- OUT\n";
        return 2;
    }
    try {
        return run(argv[1], argv[2]);
    } catch (const std::exception& problem) {
        std::cerr << "dump_scene: " << problem.what() << '\n';
        return 1;
    }
}
