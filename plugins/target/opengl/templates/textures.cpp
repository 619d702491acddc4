// From a colour to an intensity: IEC 61966-2-1 (sRGB), or unchanged.
float decoded(float c) {
    if (!k_is_srgb) return c;
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

@FILE@
// The pictures by which the colours of surfaces are multiplied: files in this program's folder.
const std::vector<const char*> k_textures = {
@FILES@};

struct Texture {
    GLuint name = 0;
    int width = 0, height = 0, levels = 0;
};

// A picture with its levels in a row along its longer side, as an integer texture that the shaders filter themselves.
Texture make_texture(const std::string& file) {
    const std::vector<TextureLevel> levels = texture_levels(file);
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    Texture texture;
    texture.width = levels[0].width;
    texture.height = levels[0].height;
    texture.levels = static_cast<int>(levels.size());
    const bool is_wide = texture.width >= texture.height;
    const int width = texture.width + (is_wide ? 0 : std::max(texture.width / 2, 1));
    const int height = texture.height + (is_wide ? std::max(texture.height / 2, 1) : 0);
    if (std::max(width, height) > largest)
        throw std::runtime_error("the texture " + file + " is too large: with its levels it has " + std::to_string(width) + " x " + std::to_string(height) +
                                 " pixels; this OpenGL takes " + std::to_string(largest) + " a side");
    glGenTextures(1, &texture.name);
    glBindTexture(GL_TEXTURE_2D, texture.name);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16UI, width, height, 0, GL_RGBA_INTEGER, GL_UNSIGNED_SHORT, nullptr);
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const int longer = std::max(texture.width, texture.height), along = i == 0 ? 0 : longer - (longer >> (i - 1));
        const int x = is_wide || i == 0 ? along : texture.width, y = !is_wide || i == 0 ? along : texture.height;
        glTexSubImage2D(GL_TEXTURE_2D, 0, x, y, levels[i].width, levels[i].height, GL_RGBA_INTEGER, GL_UNSIGNED_SHORT,
                        levels[i].texels.data());
    }
    return texture;
}

// Binds a texture as that number of a material, to a unit of its own.
void bind(const Texture& texture, const Picture& picture, GLuint program, std::size_t number) {
    const std::string of_number = std::to_string(number), name = "material_texture_" + of_number;
    const int unit = 6 + static_cast<int>(number);
    glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
    glBindTexture(GL_TEXTURE_2D, texture.name);
    const auto set_whole = [&](const std::string& of, int value) { set(program, {of.c_str(), Uniform::whole, {static_cast<float>(value), 0, 0}}); };
    set_whole("material_texels_" + of_number, unit);
    set_whole(name + ".width", texture.width);
    set_whole(name + ".height", texture.height);
    set_whole(name + ".levels", texture.levels);
    set_whole(name + ".wrap_u", picture.wrap_u);
    set_whole(name + ".wrap_v", picture.wrap_v);
    set_whole(name + ".unit", static_cast<int>(number));
}

// How the line of sight moves from pixel to pixel.
void set_pixel(GLuint program, const Observer& observer, const View& view, int height) {
    const float all = observer.is_perspective ? 2 * std::tan(0.5f * observer.size * 0.0174532925f) : observer.size;
    const float pixel = all / static_cast<float>(height);
    set(program, {"pixel_right", Uniform::vector, pixel * view.right});
    set(program, {"pixel_up", Uniform::vector, pixel * view.top});
}

