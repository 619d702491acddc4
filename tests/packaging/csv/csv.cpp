// Writes a scene as tables: its lights, its objects and their triangles.
#include <array>
#include <cstddef>
#include <sstream>
#include <string>

#include "candela/target/files.h"
#include "candela/target/literals.h"
#include "candela/target_plugin.h"

namespace {

using namespace candela;

class Csv final : public Target {
  public:
    explicit Csv(const sdk::NoParams&) {}

    TargetAbilities abilities() const noexcept override {
        return {.models_without_kernel = true, .surroundings = true};
    }
    const char* main_file() const noexcept override { return "objects.csv"; }

    void write(const ExportedScene& scene, FileSink& files) const override {
        std::ostringstream lights, objects, triangles;
        lights << "label,model,parameter,value\n";
        for (const ExportedLight& light : scene.lights) {
            const PluginDescriptor& model = *scene.light_models[light.model].plugin;
            for (std::size_t i = 0; i < model.parameters.size(); ++i) {
                const ParamValue& value = light.values.written[i];
                lights << target::ascii_identifier(light.label) << ',' << model.name << ','
                       << model.parameters[i].name << ',' << value.number[0] << ' ' << value.number[1] << ' '
                       << value.number[2] << '\n';
            }
        }
        objects << "label,shape,shading,reflection,closed\n";
        triangles << "object,x0,y0,z0,x1,y1,z1,x2,y2,z2\n";
        for (std::size_t o = 0; o < scene.objects.size(); ++o) {
            const ExportedObject& object = scene.objects[o];
            const ExportedMesh mesh = scene.geometry->in_world_space(o);
            const std::string label = target::ascii_identifier(object.label);
            objects << label << ',' << object.shape.plugin->name << ','
                    << scene.shadings[object.shading].plugin->name << ','
                    << scene.reflections[object.reflection].plugin->name << ',' << mesh.closed << '\n';
            for (std::size_t t = 0; t < mesh.indices.size(); ++t) {
                const Vec3 p = mesh.position[mesh.indices[t]];
                triangles << (t % 3 == 0 ? label : "") << ',' << p.x << ',' << p.y << ',' << p.z
                          << (t % 3 == 2 ? "\n" : "");
            }
        }
        target::write(files, "lights.csv", lights.str());
        target::write(files, main_file(), objects.str());
        target::write(files, "meshes/triangles.csv", triangles.str());
    }
};

}  // namespace

CANDELA_PLUGIN(target, Csv, candela::sdk::k_no_fields,
               {.title = "CSV", .summary = "tables of lights, objects and triangles, for spreadsheets"})
