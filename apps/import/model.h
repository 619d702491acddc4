// What a model's file says beside its triangles, in the words of a scene.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace importing {

using Vector = std::array<double, 3>;

/// A picture for surfaces: a file that is there, or the content of one that has to be written.
struct Picture {
    std::filesystem::path file;  // absolute; or the name that it should have
    std::string content{};       // empty: it is there
    double brightness = 1;       // the mean of its pixels' largest channels, linear
};

struct Material {
    std::string name;  // may be empty
    std::string reflection = "phong";
    Vector color{255, 255, 255};                                        // 0-255
    std::vector<std::pair<std::string, std::vector<double>>> values{};  // of the reflection model
    std::optional<std::size_t> picture{};                               // of Model::pictures
    bool clamps = false;                                                // it, at its edges
};

/// The triangles of one material.
struct Part {
    std::string selector;                   // as the shape's parameter `part` has it; empty: all
    std::optional<std::size_t> material{};  // of Model::materials
};

struct Camera {
    Vector position{}, towards{}, up{};  // `towards`: a direction
    bool is_orthographic = false;
    double extent = 0;  // the full vertical angle in degrees, or metres
    double aspect = 0;  // width to height; 0: not said
};

struct Light {
    std::string name;
    std::string type;  // point, spot, directional
    Vector color{255, 255, 255};
    double intensity = 1;  // as Candela has it: at one metre, before 1 / pi
    Vector position{}, direction{};
    double inner_angle = 0, outer_angle = 45;  // half angles, degrees

    bool has_position() const { return type == "point" || type == "spot"; }
};

/// What a file says, and what of it was lost.
struct Model {
    std::vector<Material> materials;
    std::vector<Part> parts;  // at least one
    std::vector<Picture> pictures;
    std::optional<Camera> camera;
    std::vector<Light> lights;
    bool is_z_up = false;
    std::vector<std::string> notes;  // whole sentences without a full stop, each once

    void note(std::string sentence);
    /// Notes a loss of a kind of which there may be many: the first as a sentence, the others by their
    /// number, which count_notes() adds at the end.
    void note_one_of(const std::string& kind, std::string sentence);
    void count_notes();

  private:
    struct Kind {
        std::size_t note = 0;  // of `notes`
        std::size_t more = 0;
    };
    std::map<std::string, Kind> kinds_;
};

}  // namespace importing
