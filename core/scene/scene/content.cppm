// What a scene holds.
module;

#include <string>
#include <vector>

export module candela.scene:content;

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
    Severity overlap = Severity::error;  // of objects with each other

    friend bool operator==(const ConstraintSettings&, const ConstraintSettings&) = default;
};

struct Observer {
    Vec3 position;
    Vec3 look_at;
    Vec3 up{0, 1, 0};
    Projection projection = Projection::perspective;
    float fov = 40;    // perspective: full vertical angle, degrees
    float height = 4;  // orthographic: height of the view, metres
    SourcePlace position_place{};

    /// Ignores where it is in its file.
    friend inline bool operator==(const Observer& a, const Observer& b) {
        return a.position == b.position && a.look_at == b.look_at && a.up == b.up &&
               a.projection == b.projection && a.fov == b.fov && a.height == b.height;
    }
};

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

struct Object {
    std::string label;
    Model shape;
    Transform transform;
    Vec3 color;             // 0-255
    bool encloses = false;  // others may be inside; drawn from both sides
    Model shading;
    Model reflection;
    SourcePlace place;
    SourcePlace position_place{};  // of its 'position', or of the whole object

    /// Ignores where they are in their files.
    friend inline bool operator==(const Object& a, const Object& b) {
        return a.label == b.label && a.shape == b.shape && a.transform == b.transform && a.color == b.color &&
               a.encloses == b.encloses && a.shading == b.shading && a.reflection == b.reflection;
    }
};

/// Every value has been checked; every plugin named is installed (none is loaded). Constraints that only
/// triangles can decide come later: candela.constraints.
struct Scene {
    Room room;
    Observer observer;
    ImageSettings image;
    ConstraintSettings constraints;
    std::vector<LightSource> lights;
    std::vector<Object> objects;

    friend bool operator==(const Scene&, const Scene&) = default;
};

}  // namespace candela
