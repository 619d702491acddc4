#include <nlohmann/json.hpp>
#include <string>

namespace fuzz {

bool is_json(const std::string& text) { return nlohmann::json::accept(text); }

}  // namespace fuzz
