// A model as the text of a scene.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "import/model.h"

namespace importing {

/// What a scene needs beside the model itself.
struct Setting {
    std::string file;                   // the model's, as the scene names it
    std::vector<std::string> pictures;  // likewise, of Model::pictures
    std::vector<std::string> cutouts;   // likewise, of Model::cutouts
    Camera camera;
    Vector look_at{};
    Vector room{};  // width, height, depth
    std::vector<Light> lights;
    bool has_vertex_colors = false;
    bool is_textured = false;  // it has texture coordinates
    bool is_closed = false;
    std::string origin{};  // of the mesh, in the file's coordinates; empty: its own
    bool allows_outside = false;
    double tolerance = 0;  // of places
    int frames = 0;        // 0: nothing moves
};

/// A vector as the scene has it: in six digits, and where these are off by more than `tolerance`, in as many
/// as single precision has.
std::string vector_text(const Vector& v, double tolerance = std::numeric_limits<double>::infinity());

std::string scene_text(const Model& model, const Setting& setting);

}  // namespace importing
