// Random valid scenes, equal for equal seeds, as TOML tables, so that a test can break one of their
// constraints.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

import candela.core;

/// A table of a scene file.
struct SceneTable {
    std::string header;  // "[room]", "[[light]]"; empty: the file's own keys
    std::vector<std::pair<std::string, std::string>> entries{};  // keys, and values as TOML

    /// The value of a key as TOML, or null.
    const std::string* find(const std::string& key) const;
    /// Sets a key, whether or not it exists.
    void set(const std::string& key, const std::string& value);
    void erase(const std::string& key);
};

/// Everything lies in its own cell of a grid that fills the room: the observer, each light with a position,
/// each object.
struct RandomScene {
    /// A sphere that contains a whole object.
    struct Bounds {
        candela::Vec3 center;
        float radius = 0;
    };

    std::vector<SceneTable> tables;  // in a valid order for writing
    float width = 10, height = 10, depth = 10;
    candela::Vec3 observer;
    std::vector<candela::Vec3> light_positions;  // of the lights that have one
    std::vector<Bounds> objects;

    /// The whole file.
    std::string text() const;
    /// The number of tables with that header.
    std::size_t count(const std::string& header) const;
    /// The `index`-th table with that header. Throws std::out_of_range if there is none.
    SceneTable& table(const std::string& header, std::size_t index = 0);
};

/// A valid scene, which may draw warnings. Plugins and the ranges of their parameters come from the
/// manifests.
RandomScene random_scene(unsigned seed);
