// What a model's file says beside its triangles, in the words of a scene.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
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

/// What a surface mirrors: light of a metal's colour, and that of what is not a metal.
struct Metal {
    double share = 0;  // of the metal, 0 to 1
    Vector color{}, below{};

    /// As a parameter: one number where it is grey.
    std::vector<double> highlights() const;
};

struct Material {
    std::string name;  // may be empty
    std::string reflection = "phong";
    Vector color{255, 255, 255};                                        // 0-255
    std::vector<std::pair<std::string, std::vector<double>>> values{};  // of the reflection model
    std::optional<std::size_t> picture{};                               // of Model::pictures
    bool clamps = false;                                                // it, at its edges
    std::optional<std::size_t> cutout{};                                // of Model::cutouts
    double cutout_level = 0.5;
    Metal metal{};
};

/// From where triangles are seen: as the shape's parameter `sides` has it.
enum class Sides { outside, front, both };

/// The triangles of one material.
struct Part {
    std::string selector;                   // as the shape's parameter `part` has it; empty: all
    std::optional<std::size_t> material{};  // of Model::materials
    bool is_flat = false;                   // it has no normals, and is not smooth
    Sides sides = Sides::outside;
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
    std::vector<Picture> cutouts;  // greymaps of what is opaque
    std::optional<Camera> camera;
    std::vector<Light> lights;
    bool is_z_up = false;
    std::vector<std::string> notes;  // whole sentences without a full stop, each once

    void note(std::string sentence);
    /// One line for each kind of loss: `one` where it is called once, otherwise `many` with the count in
    /// place of its {}.
    void count(const std::string& kind, std::string one, std::string_view many);

  private:
    struct Counted {
        std::size_t note, count;
        std::string many;
    };
    std::map<std::string, Counted> counted_;
};

}  // namespace importing
