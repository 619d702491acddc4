// A scene: read from files, checked, immutable.
module;

#include "candela/api.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

export module candela.scene;

import candela.diagnostics;
import candela.document;
import candela.math;
import candela.params;
import candela.plugins;

export namespace candela {

/// An axis-aligned box centred on the origin: x within width/2, y (up) within height/2, z within depth/2.
/// Metres.
struct Room {
    float height = 10;
    float width = 10;
    float depth = 10;
};

struct Observer {
    Vec3 position;
    Vec3 look_at;
    Vec3 up{0, 1, 0};
    Projection projection = Projection::perspective;
    float fov = 40;    // perspective: full vertical angle, degrees
    float height = 0;  // orthographic: metres that fit the picture's height
};

struct ImageSettings {
    int width = 512;
    int height = 512;
    int samples = 1;
    Vec3 background;  // 0-255
    ColorEncoding color_management = ColorEncoding::srgb;
};

/// A plugin, and values for its parameters.
struct Model {
    std::string name;
    ParamSet parameters;
};

struct LightSource {
    std::string label;  // 'lamp', as the scene's author calls it, or number 2
    Model model;
    SourcePlace place;
};

struct Object {
    std::string label;
    Model shape;
    Placement placement;
    Vec3 color;  // 0-255
    Model shading;
    Model reflection;
    SourcePlace place;
};

/// Every value has been checked; every plugin named is installed (none is loaded).
struct Scene {
    Room room;
    Observer observer;
    ImageSettings image;
    std::vector<LightSource> lights;
    std::vector<Object> objects;
};

/// A value given on the command line: it goes before what the files say.
struct Setting {
    std::string flag;   // as in diagnostics: "--width", "--set object.box.size"
    std::string path;   // "image.width", "light.lamp.intensity", "object.0.material.kd"
    std::string value;  // as it would stand in the file; bare words are strings
};

struct SceneRequest {
    std::vector<std::filesystem::path> files;  // merged; none: the default scene
    std::vector<Setting> settings;
    std::optional<std::string> shading;                    // for every object, whatever the files say
    std::optional<std::string> reflection;                 // likewise
    bool use_defaults = false;                             // where no shading or reflection model is named
    std::function<bool(const std::string& question)> ask;  // asked instead of failing then; may be empty
};

/// Reads, merges and checks. Reports all that is wrong, and returns a scene if nothing but warnings were
/// found.
CANDELA_API std::optional<Scene> read_scene(const SceneRequest& request, Registry& registry,
                                            Diagnostics& diagnostics);

/// The built-in scene: one cube, one point light in the centre of the room, Phong shading, Phong reflection
/// (R12, R14).
CANDELA_API std::string_view default_scene_text() noexcept;

/// What a table of the scene file may hold, beside what plugins declare.
struct TableSchema {
    std::string name;   // "image", "light"
    std::string title;  // as written in a file: "[image]", "[[light]]"
    std::string meaning;
    std::vector<Parameter> parameters;
};

/// The tables of the scene file, in the order in which people write them.
CANDELA_API std::span<const TableSchema> scene_schema();

}  // namespace candela

// What the files, the includes and the settings say together; shared by this module's own units.
namespace candela {

struct MergedDocument {
    SourcePlace place;  // of the first file
    TableNode root;     // as if all stood in one file, `include` followed
};

std::optional<MergedDocument> gather(const SceneRequest& request, Diagnostics& diagnostics);

}  // namespace candela
