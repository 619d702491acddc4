// Tables of small scenes, for tests to put together around the lines that they are about.
#pragma once

#include <fmt/format.h>

#include <string>

inline std::string models(const std::string& shading, const std::string& reflection) {
    return fmt::format("[shading]\nmodel = \"{}\"\n[reflection]\nmodel = \"{}\"\n", shading, reflection);
}

inline const std::string k_observer = "[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\n";
inline const std::string k_start = "version = 1\n" + k_observer;
inline const std::string k_models = models("phong", "phong");
inline const std::string k_light = "[[light]]\ntype = \"point\"\nposition = [1, 1, 3]\n";
inline const std::string k_cube = "[[object]]\nname = \"box\"\ntype = \"cube\"\n";

inline std::string image_table(int width, int height) {
    return fmt::format("[image]\nwidth = {}\nheight = {}\n", width, height);
}
