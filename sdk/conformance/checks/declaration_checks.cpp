// Requirements for a plugin's description of itself: everything that it declares exists.

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "candela/kernel_language/declarations.h"
#include "subject.h"

namespace kl = candela::kernel_language;
using candela::Manifest;
using candela::PluginKind;

TEST_CASE("declarations: its properties are those of its kind, its relations are between its parameters",
          "[all]") {
    const Manifest& m = subject_manifest();
    const auto schema = std::make_shared<const std::vector<candela::Parameter>>(m.parameters);
    std::set<std::string> properties, parameters, presets;
    for (const auto& [name, value] : m.properties) {
        if (!properties.insert(name).second) FAIL_CHECK("it declares '" << name << "' twice");
        if (const auto problem = kl::property_problem(m.kind, name, value, schema)) FAIL_CHECK(*problem);
    }
    for (const candela::Parameter& p : m.parameters) {
        if (!parameters.insert(p.name).second) FAIL_CHECK("it has two parameters called '" << p.name << "'");
        if (const auto problem = kl::parameter_name_problem(m.kind, p.name)) FAIL_CHECK(*problem);
    }
    for (const candela::Relation& relation : m.relations)
        if (const auto problem = kl::relation_problem(relation, schema)) FAIL_CHECK(*problem);
    for (const candela::Preset& preset : m.presets) {
        if (!presets.insert(preset.name).second)
            FAIL_CHECK("it has two presets called '" << preset.name << "'");
        for (const std::string& problem : kl::preset_problems(preset, m.kind, schema, m.relations))
            FAIL_CHECK(problem);
    }
    if (!m.formats.empty() && m.kind != PluginKind::image)
        FAIL_CHECK("it lists file formats, but is not an image plugin");
}
