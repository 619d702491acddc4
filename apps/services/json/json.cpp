#include "json/json.h"

import candela.util;

std::string json_text(const Json& json, int indentation) {
    return candela::printable_json(json.dump(indentation, ' ', false, Json::error_handler_t::replace));
}

Json parse_json(std::string_view text) { return Json::parse(text); }

Json json_or_discarded(std::string_view text) { return Json::parse(text, nullptr, false); }
