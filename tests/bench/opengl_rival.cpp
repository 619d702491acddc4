// The rival: the same scenes in OpenGL 3.3 core, written for speed, without Candela.
//
//   opengl_rival SCENE.dump WIDTH HEIGHT [--png FILE | --raw FILE | --frames N]
//
// One program for all objects, the number of lights a constant of the shader, uniforms in buffers, vertices
// interleaved in buffers, sRGB encoded by the framebuffer, the picture read back each frame. --frames prints
// the milliseconds of each. It links only EGL, libOpenGL and libpng, to start as fast as possible, and Mesa's
// cache of compiled shaders is warm after the first run.
#define EGL_EGLEXT_PROTOTYPES
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene_read.h"

namespace {

using bench::DumpLight;
using bench::Scene;

constexpr const char* k_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(std140) uniform Camera { mat4 view_projection; vec4 eye; };
out vec3 at;
out vec3 n;
void main() {
    at = position;
    n = normal;
    gl_Position = view_projection * vec4(position, 1.0);
}
)";

constexpr const char* k_fragment = R"(
in vec3 at;
in vec3 n;
layout(std140) uniform Camera { mat4 view_projection; vec4 eye; };
struct Light { vec4 position; vec4 color; };
layout(std140) uniform Lights { Light lights[LIGHTS]; };
layout(std140) uniform Material { vec4 diffuse; vec4 specular; };  // specular.w: shininess
out vec4 color;
void main() {
    vec3 N = normalize(gl_FrontFacing ? n : -n);
    vec3 V = normalize(eye.xyz - at);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LIGHTS; ++i) {
        vec3 to = lights[i].position.xyz - at;
        float r2 = dot(to, to);
        vec3 L = to * inversesqrt(r2);
        float n_dot_l = dot(N, L);
        if (n_dot_l > 0.0) {
            vec3 R = 2.0 * n_dot_l * N - L;
            float highlight = pow(max(dot(R, V), 0.0), specular.w);
            sum += lights[i].color.rgb / r2 * (diffuse.rgb * n_dot_l + specular.rgb * highlight);
        }
    }
    color = vec4(sum, 1.0);
}
)";

void make_context() {
    const EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE || eglBindAPI(EGL_OPENGL_API) == EGL_FALSE)
        throw std::runtime_error("EGL does not start");
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                              3,
                              EGL_CONTEXT_MINOR_VERSION,
                              3,
                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                              EGL_NONE};
    const EGLContext context = eglCreateContext(display, nullptr, EGL_NO_CONTEXT, version);
    if (context == EGL_NO_CONTEXT ||
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE)
        throw std::runtime_error("OpenGL 3.3 is not available");
}

GLuint compiled(GLenum stage, const std::string& source) {
    const GLuint shader = glCreateShader(stage);
    const char* const text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint is_good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &is_good);
    if (is_good == 0) throw std::runtime_error("a shader does not compile");
    return shader;
}

