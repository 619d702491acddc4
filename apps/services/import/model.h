// The contents of a model's file other than its triangles, in a scene's terms.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace importing {

using Vector = std::array<double, 3>;

/// Encodes a linear colour for a scene.
Vector encoded(const std::vector<double>& linear);

/// The columns of a transformation to the world.
struct Placement {
    Vector x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{};

    Vector direction(const Vector& v) const {
        Vector r{};
        for (std::size_t k = 0; k < 3; ++k) r[k] = v[0] * x[k] + v[1] * y[k] + v[2] * z[k];
        return r;
    }
    Vector point(const Vector& v) const {
        Vector r = direction(v);
        for (std::size_t k = 0; k < 3; ++k) r[k] += origin[k];
        return r;
    }
};

/// A placement over time.
struct Motion {
    static constexpr std::size_t k_most_times = 100'000;

    std::vector<double> times;    // of its keys, in seconds, increasing: at least one
    std::vector<double> jumps{};  // times at which it jumps
    bool has_steps_only = false;  // it rests between its keys
    std::size_t cost = 1;         // cost of calling `at`, in nodes
    std::function<Placement(double)> at;
};

/// A value that changes with time.
struct Track {
    std::string name;  // its name in the table of the moving thing
    bool steps = false;
    std::vector<std::pair<double, Vector>> keys{};  // seconds, value
};

/// A picture for surfaces: an existing file, or the content of one to write.
struct Image {
    std::filesystem::path file;  // absolute; or the name to give it
    std::string content{};       // empty: the file exists
    double brightness = 1;       // the mean of its pixels' largest channels, linear
};

/// How a picture lies on a surface: texture coordinates are scaled, rotated, then moved.
struct Placing {
    std::array<double, 2> scale{1, 1};
    double rotation = 0;  // degrees, counter-clockwise
    std::array<double, 2> offset{0, 0};
    // In a scene's words:
    std::string_view wrap = "repeat", wrap_v = "repeat";
    int uv = 0;  // which texture coordinates

    bool is_transformed() const {
        return scale != std::array{1.0, 1.0} || rotation != 0 || offset != std::array{0.0, 0.0};
    }
};

/// In four digits.
double rounded(double number);
/// The same; one number if all are equal.
std::vector<double> shortened(std::vector<double> numbers);

/// A picture from which a parameter takes its value at each point: offset + scale * texel; or an attribute of
/// the vertices instead of the texel.
struct ParameterMap {
    std::string parameter;
    std::size_t image = 0;                    // index in Model::images
    std::string attribute{};                  // instead of it
    std::string channel{};                    // r, g, b or a; empty: all three, encoded like colours
    std::vector<double> scale{1}, offset{0};  // one number or three
    Placing placing{};
};

struct Material {
    std::string name;  // may be empty
    std::string reflection = "phong";
    Vector color{255, 255, 255};                                        // 0-255
    std::vector<std::pair<std::string, std::vector<double>>> values{};  // parameters of the reflection model
    std::vector<ParameterMap> maps{};       // of parameters whose means are in `values`
    std::optional<ParameterMap> normals{};  // a normal map, whose scale makes it steeper
    bool has_heights = false;               // it is a bump map instead, and its scale the height of white
    Vector emission{0, 0, 0};               // 0-255, unless it is one of the maps
    double emission_strength = 1;
    std::optional<ParameterMap> color_map{};  // instead of `color`
};

/// Makes linear intensities of any brightness the emission of a material: a colour and its strength.
void set_emission(const std::vector<double>& intensity, Material& to);

/// The side from which triangles are visible, as for the shape's parameter `sides`.
enum class Sides { outside, front, both };

/// The triangles of one material.
struct Part {
    std::string selector;                   // as for the shape's parameter `part`; empty: all
    std::optional<std::size_t> material{};  // index in Model::materials
    bool is_flat = false;                   // it has no normals and is not smooth
    Sides sides = Sides::outside;
    std::shared_ptr<const Motion> motion{};  // of the file's coordinates
    std::vector<Track> tracks{};             // the motion as tracks
};

struct Camera {
    Vector position{}, towards{}, up{};  // `towards`: a direction
    bool is_orthographic = false;
    double extent = 0;  // the full vertical angle in degrees, or metres
    double aspect = 0;  // width to height; 0: unspecified
    std::shared_ptr<const Motion> motion{};
    std::vector<Track> tracks{};
};

struct Light {
    std::string name;
    std::string type;  // point, spot, directional; chosen ones also ambient, studio
    Vector color{255, 255, 255};
    double intensity = 1;      // in Candela's terms: at one metre, without 1 / pi
    bool is_physical = false;  // the file has it in candela or lux
    Vector position{}, direction{};
    double inner_angle = 0, outer_angle = 45;  // half angles, degrees
    double rotation = 0;                       // of a studio, degrees
    std::shared_ptr<const Motion> motion{};
    std::vector<Track> tracks{};

    bool has_position() const { return type == "point" || type == "spot"; }
};

/// The animations of a file.
struct Moving {
    std::vector<std::string> names{};  // of all animations; may be empty
    double length = 0;                 // of the first, in seconds
    bool has_splines = false;
    std::size_t in_pieces = 0;  // objects moved by several nodes
    std::size_t too_many = 0;   // motions with too many keys
    std::size_t undone = 0;     // motions that cannot be separated from the rest placement
    std::size_t skins = 0, weights = 0, channels = 0;  // not imported
};

/// The contents of a file, and what was lost.
struct Model {
    std::vector<Material> materials;
    std::vector<Part> parts;  // at least one
    std::vector<Image> images;
    std::optional<Camera> camera;
    std::vector<Light> lights;
    Moving moving{};
    bool is_z_up = false;
    std::vector<std::string> notes;  // whole sentences without a full stop, each once

    void note(std::string sentence);
    /// One line for each kind of loss: `one` if it is counted once, otherwise `many` with the count in place
    /// of its {}.
    void count(const std::string& kind, std::string one, std::string_view many);

  private:
    struct Counted {
        std::size_t note, count;
        std::string many;
    };
    std::map<std::string, Counted> counted_;
};

}  // namespace importing
