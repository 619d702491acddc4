// What a scene holds.
module;

#include "candela/api.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

export module candela.scene:content;

import :animation;
import candela.color;
import candela.diagnostics;
import candela.math;
import candela.parameters;
import candela.transform;

export namespace candela {

/// An axis-aligned box centred on the origin: x within width/2, y (up) within height/2, z within depth/2.
/// Metres.
struct Room {
    float height = 10;
    float width = 10;
    float depth = 10;

    friend bool operator==(const Room&, const Room&) = default;
};

/// How strictly a scene as a whole is checked.
struct ConstraintSettings {
    std::optional<Severity> overlap = Severity::error;  // of objects with each other; none: not looked at

    friend bool operator==(const ConstraintSettings&, const ConstraintSettings&) = default;
};

struct Observer {
    Vec3 position;
    Vec3 look_at;
    Vec3 up{0, 1, 0};
    Projection projection = Projection::perspective;
    float fov = 40;    // perspective: full vertical angle, degrees
    float height = 4;  // orthographic: height of the view, metres
    /// Width to height of the frame that every picture shows whole; 0: none, and a narrow picture cuts off
    /// the sides.
    float frame_aspect = 0;
    SourcePlace position_place{};

    /// Ignores where it is in its file.
    friend inline bool operator==(const Observer& a, const Observer& b) {
        return a.position == b.position && a.look_at == b.look_at && a.up == b.up &&
               a.projection == b.projection && a.fov == b.fov && a.height == b.height &&
               a.frame_aspect == b.frame_aspect;
    }
};

/// The observer of a picture of that size: one narrower than the frame sees more above and below instead of
/// less at the sides.
CANDELA_API Observer fitted(Observer observer, int width, int height);

struct ImageSettings {
    int width = 512;
    int height = 512;
    int samples = 1;
    Vec3 background;            // 0-255
    std::string environment{};  // absolute path of an equirectangular environment map; empty: the background
    SourcePlace environment_place{};
    ColorEncoding color_management = ColorEncoding::srgb;

    /// Ignores where it is in its file.
    friend inline bool operator==(const ImageSettings& a, const ImageSettings& b) {
        return a.width == b.width && a.height == b.height && a.samples == b.samples &&
               a.background == b.background && a.environment == b.environment &&
               a.color_management == b.color_management;
    }
};

/// A plugin with values for its parameters.
struct Model {
    std::string name;
    ParamSet parameters;

    friend bool operator==(const Model&, const Model&) = default;
};

/// The name in a label of a light or an object: lamp in 'lamp'. None where the label is an index.
CANDELA_API std::optional<std::string_view> name_of_label(std::string_view label) noexcept;

struct LightSource {
    std::string label;  // 'lamp', as the scene's author calls it, or an index
    Model model;
    SourcePlace place;
    SourcePlace position_place{};  // of its 'position', or of the whole light

    /// Ignores where they are in their files.
    friend inline bool operator==(const LightSource& a, const LightSource& b) {
        return a.label == b.label && a.model == b.model;
    }
};

/// What a texture shows beyond its edges.
enum class TextureWrap : int {
    repeat,  // the picture again
    clamp,   // the colours at its edge
};

struct Object {
    std::string label;
    Model shape;
    Transform transform;
    Vec3 color;                   // 0-255
    std::string color_texture{};  // absolute path of a picture that `color` is multiplied with; empty: none
    TextureWrap color_texture_wrap = TextureWrap::repeat;
    bool encloses = false;  // others may be inside; drawn from both sides
    Model shading;
    Model reflection;
    SourcePlace place;
    SourcePlace position_place{};  // of its 'position', or of the whole object
    SourcePlace texture_place{};   // of its 'color_texture', or of the whole object

    /// Ignores where they are in their files.
    friend inline bool operator==(const Object& a, const Object& b) {
        return a.label == b.label && a.shape == b.shape && a.transform == b.transform && a.color == b.color &&
               a.color_texture == b.color_texture && a.color_texture_wrap == b.color_texture_wrap &&
               a.encloses == b.encloses && a.shading == b.shading && a.reflection == b.reflection;
    }
};

/// One frame, if it is animated. Every value has been checked; every plugin named is installed (none is
/// loaded). Constraints that only triangles can decide come later: candela.constraints.
struct Scene {
    Room room;
    Observer observer;
    ImageSettings image;
    ConstraintSettings constraints;
    std::vector<LightSource> lights;
    std::vector<Object> objects;
    std::optional<Animation> animation{};  // of which this is one frame

    friend CANDELA_API bool operator==(const Scene& a, const Scene& b);
};

/// A scene as far as it was understood, so that the rest can be checked as well.
struct SceneDraft {
    Scene scene;  // without the lights and objects whose kind, shape or place is unknown
    bool has_room = true;
    bool has_observer = true;                    // its position is known
    bool is_complete = true;                     // there were no errors
    SourcePlace picture_place{};                 // of what says how large the picture is
    std::vector<std::filesystem::path> files{};  // all that were read, as absolute paths
};

}  // namespace candela
