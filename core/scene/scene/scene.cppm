// A scene: read from files, validated, immutable.
module;

#include "candela/api.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

export module candela.scene;

import candela.color;
import candela.diagnostics;
import candela.math;
import candela.parameters;
import candela.registry;
import candela.toml;
import candela.transform;
import candela.validation;

export namespace candela {

/// An axis-aligned box centred on the origin: x within width/2, y (up) within height/2, z within depth/2.
/// Metres.
struct Room {
    float height = 10;
    float width = 10;
    float depth = 10;

    friend bool operator==(const Room&, const Room&) = default;
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

    /// Ignores where they are in their file.
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
    Vec3 color;  // 0-255
    Model shading;
    Model reflection;
    SourcePlace place;
    SourcePlace position_place{};  // of its 'position', or of the whole object

    /// Ignores where they are in their files.
    friend inline bool operator==(const Object& a, const Object& b) {
        return a.label == b.label && a.shape == b.shape && a.transform == b.transform && a.color == b.color &&
               a.shading == b.shading && a.reflection == b.reflection;
    }
};

/// Every value has been checked; every plugin named is installed (none is loaded). Constraints that only
/// triangles can decide come later: candela.constraints.
struct Scene {
    Room room;
    Observer observer;
    ImageSettings image;
    std::vector<LightSource> lights;
    std::vector<Object> objects;

    friend bool operator==(const Scene&, const Scene&) = default;
};

/// A value given on the command line, which overrides the files.
struct Setting {
    std::string flag;   // as in diagnostics: "--width", "--set object.box.size"
    std::string path;   // "image.width", "light.lamp.intensity", "object.0.material.kd"
    std::string value;  // as it would be written in the file; bare words are strings
};

struct SceneRequest {
    std::vector<std::filesystem::path> files;  // merged; none: the default scene
    std::vector<Setting> settings;
    std::optional<std::string> shading;                    // for every object, overriding the files
    std::optional<std::string> reflection;                 // likewise
    bool use_defaults = false;                             // if no shading or reflection model is named
    std::function<bool(const std::string& question)> ask;  // called instead of failing then; may be empty
};

/// A scene as far as it was understood, so that the rest can be checked as well.
struct SceneDraft {
    Scene scene;  // without the lights and objects that have errors
    bool has_room = true;
    bool has_observer = true;
    bool is_complete = true;  // there were no errors
};

/// Reads, merges and validates. Reports all problems; returns nothing if a file cannot be read as TOML.
CANDELA_API std::optional<SceneDraft> draft_scene(const SceneRequest& request, Registry& registry,
                                                  Diagnostics& diagnostics);

/// Same, but returns the scene only if nothing worse than warnings was found.
CANDELA_API std::optional<Scene> read_scene(const SceneRequest& request, Registry& registry,
                                            Diagnostics& diagnostics);

/// A scene as one file, which reads back as the same scene: all defaults filled in, absolute paths. Throws
/// Error (failure) if the format cannot express a scene that did not come from a file: texts that are not
/// UTF-8, fractional colours, labels that are not quoted names, shading parameters that differ between
/// objects.
CANDELA_API std::string scene_text(const Scene& scene);

/// The built-in scene: one cube, one point light in the centre of the room, Phong shading, Phong reflection
/// (R12, R14).
CANDELA_API std::string_view default_scene_text() noexcept;

/// A key whose value is the name of a plugin.
struct PluginKey {
    std::string key;  // "type"
    PluginKind kind = PluginKind::light;
    /// Where in the table the plugin's parameters are: beside the key (""), or in a nested table
    /// ("material"). Nothing: not in this table.
    std::optional<std::string> parameters_in{};
};

/// What a table of the scene file may contain, apart from what plugins declare.
struct TableSchema {
    std::string name;   // "image", "light"
    std::string title;  // as written in a file: "[image]", "[[light]]"
    std::string meaning;
    std::vector<Parameter> parameters;
    bool repeated = false;             // may occur any number of times
    std::vector<PluginKey> plugins{};  // which of the parameters name plugins
    std::vector<std::string> lists{};  // which of the parameters are lists of such values
};

/// The tables of the scene file, in the order in which people write them.
CANDELA_API std::span<const TableSchema> scene_schema();

/// The keys before all tables; its name is empty.
CANDELA_API const TableSchema& top_schema();

}  // namespace candela

// What this module's own units share.
namespace candela {

/// The contents of the files, the includes and the settings combined.
struct MergedDocument {
    SourcePlace place;  // of the first file
    TableNode root;     // as if everything were in one file, `include` followed
};

std::optional<MergedDocument> merge_documents(const SceneRequest& request, Diagnostics& diagnostics);

/// The schema of one of the scene's own tables.
const TableSchema& schema_of(std::string_view table);

/// `keys`, and the names of the parameters.
std::vector<std::string> names_in(std::span<const Parameter> schema, std::vector<std::string> keys = {});

// Values of a set, by name; they must be set.
float real(const ParamSet& set, std::string_view name);
int integer(const ParamSet& set, std::string_view name);
Vec3 vector(const ParamSet& set, std::string_view name);
const std::string& text(const ParamSet& set, std::string_view name);
bool has(const ParamSet& set, std::string_view name);

/// The tables of a document, and what applies to all of them.
class SceneTables {
  public:
    SceneTables(const MergedDocument& document, Registry& registry, Diagnostics& diagnostics);

    const TableNode& root() const { return root_; }
    const SourcePlace& whole() const { return whole_; }
    Registry& registry() { return registry_; }
    Diagnostics& diagnostics() { return diagnostics_; }

    /// A table that may occur once; null if it is missing or is not a table, which is reported the first
    /// time.
    const TableNode* single(const std::string& name);
    TableContext context_of(const std::string& name) const;
    /// All values of a table without a plugin.
    ParamSet read_plain(const std::string& name);
    /// The installed plugin of that name, or null, with a message at `place`.
    const PluginFile* known(PluginKind kind, const std::string& name, const SourcePlace& place);
    /// A plugin's parameters, including the relations between them.
    ParamSet read_plugin(const TableNode& table, const PluginFile& plugin, const TableContext& context);

  private:
    const TableNode& root_;
    SourcePlace whole_;
    Registry& registry_;
    Diagnostics& diagnostics_;
    std::map<std::string, const TableNode*> singles_;
};

/// Which shading and reflection model each object gets: the command line's, its own, the scene's, or (R12,
/// R13) the default, if the user agrees.
class ModelChooser {
  public:
    ModelChooser(const SceneRequest& request, SceneTables& tables);

    /// The name is empty if there is none, which has been reported.
    Model shading_for(const TableNode& object);
    Model reflection_for(const TableNode& object, const std::string& label, const SourcePlace& place);

  private:
    /// A model named somewhere.
    struct Named {
        std::string name;
        SourcePlace place;
    };
    std::optional<Named> named(const std::string& table, const std::optional<std::string>& flag);
    std::optional<Named> named_by(const TableNode& object, const std::string& key,
                                  const std::optional<std::string>& flag) const;
    bool is_missing(const std::string& table) const;
    void use_defaults_if_agreed();
    void read_shading_table();
    void report_unknown_material_keys(const TableNode& material, const PluginFile& plugin,
                                      const TableContext& context);
    std::vector<std::string> models_with(const std::string& key);

    const SceneRequest& request_;
    SceneTables& tables_;
    std::optional<Named> shading_, reflection_;
    std::optional<ParamSet> shading_parameters_;
};

}  // namespace candela
