// The JSON Schema and the reference for plugins that are not shipped.
#include <catch2/catch_test_macros.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/text.h"

import candela.core;
import candela.schema;

using candela::Manifest;
using candela::Parameter;
using candela::ParamType;
using candela::PluginKind;
using Json = nlohmann::json;

namespace {

Manifest manifest(PluginKind kind, const std::string& name, std::vector<Parameter> parameters) {
    Manifest m;
    m.kind = kind;
    m.name = name;
    m.title = "Title of " + name;
    m.summary = "Summary of " + name + ".";
    m.parameters = std::move(parameters);
    return m;
}

Parameter number(const std::string& name, float minimum, float maximum, double default_value) {
    Parameter p;
    p.name = name;
    p.meaning = "meaning of " + name;
    p.minimum = minimum;
    p.maximum = maximum;
    p.default_value = default_value;
    return p;
}

Json schema(const std::vector<Manifest>& installed) {
    return Json::parse(candela::scene_json_schema(installed));
}

}  // namespace

TEST_CASE("without plugins, no plugin name is allowed, but the scene's own keys are") {
    const Json root = schema({});
    CHECK(root["properties"]["object"]["items"]["properties"]["type"]["enum"] == Json::array());
    CHECK(root["properties"]["light"]["items"]["properties"]["type"]["anyOf"][0]["enum"] == Json::array());
    CHECK(root["properties"]["room"]["properties"]["height"]["exclusiveMinimum"] == 0);
    CHECK(root["properties"]["room"]["properties"]["height"]["default"] == 10);
    CHECK_FALSE(root.contains("definitions"));
    CHECK_FALSE(root.contains("dependencies"));
    CHECK_FALSE(root.contains("required"));
    CHECK(holds(candela::scene_reference({}), "none is installed"));
}

TEST_CASE("constraints that plugins share apply to all, the others to each plugin") {
    const Json root =
        schema({manifest(PluginKind::light, "a", {number("same", 0, 1, 0.5), number("other", 0, 1, 0.5)}),
                manifest(PluginKind::light, "b", {number("same", 0, 1, 0.5), number("other", 0, 2, 0.25)})});
    const Json& properties = root["properties"]["light"]["items"]["properties"];
    CHECK(properties["same"]["maximum"] == 1);
    CHECK(properties["same"]["default"] == 0.5);
    CHECK(holds(properties["same"]["description"], "a, b: meaning of same"));
    CHECK(properties["other"]["type"] == "number");
    CHECK_FALSE(properties["other"].contains("maximum"));
    CHECK_FALSE(properties["other"].contains("default"));
    CHECK(root["definitions"]["light-a"]["properties"]["same"] == true);
    CHECK(root["definitions"]["light-a"]["properties"]["other"]["maximum"] == 1);
    CHECK(root["definitions"]["light-b"]["properties"]["other"]["maximum"] == 2);
}

TEST_CASE("a parameter named like one of the table's own keys is checked as both, as in the reader") {
    const Json root = schema({manifest(PluginKind::shape, "blob", {number("scale", 0, 3, 1)})});
    const Json& own = root["properties"]["object"]["items"]["properties"]["scale"];
    CHECK(own["type"] == Json::array({"number", "array"}));
    CHECK(own["exclusiveMinimum"] == 0);
    CHECK(root["definitions"]["shape-blob"]["properties"]["scale"]["maximum"] == 3);
}

TEST_CASE("bounds are the declared decimal numbers, not their binary neighbours") {
    Parameter p = number("p", 0.1f, 0.7f, 0.3);
    p.maximum_excluded = true;
    const Json root = schema({manifest(PluginKind::light, "a", {p})});
    const Json& property = root["properties"]["light"]["items"]["properties"]["p"];
    CHECK(property["minimum"].dump() == "0.1");
    CHECK(property["exclusiveMaximum"].dump() == "0.7");
    CHECK_FALSE(property.contains("maximum"));
    CHECK(property["default"].dump() == "0.3");
}

TEST_CASE("the reference keeps a parameter's text within its cell, and shows how to name the plugin") {
    Parameter p = number("p", 0, candela::k_no_maximum, 2);
    p.meaning = "|p|\nand more";
    p.unit = "deg";
    Parameter required = number("q", 0, 8, 0);
    required.default_value.reset();
    Manifest m = manifest(PluginKind::light, "a", {p, required});
    m.formula = "I = |p|";
    m.relations = {{candela::RelationType::less, "p", "q", false, "so it is"}};
    const std::string page = candela::scene_reference(std::vector{m});
    CHECK(holds(page, "| `p` | a number, at least 0 | degrees | `2` | \\|p\\| and more |\n"));
    CHECK(holds(page, "| `q` | a number, 0 to 8 |  | **required** | meaning of q |\n"));
    CHECK(holds(page, "```text\nI = |p|\n```"));
    CHECK(holds(page, "- p is less than q: so it is.\n"));
    CHECK(holds(page, "```toml\n[[light]]\ntype = \"a\"\np    = 2\nq    = 0\n```"));
    CHECK(holds(page, "one of [`a`](#lighta)"));
}
