#include "layers.h"

#include <string>

#include "candela/embed.h"
#include "candela/target/textures.h"

CANDELA_EMBED(candela_opengl_layer_canvas, CANDELA_SOURCE_DIR "/templates/layer_canvas.cpp");
CANDELA_EMBED(candela_opengl_draw_layers, CANDELA_SOURCE_DIR "/templates/draw_layers.cpp");

namespace candela::opengl_target {

using namespace target;

namespace {

constexpr const char* k_draw_sample =
    "    void draw_sample(const Observer& observer, const View& view, Choice choice, int width, int height, "
    "std::array<float, 2> sample) {\n"
    "        glBindFramebuffer(GL_FRAMEBUFFER, picture_.framebuffer);\n"
    "        glClearColor(k_background[0], k_background[1], k_background[2], 1);\n";

constexpr const char* k_link =
    "        const std::string out = \"out vec4 color;\\n\";\n"
    "        show_layer_ = linked(k_header + k_screen, k_header + out + \"uniform sampler2D layer;\\nvoid "
    "main() "
    "{ color = texelFetch(layer, ivec2(gl_FragCoord.xy), 0); }\\n\");\n"
    "        show_background_ = linked(k_header + k_screen, k_header + out + \"uniform vec3 "
    "background;\\nvoid "
    "main() { color = vec4(background, 1.0); }\\n\");\n"
    "        glGenQueries(1, &query_);\n";

constexpr const char* k_resize =
    "        for (Canvas& layer : layers_) {\n"
    "            glDeleteTextures(1, &layer.texture);\n"
    "            glDeleteTextures(1, &layer.depth);\n"
    "            glDeleteFramebuffers(1, &layer.framebuffer);\n"
    "            layer = make_layer(width, height);\n"
    "        }\n";

constexpr const char* k_set =
    "            set(program, {\"covered\", Uniform::whole, {0, 0, 0}});\n"
    "            set(program, {\"depth_before\", Uniform::whole, {1, 0, 0}});\n"
    "            set(program, {\"is_first_layer\", Uniform::whole, {layer == 0 ? 1.0f : 0.0f, 0, 0}});\n"
    "            set(program, {\"object_opacity\", Uniform::real, {object.opacity, 0, 0}});\n"
    "            set(program, {\"object_opacity_cutoff\", Uniform::real, {object.opacity_cutoff, 0, 0}});\n";

constexpr const char* k_held =
    "    GLuint show_layer_ = 0, show_background_ = 0, query_ = 0;\n"
    "    GLuint drawn_ = 0;  // the picture of the last layer\n"
    "    std::array<Canvas, 2> layers_;\n";

}  // namespace

Values layer_values(const ExportedScene& scene) {
    const bool is_there = has_opacity(scene);
    const auto if_there = [&](const char* text) { return std::string(is_there ? text : ""); };
    return {{"LAYER_CANVAS", if_there(candela_opengl_layer_canvas)},
            {"LINK_LAYERS", if_there(k_link)},
            {"RESIZE_LAYERS", if_there(k_resize)},
            {"DRAW_SAMPLE", is_there ? candela_opengl_draw_layers : k_draw_sample},
            {"SET_LAYER", if_there(k_set)},
            {"LAYERS_HELD", if_there(k_held)}};
}

}  // namespace candela::opengl_target
