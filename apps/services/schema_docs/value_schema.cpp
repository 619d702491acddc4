// The types of parameters as JSON Schemas.
module;

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "json/json.h"

module candela.schema;

import candela.plugins;

namespace candela {

namespace {

/// A float with the fewest digits that identify it: 0.1, not 0.10000000149011612.
Json number_json(float x) { return parse_json(fmt::format("{}", x)); }

/// The range that the parameter declares, or the range of its type.
template <class Number>
void put_range(Json& schema, const Parameter& p, Number largest) {
    if (p.minimum == k_no_minimum) {
        schema["minimum"] = -largest;
    } else {
        schema[p.minimum_excluded ? "exclusiveMinimum" : "minimum"] = number_json(p.minimum);
    }
    if (p.maximum == k_no_maximum) {
        schema["maximum"] = largest;
    } else {
        schema[p.maximum_excluded ? "exclusiveMaximum" : "maximum"] = number_json(p.maximum);
    }
}

void put_real_range(Json& schema, const Parameter& p) {
    put_range(schema, p, static_cast<double>(std::numeric_limits<float>::max()));
}

void put_three(Json& schema, Json each) {
    schema["items"] = std::move(each);
    schema["minItems"] = 3;
    schema["maxItems"] = 3;
}

/// Allows other notations than a plain number.
void put_notation(Json& schema, const Parameter& p) {
    constexpr const char* k_number = R"([-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?)";
    const auto of_setting = [](const char* meaning) {
        return Json{{"type", "number"}, {"exclusiveMinimum", 0}, {"description", meaning}};
    };
    switch (p.notation) {
        case Notation::plain:
            return;
        case Notation::exposure:
            schema["type"] = {"number", "string", "object"};
            schema["pattern"] = fmt::format("^ *(EV(100)?)? *{} *$", k_number);
            schema["properties"] = {{"aperture", of_setting("the f-number")},
                                    {"time", of_setting("the shutter time in seconds")},
                                    {"iso", of_setting("the sensor's speed; default: 100")}};
            schema["required"] = {"aperture", "time"};
            schema["additionalProperties"] = false;
            return;
        case Notation::intensity:
        case Notation::cone:
            schema["type"] = {"number", "string"};
            schema["pattern"] = fmt::format("^ *{} *[mkM]?(lm|cd|W) *$", k_number);
            return;
        case Notation::illuminance:
            schema["type"] = {"number", "string"};
            schema["pattern"] = fmt::format("^ *{} *[mkM]?lx *$", k_number);
            return;
    }
}

Json real_schema(const Parameter& p) {
    Json schema{{"type", "number"}};
    put_real_range(schema, p);
    put_notation(schema, p);
    return schema;
}

Json integer_schema(const Parameter& p) {
    Json schema{{"type", "integer"}};
    if (p.choices.empty()) {
        put_range(schema, p, std::numeric_limits<std::int32_t>::max());
    } else if (p.choices.size() == 1) {
        schema["const"] = parse_json(p.choices.front());
    } else {
        for (const std::string& choice : p.choices) schema["enum"].push_back(parse_json(choice));
    }
    return schema;
}

Json color_schema() {
    Json schema{{"type", "array"}};
    put_three(schema, {{"type", "integer"}, {"minimum", 0}, {"maximum", 256}});
    return schema;
}

Json triple_schema(const Parameter& p) {
    Json schema{{"type", {"number", "array"}}};
    put_real_range(schema, p);
    put_three(schema, real_schema(p));
    return schema;
}

Json matrix_schema(const Parameter& p) {
    Json row{{"type", "array"}}, schema{{"type", "array"}};
    put_three(row, real_schema(p));
    put_three(schema, std::move(row));
    return schema;
}

Json numbers_schema(const Parameter& p) {
    return {{"type", "array"}, {"items", real_schema(p)}, {"minItems", 1}};
}

Json vector_schema(const Parameter& p) {
    Json schema{{"type", "array"}};
    put_three(schema, real_schema(p));
    if (p.type == ParamType::direction) schema["contains"] = {{"not", {{"minimum", 0}, {"maximum", 0}}}};
    return schema;
}

/// The schema of a parameter's value.
Json schema_of(const Parameter& p) {
    switch (p.type) {
        case ParamType::real:
            return real_schema(p);
        case ParamType::integer:
            return integer_schema(p);
        case ParamType::boolean:
            return {{"type", "boolean"}};
        case ParamType::choice:
            return {{"type", "string"}, {"enum", p.choices}};
        case ParamType::text:
            return {{"type", "string"}};
        case ParamType::file:
            return {{"type", "string"}, {"minLength", 1}};
        case ParamType::color:
            return color_schema();
        case ParamType::rgb:
            return triple_schema(p);
        case ParamType::matrix:
            return matrix_schema(p);
        case ParamType::numbers:
            return numbers_schema(p);
        case ParamType::vector:
        case ParamType::point:
        case ParamType::direction:
            break;
    }
    return vector_schema(p);
}

}  // namespace

std::string value_schema(const Parameter& p) { return json_text(schema_of(p)); }

}  // namespace candela
