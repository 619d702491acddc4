#include "exercise/exercise_page.h"

#include <cstdint>

#include "candela/embed.h"
#include "candela/target/arrays.h"
#include "candela/target/base64.h"
#include "candela/target/literals.h"
#include "candela/target/text_template.h"
#include "json/json.h"

CANDELA_EMBED(candela_exercise_page, CANDELA_EXERCISE_TEMPLATES "/page.html");
CANDELA_EMBED(candela_exercise_style, CANDELA_EXERCISE_TEMPLATES "/page.css");
CANDELA_EMBED(candela_exercise_points, CANDELA_EXERCISE_TEMPLATES "/points.glsl");
CANDELA_EMBED(candela_exercise_page_style, CANDELA_WEB "/page.css");
CANDELA_EMBED(candela_exercise_editor_style, CANDELA_WEB "/editor.css");
CANDELA_EMBED(candela_exercise_script, CANDELA_EXERCISE_SCRIPT);
CANDELA_EMBED(candela_exercise_codemirror, CANDELA_EXERCISE_CODEMIRROR);

namespace exercise {

namespace {

Json packed(std::span<const float> numbers) { return candela::target::base64(std::as_bytes(numbers)); }

Json json_of(const Case& one) {
    Json material = Json::array();
    for (const Uniform& uniform : one.material)
        material.push_back({{"name", uniform.name}, {"kind", uniform.kind}, {"value", uniform.value}});
    return {{"label", one.label},
            {"to_light", one.to_light},
            {"material", std::move(material)},
            {"ambient", packed(one.ambient)},
            {"diffuse", packed(one.diffuse)},
            {"specular", packed(one.specular)}};
}

Json json_of(const Content& content) {
    Json cases = Json::array(), pixels = Json::array();
    for (const Case& one : content.cases) cases.push_back(json_of(one));
    const std::vector<std::uint32_t> places(content.pixels.begin(), content.pixels.end());
    return {{"candela_exercise", 1},
            {"model", content.model},
            {"function", content.function},
            {"title", content.title},
            {"reference", content.reference},
            {"before", content.before},
            {"after", content.after},
            {"glsl",
             {{"before", content.glsl_before},
              {"after", content.glsl_after},
              {"points", std::string(candela_exercise_points)}}},
            {"size", content.size},
            {"pixels", candela::target::base64(std::as_bytes(std::span(places)))},
            {"normals", packed(content.normals)},
            {"tangents", packed(content.tangents)},
            {"color", content.color},
            {"cases", std::move(cases)}};
}

}  // namespace

std::string page_of(const Content& content) {
    const std::string data = json_text(json_of(content));
    const std::string style =
        std::string(candela_exercise_page_style) + candela_exercise_editor_style + candela_exercise_style;
    return candela::target::filled(candela_exercise_page,
                                   {{"TITLE", candela::target::html_text(content.title)},
                                    {"STYLE", style},
                                    {"EXERCISE", candela::target::script_json(data)},
                                    {"CODEMIRROR", candela_exercise_codemirror},
                                    {"SCRIPT", candela_exercise_script}});
}

}  // namespace exercise