struct Vec {
    float x, y, z;
};
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
float dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Vec unit(Vec a) {
    const float s = 1 / std::sqrt(dot(a, a));
    return {a.x * s, a.y * s, a.z * s};
}
Vec vec(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

struct CameraBlock {
    std::array<float, 16> view_projection;
    std::array<float, 4> eye;
};

CameraBlock camera_of(const Scene& scene, int width, int height) {
    const Vec eye = vec(scene.header.eye), forward = unit(vec(scene.header.look_at) - eye);
    const Vec right = unit(cross(forward, vec(scene.header.up))), top = cross(right, forward);
    constexpr float n = 0.05f, f = 100.0f;
    const float sy = 1 / std::tan(0.5f * scene.header.fov * 0.01745329252f);
    const float sx = sy * static_cast<float>(height) / static_cast<float>(width);
    const float a = (f + n) / (f - n), b = -2 * f * n / (f - n);
    const float dx = dot(right, eye), dy = dot(top, eye), dz = dot(forward, eye);
    return {
        {sx * right.x, sy * top.x, a * forward.x, forward.x, sx * right.y, sy * top.y, a * forward.y,
         forward.y, sx * right.z, sy * top.z, a * forward.z, forward.z, -sx * dx, -sy * dy, b - a * dz, -dz},
        {eye.x, eye.y, eye.z, 1}};
}

class Rival {
  public:
    Rival(const Scene& scene, int width, int height) : scene_(scene), width_(width), height_(height) {
        make_context();
        const std::string fragment =
            "#version 330 core\n#define LIGHTS " + std::to_string(scene.lights.size()) + "\n" + k_fragment;
        program_ = glCreateProgram();
        glAttachShader(program_, compiled(GL_VERTEX_SHADER, k_vertex));
        glAttachShader(program_, compiled(GL_FRAGMENT_SHADER, fragment));
        glLinkProgram(program_);
        glUseProgram(program_);
        GLuint binding = 0;
        for (const char* const block : {"Camera", "Lights", "Material"})
            glUniformBlockBinding(program_, glGetUniformBlockIndex(program_, block), binding++);
        camera_ = buffer(GL_UNIFORM_BUFFER, nullptr, sizeof(CameraBlock), GL_STREAM_DRAW);
        std::vector<float> lights;
        for (const DumpLight& l : scene.lights)
            lights.insert(lights.end(), {l.position[0], l.position[1], l.position[2], 1, l.color[0],
                                         l.color[1], l.color[2], 1});
        lights_ = buffer(GL_UNIFORM_BUFFER, lights.data(), lights.size() * sizeof(float), GL_STATIC_DRAW);
        for (const Scene::Object& o : scene.objects) upload(o);
        make_framebuffer();
    }

    /// Draws, and reads the picture back.
    void frame(std::vector<unsigned char>& pixels) {
        const CameraBlock camera = camera_of(scene_, width_, height_);
        glBindBuffer(GL_UNIFORM_BUFFER, camera_);
        glBufferData(GL_UNIFORM_BUFFER, sizeof camera, &camera, GL_STREAM_DRAW);
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, camera_);
        glBindBufferBase(GL_UNIFORM_BUFFER, 1, lights_);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        for (const Drawn& d : drawn_) {
            glBindBufferBase(GL_UNIFORM_BUFFER, 2, d.material);
            (d.is_closed ? glEnable : glDisable)(GL_CULL_FACE);
            glBindVertexArray(d.array);
            glDrawElements(GL_TRIANGLES, d.indices, GL_UNSIGNED_INT, nullptr);
        }
        glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    }

  private:
    struct Drawn {
        GLuint array, material;
        GLsizei indices;
        bool is_closed;
    };

    static GLuint buffer(GLenum target, const void* data, std::size_t size, GLenum usage) {
        GLuint name = 0;
        glGenBuffers(1, &name);
        glBindBuffer(target, name);
        glBufferData(target, static_cast<GLsizeiptr>(size), data, usage);
        return name;
    }

    void upload(const Scene::Object& o) {
        Drawn d{};
        d.indices = static_cast<GLsizei>(o.indices.size());
        d.is_closed = o.head.closed != 0;
        glGenVertexArrays(1, &d.array);
        glBindVertexArray(d.array);
        std::vector<float> vertices;
        vertices.reserve(2 * o.position.size());
        for (std::size_t i = 0; i < o.position.size(); i += 3) {
            vertices.insert(vertices.end(), &o.position[i], &o.position[i] + 3);
            vertices.insert(vertices.end(), &o.normal[i], &o.normal[i] + 3);
        }
        buffer(GL_ARRAY_BUFFER, vertices.data(), vertices.size() * sizeof(float), GL_STATIC_DRAW);
        constexpr GLsizei k_stride = 6 * sizeof(float);
        glEnableVertexAttribArray(0);
        glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, k_stride, nullptr);
        glEnableVertexAttribArray(1);
        glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, k_stride,
                              reinterpret_cast<const void*>(3 * sizeof(float)));
        buffer(GL_ELEMENT_ARRAY_BUFFER, o.indices.data(), o.indices.size() * sizeof(std::uint32_t),
               GL_STATIC_DRAW);
        const float* const a = o.head.diffuse;
        const float* const s = o.head.specular;
        const std::array<float, 8> material = {a[0], a[1], a[2], 0, s[0], s[1], s[2], o.head.shininess};
        d.material = buffer(GL_UNIFORM_BUFFER, material.data(), sizeof material, GL_STATIC_DRAW);
        drawn_.push_back(d);
    }

    void make_framebuffer() {
        GLuint framebuffer = 0;
        std::array<GLuint, 2> buffers{};
        glGenFramebuffers(1, &framebuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glGenRenderbuffers(2, buffers.data());
        glBindRenderbuffer(GL_RENDERBUFFER, buffers[0]);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, width_, height_);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
        glBindRenderbuffer(GL_RENDERBUFFER, buffers[1]);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width_, height_);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw std::runtime_error("the framebuffer is not complete");
        glViewport(0, 0, width_, height_);
        glEnable(GL_FRAMEBUFFER_SRGB);
        glEnable(GL_DEPTH_TEST);
        glEnable(GL_CULL_FACE);
        const float* const b = scene_.header.background;
        glClearColor(b[0], b[1], b[2], 1);
    }

    const Scene& scene_;
    int width_, height_;
    GLuint program_ = 0, camera_ = 0, lights_ = 0;
    std::vector<Drawn> drawn_;
};

