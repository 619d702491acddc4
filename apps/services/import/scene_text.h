// A model as the text of a scene.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "import/model.h"

namespace importing {

/// The data that a scene needs in addition to the model itself.
struct Setting {
    std::string file;                 // the model's file, as named in the scene
    std::vector<std::string> images;  // names of Model::pictures in the scene
    Camera camera;
    Vector look_at{};
    Vector room{};  // width, height, depth
    std::vector<Light> lights;
    std::optional<double> exposure{};  // an exposure value at ISO 100
    bool has_vertex_colors = false;
    bool is_textured = false;  // it has texture coordinates
    bool is_closed = false;
    std::string origin{};  // of the mesh, in the file's coordinates; empty: unchanged
    bool allows_outside = false;
    double tolerance = 0;  // of positions
    int frames = 0;        // 0: nothing moves
};

/// A vector in a scene's notation: in six digits, or in all digits of single precision if those are off by
/// more than `tolerance`.
std::string vector_text(const Vector& v, double tolerance = std::numeric_limits<double>::infinity());

std::string scene_text(const Model& model, const Setting& setting);

}  // namespace importing
