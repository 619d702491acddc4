#pragma once

namespace candela {

struct Glow {
    float brightness = 0;
};

class Light {};

Glow glow_of(const Light& light);

}  // namespace candela