/// libpng's fastest settings: differences from the row above, compressed as runs only, which makes files
/// about as large as Candela's. Its defaults would take five times as long, for files of two thirds the size.
void write_png(const char* path, const std::vector<unsigned char>& pixels, int width, int height) {
    std::FILE* const file = std::fopen(path, "wb");
    if (file == nullptr) throw std::runtime_error("cannot write the picture");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_set_compression_level(png, Z_BEST_SPEED);
    png_set_compression_strategy(png, Z_RLE);
    png_set_compression_buffer_size(png, std::size_t{1} << 18);
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    png_set_filler(png, 0, PNG_FILLER_AFTER);
    for (int y = height; y-- > 0;)
        png_write_row(png, const_cast<png_bytep>(
                               &pixels[4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(width)]));
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
}

/// Rows from the top, red green blue, as a PPM file.
void write_raw(const char* path, const std::vector<unsigned char>& pixels, int width, int height) {
    std::ofstream out(path, std::ios::binary);
    out << "P6\n" << width << ' ' << height << "\n255\n";
    for (int y = height; y-- > 0;) {
        for (int x = 0; x < width; ++x) {
            const std::size_t at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                        static_cast<std::size_t>(x));
            out.write(reinterpret_cast<const char*>(&pixels[at]), 3);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 2 && std::string(argv[1]) == "--version") {
        make_context();
        std::printf("%s, %s\n", reinterpret_cast<const char*>(glGetString(GL_RENDERER)),
                    reinterpret_cast<const char*>(glGetString(GL_VERSION)));
        std::fflush(stdout);
        std::_Exit(0);
    }
    if (argc != 6) {
        std::fprintf(stderr, "opengl_rival SCENE.dump WIDTH HEIGHT --png FILE | --raw FILE | --frames N\n");
        return 2;
    }
    try {
        const Scene scene = bench::read_scene(argv[1]);
        const int width = std::atoi(argv[2]), height = std::atoi(argv[3]);
        Rival rival(scene, width, height);
        std::vector<unsigned char> pixels(4 * static_cast<std::size_t>(width) *
                                          static_cast<std::size_t>(height));
        const std::string what = argv[4];
        const int frames = what == "--frames" ? std::atoi(argv[5]) : 1;
        for (int i = 0; i < frames; ++i) {
            const auto begin = std::chrono::steady_clock::now();
            rival.frame(pixels);
            const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - begin;
            if (what == "--frames") std::printf("%.4f\n", passed.count());
        }
        if (what == "--png") write_png(argv[5], pixels, width, height);
        if (what == "--raw") write_raw(argv[5], pixels, width, height);
        std::fflush(stdout);
        std::_Exit(0);  // like a window's program when killed; tearing down a context is not measured
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "opengl_rival: %s\n", problem.what());
        return 1;
    }
}
