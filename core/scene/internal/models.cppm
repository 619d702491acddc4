module;

#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

module candela.scene:models;

import :content;
import :request;
import :tables;
import :toml;
import :validation;
import candela.plugins;
import candela.util;

namespace candela {

inline constexpr const char* k_default_shading = "phong";
inline constexpr const char* k_default_reflection = "phong";

/// Chooses each object's shading and reflection model: the command line's, its own, the scene's, or (R12,
/// R13) the default, if the user agrees.
class ModelChooser {
  public:
    ModelChooser(const SceneRequest& request, SceneTables& tables);

    /// The name is empty if there is none, which has been reported.
    Model shading_for(const TableNode& object);
    /// Sets the object's reflection model and the textures of its parameters.
    void set_reflection(Object& to, const TableNode& object, const std::string& label);
    /// Takes the object's colour from its table, if it is a texture. `where`: the object, for messages.
    std::optional<ParameterTexture> take_color_texture(TableNode& object, const std::string& where);

  private:
    /// A model's name, and where it stands.
    struct Named {
        std::string name;
        SourceLocation place;
    };
    std::optional<Named> named(const std::string& table, const std::optional<ModelSetting>& setting);
    std::optional<Named> named_by(const TableNode& object, const std::string& key,
                                  const std::optional<ModelSetting>& setting) const;
    bool is_missing(const std::string& table) const;
    void use_defaults_if_agreed();
    void read_shading_table();
    /// `why_not`: the reason why a parameter cannot have a texture; empty: it can.
    std::vector<ParameterTexture> take_textures(TableNode& material, const std::vector<Parameter>& parameters,
                                                const std::string& where,
                                                const std::function<std::string(const Parameter&)>& why_not);
    std::vector<ParameterTexture> take_textures(TableNode& material, const PluginFile& plugin,
                                                const std::string& where);
    /// Takes the entries that do not belong to the model.
    CommonMaterial take_common(TableNode& material, const PluginFile& plugin, const TableContext& context);
    std::vector<ParameterTexture> factors_in(std::span<const Node* const> tables, const Parameter& parameter,
                                             const std::string& where);
    std::optional<ParameterTexture> texture_in(const TableNode& table, const Parameter& parameter,
                                               const std::string& where, const SourceLocation& place);
    std::optional<Named> model_in_scene(const TableNode& object);
    bool belongs_to(const Named& replaced, const std::string& key);
    void report_unknown_material_keys(const TableNode& material, const PluginFile& plugin,
                                      const TableContext& context, const std::optional<Named>& replaced);
    std::vector<std::string> models_with(const std::string& key);

    const SceneRequest& request_;
    SceneTables& tables_;
    std::optional<Named> shading_, reflection_;
    std::optional<ParamSet> shading_parameters_;
    std::set<std::string> unusable_kernels_;
};

}  // namespace candela
