#include "instances.h"

#include "errors.h"
#include "module.h"
#include "values.h"

import candela.api;
import candela.scene;

namespace candela::python {

namespace {

py::object object_of(const Value& value) {
    return std::visit(
        [](const auto& of_type) -> py::object {
            using Type = std::decay_t<decltype(of_type)>;
            if constexpr (std::is_same_v<Type, Vec3>)
                return py::make_tuple(of_type.x, of_type.y, of_type.z);
            else if constexpr (std::is_same_v<Type, NumberList>)
                return py::cast(static_cast<const std::vector<float>&>(of_type));
            else
                return py::cast(of_type);
        },
        value);
}

}  // namespace

ParamSet values_from(SharedRegistry& shared, PluginKind kind, const std::string& name,
                     const py::dict& given) {
    const PluginFile& plugin = shared.registry().require(kind, name);
    const std::string id = plugin.manifest.id();
    const auto table = std::get<TableNode>(node_of(given, id).value);
    const TableContext context{.where = id, .help = {Help::Topic::plugin, id}, .place = {.file = id}};
    Diagnostics diagnostics;
    ParamSet values = read_parameters(table, plugin, context, diagnostics).set;
    if (diagnostics.has_errors()) throw InvalidInput(InvalidInput::What::request, diagnostics);
    return values;
}

py::dict dictionary_of(const ParamSet& values) {
    py::dict all;
    for (std::size_t i = 0; i < values.schema().size(); ++i) {
        if (const auto& value = values.get(i)) all[py::str(values.schema()[i].name)] = object_of(*value);
    }
    return all;
}

ColorEncoding encoding_named(const std::string& name) {
    if (name == "srgb") return ColorEncoding::srgb;
    if (name == "none") return ColorEncoding::none;
    throw Error(ErrorCategory::bad_request,
                fmt::format("color_management is '{}'; expected 'srgb' or 'none'", name));
}

}  // namespace candela::python
