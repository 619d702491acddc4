// The same scenes drawn by VTK as its manual describes: a mapper and an actor per object, without Candela.
//
//   vtk_rival SCENE.dump WIDTH HEIGHT PNG
//   vtk_rival --version
//
// Debian's VTK opens windows only through X; this one gets a context without a window, like that of
// opengl_rival.cpp.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <vtkActor.h>
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkTypeInt32Array.h>
#include <vtkVersion.h>
#include <vtkWindowToImageFilter.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene_read.h"

VTK_MODULE_INIT(vtkRenderingOpenGL2);

/// Replaces GLEW's function, without which VTK would give up: there is no X here to ask for GLX's functions.
extern "C" unsigned glxewInit() { return 0; }

namespace {

using bench::Scene;

/// VTK asks a window for sRGB; without one, its shader encodes it.
constexpr const char* k_encode = R"(//VTK::Light::Impl
    vec3 linear = clamp(gl_FragData[0].rgb, 0.0, 1.0);
    gl_FragData[0].rgb = mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055,
                             step(vec3(0.0031308), linear));
)";

double encoded(float linear) {
    return linear < 0.0031308f ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

void make_context() {
    const EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE || eglBindAPI(EGL_OPENGL_API) == EGL_FALSE)
        throw std::runtime_error("EGL does not start");
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2, EGL_NONE};
    const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version);
    if (context == EGL_NO_CONTEXT ||
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE)
        throw std::runtime_error("OpenGL 3.2 is not available");
}

vtkNew<vtkFloatArray> triples(const std::vector<float>& values) {
    vtkNew<vtkFloatArray> array;
    array->SetNumberOfComponents(3);
    array->SetArray(const_cast<float*>(values.data()), static_cast<vtkIdType>(values.size()), 1);
    return array;
}

vtkNew<vtkPolyData> mesh_of(const Scene::Object& o) {
    vtkNew<vtkPoints> points;
    points->SetData(triples(o.position));
    vtkNew<vtkTypeInt32Array> indices;
    indices->SetArray(reinterpret_cast<std::int32_t*>(const_cast<std::uint32_t*>(o.indices.data())),
                      static_cast<vtkIdType>(o.indices.size()), 1);
    vtkNew<vtkCellArray> triangles;
    triangles->SetData(3, indices);
    vtkNew<vtkPolyData> mesh;
    mesh->SetPoints(points);
    mesh->GetPointData()->SetNormals(triples(o.normal));
    mesh->SetPolys(triangles);
    return mesh;
}

void add(vtkRenderer& renderer, const Scene::Object& o) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(mesh_of(o));
    mapper->SetStatic(1);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkProperty& property = *actor->GetProperty();
    property.SetInterpolationToPhong();
    property.SetAmbient(0);
    property.SetDiffuse(1);
    property.SetDiffuseColor(o.head.diffuse[0], o.head.diffuse[1], o.head.diffuse[2]);
    property.SetSpecular(1);
    property.SetSpecularColor(o.head.specular[0], o.head.specular[1], o.head.specular[2]);
    property.SetSpecularPower(o.head.shininess);
    property.SetBackfaceCulling(o.head.closed != 0);
    actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", true, k_encode, false);
    renderer.AddActor(actor);
}

void add(vtkRenderer& renderer, const bench::DumpLight& l) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPositional(true);
    light->SetConeAngle(180);  // in all directions
    light->SetPosition(l.position[0], l.position[1], l.position[2]);
    light->SetColor(l.color[0], l.color[1], l.color[2]);
    light->SetAttenuationValues(0, 0, 1);
    renderer.AddLight(light);
}

void draw(const Scene& scene, int width, int height, const char* png) {
    make_context();
    vtkNew<vtkGenericOpenGLRenderWindow> window;
    window->SetReadyForRendering(true);
    window->SetIsCurrent(true);
    window->SetSupportsOpenGL(1);
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(width, height);
    vtkNew<vtkRenderer> renderer;
    const bench::DumpHeader& h = scene.header;
    renderer->SetBackground(encoded(h.background[0]), encoded(h.background[1]), encoded(h.background[2]));
    renderer->AutomaticLightCreationOff();
    for (const bench::DumpLight& l : scene.lights) add(*renderer, l);
    for (const Scene::Object& o : scene.objects) add(*renderer, o);
    vtkCamera& camera = *renderer->GetActiveCamera();
    camera.SetPosition(h.eye[0], h.eye[1], h.eye[2]);
    camera.SetFocalPoint(h.look_at[0], h.look_at[1], h.look_at[2]);
    camera.SetViewUp(h.up[0], h.up[1], h.up[2]);
    camera.SetViewAngle(h.fov);
    camera.SetClippingRange(0.05, 100);
    window->AddRenderer(renderer);
    window->Render();

    vtkNew<vtkWindowToImageFilter> image;
    image->SetInput(window);
    image->SetInputBufferTypeToRGB();
    image->ReadFrontBufferOff();
    image->ShouldRerenderOff();
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(image->GetOutputPort());
    writer->SetFileName(png);
    writer->Write();
    if (writer->GetErrorCode() != 0) throw std::runtime_error("cannot write the picture");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 2 && std::string(argv[1]) == "--version") {
        std::puts(vtkVersion::GetVTKVersion());
        return 0;
    }
    if (argc != 5) {
        std::fprintf(stderr, "vtk_rival SCENE.dump WIDTH HEIGHT PNG | --version\n");
        return 2;
    }
    try {
        const Scene scene = bench::read_scene(argv[1]);
        draw(scene, std::atoi(argv[2]), std::atoi(argv[3]), argv[4]);
        std::fflush(stdout);
        std::_Exit(0);  // like opengl_rival.cpp
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "vtk_rival: %s\n", problem.what());
        return 1;
    }
}
