module;

#include <optional>
#include <string_view>
#include <vector>

module candela.scene;

import candela.color;
import candela.parameters;
import candela.transform;

namespace candela {

std::optional<std::string_view> name_of_label(std::string_view label) noexcept {
    const bool is_quoted = label.size() > 2 && label.front() == '\'' && label.back() == '\'';
    if (!is_quoted) return std::nullopt;
    return label.substr(1, label.size() - 2);
}

bool operator==(const Scene& a, const Scene& b) {
    return a.room == b.room && a.observer == b.observer && a.image == b.image &&
           a.constraints == b.constraints && a.lights == b.lights && a.objects == b.objects &&
           a.animation == b.animation;
}

}  // namespace candela
